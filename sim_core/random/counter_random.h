// SPDX-License-Identifier: MIT
// Counter-based random numbers: pure functions of (seed, robot, stream, counter). Nothing is stored, so a
// sample may be drawn only when somebody reads it, in any order, on any thread, and adding a robot changes no
// other's noise. Each draw mixes the four words through splitmix64's finaliser (base/hash.h).
#pragma once
#include <cmath>
#include <cstdint>

#include "sim_core/base/hash.h"
#include "sim_core/base/portable_math.h"

namespace sim {

/// Who draws. A robot's streams are numbered by purpose; 64.. are free for boards (one per sensor, say).
struct RandomKey {
  std::uint64_t seed = 0;    ///< the world's seed, or the robot's own where it has one
  std::uint32_t robot = 0;   ///< index of the robot in the world
  std::uint32_t stream = 0;  ///< kStream* below, or a board's own from 64 on
};

inline constexpr std::uint32_t kStreamVariation =
    1;  ///< spread of a robot's parts, drawn once when it is built
inline constexpr std::uint32_t kStreamWheelLeft = 2;   ///< wheel noise
inline constexpr std::uint32_t kStreamWheelRight = 3;  ///< wheel noise
inline constexpr std::uint32_t kStreamBoard = 64;      ///< first stream that hal_sim may use as it likes

/// 64 random bits.
constexpr std::uint64_t random_bits(const RandomKey& key, std::uint64_t counter) {
  const std::uint64_t who = (static_cast<std::uint64_t>(key.robot) << 32) | key.stream;
  return mix64(mix64(mix64(key.seed) ^ who) ^ counter);
}

/// Uniform in [0, 1), 53 bits.
constexpr double random_uniform(const RandomKey& key, std::uint64_t counter) {
  return static_cast<double>(random_bits(key, counter) >> 11) * 0x1p-53;
}

/// Uniform in [-1, 1).
constexpr double random_signed(const RandomKey& key, std::uint64_t counter) {
  return 2.0 * random_uniform(key, counter) - 1.0;
}

/// Normal with mean 0 and standard deviation 1 (Box-Muller; the sine half is not used, so a draw stays pure).
inline double random_gaussian(const RandomKey& key, std::uint64_t counter) {
  const std::uint64_t bits = random_bits(key, counter);
  const double u = (static_cast<double>(bits >> 11) + 1.0) * 0x1p-53;  // (0, 1]: the logarithm stays finite
  const double v = static_cast<double>(mix64(bits) >> 11) * 0x1p-53;
  return std::sqrt(-2.0 * natural_log(u)) * sin_cos(6.283185307179586 * v).c;
}

}  // namespace sim
