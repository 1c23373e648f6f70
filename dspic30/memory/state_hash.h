// SPDX-License-Identifier: MIT
// Hash of a memory's bytes, for digests: quick, for whoever asks at every tick.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace dspic {

/// `bytes` is a multiple of 32. Four sums side by side: one product a word does not wait for the one before.
inline std::uint64_t hash_of_memory(const void* data, std::size_t bytes) {
  constexpr std::uint64_t kPrime = 0x100000001B3u;
  std::array<std::uint64_t, 4> sums = {1, 2, 3, 4};
  for (const auto *at = static_cast<const char*>(data), *end = at + bytes; at < end; at += 32) {
    std::array<std::uint64_t, 4> words;
    std::memcpy(words.data(), at, 32);
    for (std::size_t i = 0; i < 4; ++i) sums[i] = (sums[i] ^ words[i]) * kPrime;
  }
  std::uint64_t h = 0;
  for (const std::uint64_t sum : sums) h = (h ^ sum ^ sum >> 32) * kPrime;
  return h;
}

}  // namespace dspic
