// SPDX-License-Identifier: MIT
// The functions of pins_virtual.h for displays.
#include "hal_sim/board/board.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins_virtual.h"

using host::Context;

namespace {

/// Made when it is first asked for, as large as [[robot.device]] says; null: no display of that number.
board::Display* display_of(tp_i64 number) {
  Context::current().note_write();
  board::Board& robot = Context::current().board();
  const auto& devices = robot.setup().devices;
  const auto index = static_cast<std::size_t>(number);
  if (number < 0 || index >= devices.size() || devices[index].kind != sim::DeviceKind::Display)
    return nullptr;
  auto& made = robot.virtual_devices().displays;
  const auto found = made.find(static_cast<int>(number));
  if (found != made.end()) return &found->second;
  return &made.emplace(static_cast<int>(number), board::Display(devices[index].width, devices[index].height))
              .first->second;
}

int small(tp_i64 value) { return static_cast<int>(value); }

}  // namespace

extern "C" {

tp_i64 tp_display_width(tp_i64 display) {
  const board::Display* d = display_of(display);
  return d ? d->screen().width : 0;
}

tp_i64 tp_display_height(tp_i64 display) {
  const board::Display* d = display_of(display);
  return d ? d->screen().height : 0;
}

void tp_display_colour(tp_i64 display, tp_i64 rgb) {
  if (board::Display* d = display_of(display)) d->set_colour(static_cast<std::uint32_t>(rgb));
}

void tp_display_solid(tp_i64 display, tp_i64 alpha_percent, tp_i64 opacity_percent) {
  board::Display* d = display_of(display);
  if (!d) return;
  d->set_alpha(static_cast<double>(alpha_percent) / 100);
  d->set_opacity(static_cast<double>(opacity_percent) / 100);
}

void tp_display_shape(tp_i64 display, tp_i64 filled, const short* x, const short* y, tp_i64 points) {
  board::Display* d = display_of(display);
  if (!d) return;
  filled ? d->fill(x, y, small(points)) : d->draw(x, y, small(points));
}

tp_i64 tp_display_copy(tp_i64 display, tp_i64 x, tp_i64 y, tp_i64 width, tp_i64 height) {
  board::Display* d = display_of(display);
  return d ? d->copy(small(x), small(y), small(width), small(height)) : 0;
}

tp_i64 tp_display_make(tp_i64 display, tp_i64 width, tp_i64 height, const void* bytes, tp_i64 format) {
  // webots/display.h: RGB, RGBA, ARGB, BGRA, ABGR from 3 on
  static constexpr int kOrder[5][4] = {{0, 1, 2, -1}, {0, 1, 2, 3}, {1, 2, 3, 0}, {2, 1, 0, 3}, {3, 2, 1, 0}};
  board::Display* d = display_of(display);
  if (!d || format < 3 || format > 7) return 0;
  return d->make(small(width), small(height), static_cast<const unsigned char*>(bytes), format == 3 ? 3 : 4,
                 kOrder[format - 3]);
}

void tp_display_paste(tp_i64 display, tp_i64 image, tp_i64 x, tp_i64 y, tp_i64 blend) {
  if (board::Display* d = display_of(display)) d->paste(small(image), small(x), small(y), blend != 0);
}

void tp_display_remove(tp_i64 display, tp_i64 image) {
  if (board::Display* d = display_of(display)) d->remove(small(image));
}

tp_i64 tp_display_save(tp_i64 display, tp_i64 image, const char* name) {
  board::Display* d = display_of(display);
  const board::DisplayImage* picture = d ? d->image(small(image)) : nullptr;
  board::VirtualDevices& devices = Context::current().board().virtual_devices();
  if (!picture || !devices.write_picture) return 0;
  const std::string path = devices.files.path_for_writing(name);
  return !path.empty() && devices.write_picture(path, *picture);
}
}
