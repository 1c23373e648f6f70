// SPDX-License-Identifier: MIT
// The robot in the air: what its microphones hear of the scene's sound field, and what its loudspeaker
// (codec.h) tells that field.
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "hal_sim/board/sound_params.h"
#include "hal_sim/board/specimen.h"

namespace sim {
class SoundField;
}

namespace board {

class Codec;

class Ears {
 public:
  explicit Ears(const Specimen& robot);

  /// Counts of microphone 0 right, 1 left, 2 back that is held at `at`: 0 to 4095. Linear, all frequencies
  /// alike; noise: noise.h. A converter asks 50,000 times a second.
  int counts(int microphone, Cycle at) const {
    return robot_.is_sounding() ? counts_in_sound(microphone, at) : with_noise(kSilence, microphone, at);
  }
  /// Tells the air what the loudspeaker began or ended, at the tick boundary `now`.
  void publish(Codec& codec, sim::SoundField& field, sim::Clicks now);

 private:
  /// Levels are in 2^-kFraction counts, whole.
  static constexpr int kFraction = 24;
  static constexpr auto kSilence = static_cast<std::int64_t>((kMicIdleCounts + 0.5) * (1 << kFraction));

  __attribute__((noinline)) int counts_in_sound(int microphone, Cycle at) const;
  int with_noise(std::int64_t level, int microphone, Cycle at) const {
    level += noise_per_face_ * robot_.noise().dice(NoiseOf::Microphone, microphone, at);
    return static_cast<int>(std::clamp<std::int64_t>(level >> kFraction, 0, kAdcMax));
  }

  const Specimen& robot_;
  std::int64_t noise_per_face_;                              // of SampleNoise::dice(), as levels
  std::shared_ptr<const std::vector<std::int16_t>> on_air_;  // samples of the codec's line that the air plays
};

}  // namespace board
