// SPDX-License-Identifier: MIT
// The functions of pins_camera.h on the library's camera drivers.
#include "hal_sim/drivers/drivers.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_camera.h"

using drivers::CameraCapture;
using host::Context;

extern "C" {

tp_i64 tp_camera_launch(tp_i64 rows, tp_i64 columns, tp_i64 bytes_per_pixel, tp_i64 skipped_pixels,
                        tp_i64 skipped_lines, tp_i64 in_step) {
  Context& context = Context::current();
  CameraCapture& camera = context.drivers().camera();
  context.note_write();
  if (!camera.has_camera() || rows < 1) return -1;
  // more than any driver asks for
  constexpr tp_i64 kMost = 4096;
  for (tp_i64 number : {rows, columns, bytes_per_pixel, skipped_pixels, skipped_lines})
    if (number < 0 || number > kMost)
      context.trap(TP_TRAP_ADDRESS,
                   "the camera driver's variables were overwritten: an array or pointer out of bounds");
  CameraCapture::Request request;
  request.rows = static_cast<int>(rows);
  request.columns = static_cast<int>(columns);
  request.bytes_per_pixel = static_cast<int>(bytes_per_pixel);
  request.skipped_pixels = static_cast<int>(skipped_pixels);
  request.skipped_lines = static_cast<int>(skipped_lines);
  request.in_step = in_step != 0;
  return camera.launch(request, context.now());
}

tp_i64 tp_camera_begin_frame(void) {
  Context& context = Context::current();
  CameraCapture& camera = context.drivers().camera();
  context.note_write();
  return camera.has_camera() ? camera.begin_frame(context.now()) : -1;
}

tp_i64 tp_camera_take_line(void* to, tp_i64 room) {
  Context& context = Context::current();
  CameraCapture& camera = context.drivers().camera();
  context.note_write();
  return camera.has_camera()
             ? camera.take_line(static_cast<std::uint8_t*>(to), static_cast<int>(room), context.now())
             : 0;
}

tp_i64 tp_camera_next_line(void) {
  const CameraCapture& camera = Context::current().drivers().camera();
  return camera.has_camera() ? camera.next_line() : -1;
}

}  // extern "C"
