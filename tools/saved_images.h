// SPDX-License-Identifier: MIT
// twinpuck run --save-images FOLDER: every picture that a program gets from its camera as
// FOLDER/ROBOT_000001.png, and so on. Pixels are the bytes the program got, decoded by the sensor's format:
// 565 widened to eight bits a colour by repeating its upper bits, grey as it is, YUV with the chroma of its
// neighbours. Rows and columns as in the buffer.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/board/camera.h"
#include "hal_sim/twin/twin.h"

namespace tools {

/// Three bytes a pixel, rows from the top.
std::vector<std::uint8_t> decode_picture(const board::CameraPicture& picture);

class SavedImages {
 public:
  explicit SavedImages(std::string folder) : folder_(std::move(folder)) {}
  /// Makes the folder and listens to every robot's camera. False and a line in `problems` when it cannot be
  /// made.
  bool open(twin::Twin& twin, std::vector<std::string>& problems);
  /// A file could not be written.
  bool failed() const { return failed_; }
  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
  std::atomic<bool> failed_{false};
};

}  // namespace tools
