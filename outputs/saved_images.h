// SPDX-License-Identifier: MIT
// twinpuck run --save-images FOLDER: every picture that a program gets from its camera as
// FOLDER/ROBOT_000001.png, and so on. Rows and columns as in the buffer.
#pragma once
#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "hal_sim/board/camera.h"
#include "hal_sim/twin/twin.h"

namespace outputs {

class SavedImages {
 public:
  explicit SavedImages(std::string folder) : folder_(std::move(folder)) {}
  /// Makes the folder and listens to every robot's camera. False and a line in `problems`
  /// when it cannot be made.
  bool open(twin::Twin& twin, std::vector<std::string>& problems);
  /// A file could not be written.
  bool failed() const { return failed_; }
  /// The first one: "FOLDER: --save-images: FILE: cannot be written: reason".
  std::string error() const;
  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
  std::atomic<bool> failed_{false};
  mutable std::mutex writing_;  // robots take pictures on several threads
  std::string first_;
};

}  // namespace outputs
