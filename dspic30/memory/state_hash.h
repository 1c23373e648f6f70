// SPDX-License-Identifier: MIT
// Hash of a memory's bytes, for digests: quick, for whoever asks at every tick.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace dspic {

/// `bytes` is a multiple of 32. Four sums side by side: one product a word does not wait for the one before.
inline std::uint64_t hash_of_memory(const void* data, std::size_t bytes) {
  constexpr std::uint64_t kPrime = 0x100000001B3u;
  const auto* at = static_cast<const char*>(data);
  const auto word = [&at](int i) {
    std::uint64_t value;
    std::memcpy(&value, at + 8 * i, 8);
    return value;
  };
  std::uint64_t a = 1, b = 2, c = 3, d = 4;
  for (const char* const end = at + bytes; at < end; at += 32) {
    a = (a ^ word(0)) * kPrime;
    b = (b ^ word(1)) * kPrime;
    c = (c ^ word(2)) * kPrime;
    d = (d ^ word(3)) * kPrime;
  }
  std::uint64_t h = 0;
  for (const std::uint64_t sum : {a, b, c, d}) h = (h ^ sum ^ sum >> 32) * kPrime;
  return h;
}

}  // namespace dspic
