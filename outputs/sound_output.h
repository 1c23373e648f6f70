// SPDX-License-Identifier: MIT
// --save-sound: what each robot's loudspeaker was given, as FOLDER/<robot>.wav, 7200 samples a second from
// the world's beginning on. A robot that never switches its codec on has no file.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"

namespace sim {
class WavRecorder;
}

namespace outputs {

class SoundOutput {
 public:
  SoundOutput(std::string folder, twin::Twin& twin);
  ~SoundOutput();
  /// Creates the folder; false and a line in `problems` when that fails.
  bool open(std::vector<std::string>& problems);
  void after_tick();
  /// First error of any file; empty: none.
  const std::string& error() const { return error_; }

 private:
  std::string folder_;
  twin::Twin& twin_;
  std::int64_t next_ = 0;  // sample number
  std::vector<std::unique_ptr<sim::WavRecorder>> files_;
  std::vector<std::int16_t> samples_;
  std::string error_;
};

}  // namespace outputs
