// SPDX-License-Identifier: MIT
#include "outputs/sound_output.h"

#include "hal_sim/board/sound_params.h"
#include "outputs/output_folder.h"
#include "sim_core/sound/wav_file.h"

namespace outputs {

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
  return make_output_folder(folder_, "--save-sound", problems);
}

void SoundOutput::after_tick() {
  const sim::Clicks now = twin_.simulation().now();
  const std::int64_t end = (now + kSampleClicks - 1) / kSampleClicks;  // samples of instants before now
  for (int r = 0; r < twin_.robots() && error_.empty(); ++r) {
    const board::Board& robot = twin_.mind(r).board();
    if (!robot.codec().was_used()) continue;
    auto& file = files_[static_cast<std::size_t>(r)];
    if (!file) {
      file = std::make_unique<sim::WavRecorder>(output_file(folder_, twin_.world(), r) + ".wav", kRateHz);
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

}  // namespace outputs
