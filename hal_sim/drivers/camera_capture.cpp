// SPDX-License-Identifier: MIT
#include "hal_sim/drivers/camera_capture.h"

#include <algorithm>

#include "hal_sim/board/camera.h"
#include "hal_sim/drivers/driver_params.h"

namespace drivers {

Cycle CameraCapture::launch(const Request& request, Cycle at) {
  request_ = request;
  row_ = request.rows;  // nothing to take before begin_frame()
  return camera_->await_frame(at);
}

Cycle CameraCapture::begin_frame(Cycle at) {
  const int byte_half_cycles = std::max(1, camera_->setup_at(at).byte_half_cycles);
  board::Camera::Cut cut;
  cut.columns = request_.columns;
  cut.rows = request_.rows;
  cut.row_step = 1 + request_.skipped_lines;
  for (int column = 0; column < request_.columns; ++column)
    for (int part = 0; part < request_.bytes_per_pixel; ++part) {
      const int turn = column * request_.bytes_per_pixel * (1 + request_.skipped_pixels) + part;
      cut.bytes.push_back(static_cast<int>(2 * (kFirstByteCycles + kMaskCycles * turn) / byte_half_cycles));
    }
  line_.resize(cut.bytes.size());
  row_ = 0;
  camera_->begin_frame(std::move(cut), at);
  return next_line();
}

int CameraCapture::take_line(std::uint8_t* to, int room, Cycle at) {
  if (row_ >= request_.rows) return 0;
  camera_->put_line(row_++, line_.data(), at);
  const int count = static_cast<int>(line_.size());
  std::copy_n(line_.data(), std::clamp(room, 0, count), to);
  return count;
}

Cycle CameraCapture::next_line() const { return camera_->line_at(row_); }

}  // namespace drivers
