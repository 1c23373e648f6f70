// SPDX-License-Identifier: MIT
#include "programs/puck/camera.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/camera.h"

namespace programs {

namespace {

constexpr int kAddress = 0xDC;     // [lib: camera/fast_2_timer/e_po3030k.c]
constexpr int kBankRegister = 3;   // of the later sensors [lib: camera/fast_2_timer/e_po6030k.c]
constexpr int kBytesPerPixel = 2;  // RGB565

#include "programs/puck/camera_setup.inc"

struct Registers {
  const CameraRegister* first;
  std::size_t count;
};
template <std::size_t n>
Registers all_of(const CameraRegister (&rows)[n]) {
  return {rows, n};
}
Registers setup_of(board::CameraKind kind) {
  return kind == board::CameraKind::Po6030k   ? all_of(kPo6030k)
         : kind == board::CameraKind::Po8030d ? all_of(kPo8030d)
                                              : all_of(kPo3030k);
}

/// The sensor gives each fourth pixel, of which the driver takes each second.
drivers::CameraCapture::Request request() { return {kCameraRows, kCameraColumns, kBytesPerPixel, 1, 1}; }

}  // namespace

void PuckCamera::write(int number, int value, Cycle at) {
  board::I2cBus& bus = board_.i2c();
  bus.start(at);
  bus.write(kAddress, at);
  bus.write(static_cast<std::uint8_t>(number), at);
  bus.write(static_cast<std::uint8_t>(value), at);
  bus.stop(at);
}

void PuckCamera::start(Cycle at) {
  if (is_on_) return;
  is_on_ = true;
  // the robot's own picture is of the array's middle; Webots' has the whole field of view
  constexpr int kStep = 8;  // pixels of the array from one column to the next
  if (board::Camera* const camera = board_.camera())
    camera->set_focal_px(0.5 * kStep * kCameraColumns / std::tan(kCameraFovRad / 2));
  taken_.assign(kCameraColumns * kCameraRows * kBytesPerPixel, 0);
  shown_.assign(kCameraColumns * kCameraRows * 4, 0);
  for (std::size_t i = 3; i < shown_.size(); i += 4) shown_[i] = 255;
  const board::Pin reset = board::kCameraResetPin;
  board_.pins().write_bit(reset.letter(), reset.bit, false, at);
  board_.pins().write_bit(reset.letter(), reset.bit, true, at);
  const Registers setup = setup_of(board_.setup().camera);
  int bank = 0;
  for (const CameraRegister* r = setup.first; r != setup.first + setup.count; ++r) {
    if (r->bank != bank) write(kBankRegister, r->bank, at);
    bank = r->bank;
    write(r->number, r->value, at);
  }
  wait_for_frame(at);
}

void PuckCamera::wait_for_frame(Cycle at) {
  next_ = capture_.launch(request(), at);
  awaits_frame_ = true;
  is_whole_ = false;
}

void PuckCamera::run(Cycle at) {
  while (next_ <= at) {
    if (awaits_frame_) {
      awaits_frame_ = false;
      rows_ = 0;
      next_ = capture_.begin_frame(next_);
      continue;
    }
    constexpr int kLine = kCameraColumns * kBytesPerPixel;
    capture_.take_line(taken_.data() + rows_ * kLine, kLine, next_);
    if (++rows_ < kCameraRows) {
      next_ = capture_.next_line();
    } else {
      next_ = board::kNever;
      is_whole_ = true;
    }
  }
}

const std::vector<std::uint8_t>& PuckCamera::picture(Cycle at) {
  if (!is_whole_) return shown_;
  for (std::size_t from = 0, to = 0; from < taken_.size(); from += 2, to += 4) {
    const int first = taken_[from], second = taken_[from + 1];
    const int red = first >> 3, green = (first & 7) << 3 | second >> 5, blue = second & 31;
    // the upper bits again below: full is 255
    shown_[to] = static_cast<std::uint8_t>(blue << 3 | blue >> 2);
    shown_[to + 1] = static_cast<std::uint8_t>(green << 2 | green >> 4);
    shown_[to + 2] = static_cast<std::uint8_t>(red << 3 | red >> 2);
  }
  wait_for_frame(at);
  return shown_;
}

}  // namespace programs
