// SPDX-License-Identifier: MIT
// The world's one clock. It counts integer clicks; every tick rate that a world may choose divides the click
// rate, so time is exact everywhere. Nothing here reads the host's clock.
#pragma once
#include <cstdint>

namespace sim {

/// Time since the world began, in clicks. Never negative in a running world.
using Clicks = std::int64_t;

/// 2^16 * 3^2 * 5^2: divisible by the tick rates 96, 128, 256, 512, 960, 1024 (Hz).
inline constexpr Clicks kClicksPerSecond = 14'745'600;

constexpr double to_seconds(Clicks t) {
  return static_cast<double>(t) / static_cast<double>(kClicksPerSecond);
}

/// Nearest click; seconds may be up to about 600,000,000.
constexpr Clicks from_seconds(double s) {
  return static_cast<Clicks>(s * static_cast<double>(kClicksPerSecond) + (s < 0 ? -0.5 : 0.5));
}

}  // namespace sim
