// SPDX-License-Identifier: MIT
// Order-dependent 64-bit mixing for digests: not for security, only to notice any changed bit.
#pragma once
#include <cstdint>
#include <cstring>

namespace sim {

/// Finaliser of splitmix64: every input bit reaches every output bit. [Steele, Lea, Flood 2014]
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Folds a word into a running hash; cheap, and the order of words matters.
constexpr std::uint64_t fold(std::uint64_t hash, std::uint64_t word) {
  hash ^= word;
  hash *= 0x9fb21c651e98df25ull;
  return hash ^ (hash >> 29);
}

/// Folds the bits of a number (so that -0 and 0 differ, as they should in a bit-exact digest).
inline std::uint64_t fold(std::uint64_t hash, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return fold(hash, bits);
}

}  // namespace sim
