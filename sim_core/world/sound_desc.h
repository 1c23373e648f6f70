// SPDX-License-Identifier: MIT
// What sounds in a world and does not move.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim_core/geometry/pose.h"

namespace sim {

enum class SoundKind { Tone, Noise, Wav, Clap };

/// Something that sounds and does not move.
struct SoundDesc {
  std::string name;
  SoundKind kind = SoundKind::Tone;
  Vec3 position_m{0, 0, 0.035};
  double level_db = 70;                          ///< dB SPL at 1 m; of a clap: of its beginning
  std::optional<double> pressure_pa;             ///< Pa rms at 1 m, instead of the level
  double frequency_hz = 1000;                    ///< of a tone
  std::optional<std::array<double, 2>> band_hz;  ///< of a noise; unset: white
  std::string file;                              ///< WAV, as written
  std::vector<float> samples;                    ///< of the file, -1 to 1; full scale is a sine of the level
  double sample_rate_hz = 0;
  bool loop = true;             ///< the file is repeated
  std::vector<double> times_s;  ///< of claps; empty: one every `every_s` from the start on
  double every_s = 1;
  double jitter_s = 0;                ///< each of these comes later by a random time up to this
  std::optional<std::uint64_t> seed;  ///< unset: the world's
  double start_s = 0;
  double stop_s = 1e300;  ///< silent from then on
  int line = 0;
};

}  // namespace sim
