// SPDX-License-Identifier: MIT
// The camera of Webots' e-puck, 52 x 39 pixels, taken with the robot's own: each eighth pixel of the
// middle of its array in RGB565, frame after frame at its own rate, one being taken while the program
// looks at the one before.
#pragma once
#include <cstdint>
#include <vector>

#include "hal_sim/board/board.h"
#include "hal_sim/drivers/camera_capture.h"

namespace programs {

using board::Cycle;

inline constexpr int kCameraColumns = 52,
                     kCameraRows = 39;         ///< [Webots: E-puck.proto, camera_width, camera_height]
inline constexpr double kCameraFovRad = 0.84;  ///< [Webots: E-puck.proto, camera_fieldOfView]

class PuckCamera {
 public:
  /// The robot carries a camera.
  PuckCamera(board::Board& board, drivers::CameraCapture& capture) : board_(board), capture_(capture) {}

  /// Resets the sensor, sets it up and waits for the first frame; once.
  void start(Cycle at);
  /// The newest picture that is whole, four bytes a pixel: blue, green, red, 255; black before the first. The
  /// next frame is waited for.
  const std::vector<std::uint8_t>& picture(Cycle at);

  /// A frame or a line begins; kNever: nothing is waited for.
  Cycle next_event() const { return next_; }
  void run(Cycle at);

 private:
  void write(int number, int value, Cycle at);
  void wait_for_frame(Cycle at);

  board::Board& board_;
  drivers::CameraCapture& capture_;
  bool is_on_ = false, is_whole_ = false;
  bool awaits_frame_ = false;  // else lines
  Cycle next_ = board::kNever;
  int rows_ = 0;  // taken so far
  std::vector<std::uint8_t> taken_, shown_;
};

}  // namespace programs
