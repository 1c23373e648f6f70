// SPDX-License-Identifier: MIT
#include "tools/sound_output.h"

#include <algorithm>
#include <filesystem>

#include "hal_sim/board/sound_params.h"
#include "sim_core/record/wav_recorder.h"

namespace tools {

namespace {
constexpr int kRateHz = static_cast<int>(board::kFcyHz / board::kCodecSampleCycles);
constexpr sim::Clicks kSampleClicks = sim::kClicksPerSecond / kRateHz;
static_assert(kSampleClicks * kRateHz == sim::kClicksPerSecond);
}  // namespace

SoundOutput::SoundOutput(std::string folder, twin::Twin& twin) : folder_(std::move(folder)), twin_(twin) {
  files_.resize(static_cast<std::size_t>(twin.robots()));
}
SoundOutput::~SoundOutput() = default;

bool SoundOutput::open(std::vector<std::string>& problems) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (!error && std::filesystem::is_directory(folder_)) return true;
  problems.push_back(folder_ + ": --save-sound: got '" + (error ? error.message() : "Not a directory") +
                     "', expected a folder that can be created");
  return false;
}

std::string SoundOutput::file_of(int robot) const {
  std::string name = twin_.world().robots[static_cast<std::size_t>(robot)].name;
  if (name.find('/') != std::string::npos || name[0] == '.') {
    std::replace(name.begin(), name.end(), '/', '_');
    name = std::to_string(robot) + "_" + name;
  }
  return folder_ + "/" + name + ".wav";
}

void SoundOutput::after_tick() {
  const sim::Clicks now = twin_.simulation().now();
  const std::int64_t end = (now + kSampleClicks - 1) / kSampleClicks;  // samples of instants before now
  for (int r = 0; r < twin_.robots() && error_.empty(); ++r) {
    const board::Board& robot = twin_.mind(r).board();
    if (!robot.codec().was_used()) continue;
    auto& file = files_[static_cast<std::size_t>(r)];
    if (!file) {
      file = std::make_unique<sim::WavRecorder>(file_of(r), kRateHz);
      file->append(std::vector<std::int16_t>(static_cast<std::size_t>(next_)));
    }
    samples_.clear();
    for (std::int64_t n = next_; n < end; ++n)
      samples_.push_back(
          static_cast<std::int16_t>(robot.codec().output(robot.clock().cycle_at(n * kSampleClicks))));
    file->append(samples_);
    error_ = file->error();
  }
  next_ = end;
}

}  // namespace tools
