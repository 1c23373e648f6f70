// SPDX-License-Identifier: MIT
// Noise of the converter's samples: what it follows from, for every way of running a program.
//
// Time is cut into quanta, and a sample's noise is a function of seed, robot, sensor, lamp (dark or lit) and
// the number of the quantum in which the converter holds the input. Nobody counts samples. So it does not
// matter who looks, how often and in what order; a program that drives the converter by itself finds the same
// noise as the library's drivers; and both HALs, whose samples lie some hundred cycles
// apart, draw the same noise unless a quantum happens to end between the two.
//
// Modelled: noise that is independent from one quantum to the next. Not modelled: any change of it within a
// quantum, so a mean over one quantum is no better than a single sample.
#pragma once
#include <cstdint>

#include "hal_sim/board/epuck_params.h"
#include "sim_core/base/hash.h"
#include "sim_core/random/counter_random.h"

namespace board {

/// Quantum of phototransistors and accelerometer, 1.1 ms. Shorter than the time between two samples of one
/// sensor in any of the library's drivers (9.8 ms and more), whose noise is therefore independent. Long
/// beside the distance of equal samples under the two HALs: of obstacle's first two
/// seconds in the maze 400 to 4,700 cycles, so that six samples in seven have the same noise in both; of
/// braitenberg_2a's up to 13,600 and five in eight.
inline constexpr Cycle kSlowNoiseQuantum = 16384;  // [assumed: see above]
/// Quantum of microphones. Shorter than any conversion (14 TAD of at least 334 ns, 69 cycles), so no two
/// samples of a recording share their noise; the library's lie 450 or 965 cycles apart. Between the
/// HALs it differs.
inline constexpr Cycle kMicNoiseQuantum = 64;  // [assumed: see above]

/// What draws: a first number, to which the sensor's own (0 to 7) is added.
enum class NoiseOf : std::uint32_t {
  AmbientDark = 0,
  AmbientLit = 8,
  Reflection = 16,
  Microphone = 24,
  Accelerometer = 28,
};

class SampleNoise {
 public:
  SampleNoise(std::uint64_t seed, int robot)
      : key_(sim::mix64(sim::mix64(seed) ^ (static_cast<std::uint64_t>(robot) << 32 | sim::kStreamBoard))) {}

  /// The noise of the run's beginning comes again, from this cycle on.
  void begin_at(Cycle at) { origin_ = at; }
  Cycle begun_at() const { return origin_; }

  /// Nearly normal, mean 0, standard deviation 1: the sum of eight dice with 256 faces. Nothing lies beyond
  /// 4.9, and 1.6 in a thousand beyond 3 (of a normal distribution 2.7).
  double normal(NoiseOf what, int sensor, Cycle at) const { return kPerFace * dice(what, sensor, at); }
  /// The same before it is scaled: integer, mean 0, standard deviation 1 / kPerFace.
  static constexpr double kPerFace = 0.004784172;  // 1 / sqrt(8 (256^2 - 1) / 12)
  __attribute__((always_inline)) int dice(NoiseOf what, int sensor, Cycle at) const {
    constexpr std::uint64_t kEverySecond = 0x00FF00FF00FF00FFu;
    const std::uint64_t thrown = bits(what, sensor, at);
    const std::uint64_t pairs = (thrown & kEverySecond) + (thrown >> 8 & kEverySecond);
    return static_cast<int>(pairs * 0x0001000100010001u >> 48) - 8 * 255 / 2;
  }
  /// Uniform in [-1, 1).
  double uniform(NoiseOf what, int sensor, Cycle at) const {
    return static_cast<double>(bits(what, sensor, at) >> 11) * 0x1p-52 - 1;
  }

 private:
  std::uint64_t bits(NoiseOf what, int sensor, Cycle at) const {
    const Cycle quantum = what == NoiseOf::Microphone ? kMicNoiseQuantum : kSlowNoiseQuantum;
    const std::uint64_t who = static_cast<std::uint32_t>(what) + static_cast<std::uint32_t>(sensor);
    return sim::mix64(
        key_ ^ (static_cast<std::uint64_t>(at - origin_) / static_cast<std::uint64_t>(quantum) << 5 | who));
  }

  std::uint64_t key_;
  Cycle origin_ = 0;
};

}  // namespace board
