// SPDX-License-Identifier: MIT
// Counter-based random numbers for the board: a number depends only on (seed, robot, sensor, sample), never on
// what was drawn before. mix64 is the finaliser of splitmix64, a public-domain bit mixer.
#pragma once
#include <cmath>
#include <cstdint>

namespace board {

constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Who draws what: one stream per sensor and purpose.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint32_t robot = 0;
  std::uint32_t stream = 0;
};

constexpr std::uint64_t noise_bits(const NoiseKey& key, std::uint64_t sample) {
  const std::uint64_t who = (std::uint64_t{key.robot} << 32) | key.stream;
  return mix64(mix64(mix64(key.seed) ^ who) ^ sample);
}

/// Uniform in [-1, 1).
constexpr double noise_uniform(const NoiseKey& key, std::uint64_t sample) {
  return static_cast<double>(noise_bits(key, sample) >> 11) * 0x1p-52 - 1.0;
}

/// Normal, mean 0, standard deviation 1 (Box-Muller, cosine half).
inline double noise_gaussian(const NoiseKey& key, std::uint64_t sample) {
  const std::uint64_t bits = noise_bits(key, sample);
  const double u = (static_cast<double>(bits >> 11) + 1.0) * 0x1p-53;
  const double v = static_cast<double>(mix64(bits) >> 11) * 0x1p-53;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
}

}  // namespace board
