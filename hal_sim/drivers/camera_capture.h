// SPDX-License-Identifier: MIT
// The library's fast camera driver: which lines and bytes of a frame it takes.
//
//   launch() --VSYNC--> begin_frame() --HREF--> take_line() --HREF--> take_line() ...
//
// It (camera/fast_2_timer) reads the data pins every kMaskCycles from kFirstByteCycles after HREF on and does
// not look at the pixel clock.
#pragma once
#include <cstdint>
#include <vector>

#include "hal_sim/board/cycle.h"

namespace board {
class Camera;
}

namespace drivers {

using board::Cycle;

class CameraCapture {
 public:
  /// `camera`: null where the robot carries none; nothing but reset() may be called then. It outlives this.
  explicit CameraCapture(board::Camera* camera) : camera_(camera) {}

  /// What a program wants of a frame.
  struct Request {
    int rows = 0, columns = 0;
    int bytes_per_pixel = 1;
    int skipped_pixels = 0;  ///< between two that are taken
    int skipped_lines = 0;   ///< between two that are taken
  };
  /// The driver waits for the next frame. Replaces a request before it. Returns the cycle of VSYNC.
  Cycle launch(const Request& request, Cycle at);
  /// VSYNC has come. Returns the cycle of the first line's HREF.
  Cycle begin_frame(Cycle at);
  /// The next line's bytes: at most `room` are put to `to`; returns how many there are, 0 after the last
  /// line. `at`: its HREF.
  int take_line(std::uint8_t* to, int room, Cycle at);
  /// HREF of the line after the one taken last.
  Cycle next_line() const;
  /// The driver's variables return to their start values.
  void reset() { row_ = request_.rows = 0; }

 private:
  board::Camera* camera_;
  Request request_;
  int row_ = 0;
  std::vector<std::uint8_t> line_;
};

}  // namespace drivers
