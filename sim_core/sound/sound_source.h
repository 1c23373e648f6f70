// SPDX-License-Identifier: MIT
// One [[sound]] of the world: its pressure at 1 m as a pure function of time. Nothing is stored from one
// question to the next; noise and claps are drawn by key and counter.
//   tone   a sine that begins at 0 when the sound starts
//   noise  white: normal draws on a 44.1 kHz grid, linear in between; with a band: 32 sines of random
//          frequency and phase, spread evenly over the band
//   wav    samples of a file, linear in between, repeated or not
//   clap   a burst of sines of random frequency and phase under an envelope that dies away
#pragma once
#include <cstdint>
#include <vector>

#include "sim_core/geometry/pose.h"
#include "sim_core/random/counter_random.h"
#include "sim_core/world/sound_desc.h"

namespace sim {

class SoundSource {
 public:
  /// `number` of the source in its world; `world_seed` seeds it when the description names no seed.
  SoundSource(const SoundDesc& desc, std::uint64_t world_seed, int number);

  const Vec3& position_m() const { return desc_.position_m; }
  /// Pressure at 1 m that leaves the source at `at_s` (s since the world began), Pa.
  double pressure_pa(double at_s) const;
  /// When clap `number` (0, 1, ...) begins, s; past the end of a list: beyond all times.
  double clap_s(std::int64_t number) const;

 private:
  struct Partial {
    double frequency_hz;
    double turn;  // phase, turns
  };
  static std::vector<Partial> partials(const RandomKey& key, std::uint64_t draw, int count, double low_hz,
                                       double high_hz);
  static double sum_at(const std::vector<Partial>& partials, double s);
  double white(double since_s) const;
  double sample(double since_s) const;
  double claps(double at_s) const;
  double burst(std::int64_t number, double since_s) const;

  SoundDesc desc_;
  RandomKey key_;
  double rms_pa_;
  std::vector<Partial> band_;
};

/// Root mean square pressure of a sound level, Pa.
double pressure_of_level_pa(double level_db);

}  // namespace sim
