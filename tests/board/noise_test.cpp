// SPDX-License-Identifier: MIT
// Noise of the converter's samples: its distribution, and what it depends on.
#include "hal_sim/board/noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using board::Cycle;
using board::NoiseOf;
using board::SampleNoise;

constexpr Cycle kQuantum = board::kSlowNoiseQuantum;
constexpr int kDraws = 200'000;

// limits are four to five standard errors: mean 1 / sqrt(n) = 0.0022, sigma 1 / sqrt(2 n) = 0.0016, fourth
// moment sqrt(96 / n) = 0.022, tails sqrt(p / n)
TEST(SampleNoise, is_normal_with_mean_0_and_sigma_1) {
  const SampleNoise noise(7, 3);
  double sum = 0, squares = 0, cubes = 0, fourths = 0;
  std::array<int, 4> beyond{};  // 0, 1, 2, 3 sigma, upwards
  for (Cycle i = 0; i < kDraws; ++i) {
    const double x = noise.normal(NoiseOf::Reflection, 2, i * kQuantum);
    sum += x, squares += x * x, cubes += x * x * x, fourths += x * x * x * x;
    for (std::size_t k = 0; k < beyond.size(); ++k) beyond[k] += x > static_cast<double>(k) ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 1, 0.007);
  EXPECT_NEAR(cubes / kDraws, 0, 0.04);
  // eight dice: 3 - 1.2 / 8
  EXPECT_NEAR(fourths / kDraws, 2.85, 0.1);
  // the sum of eight dice, counted out; a normal distribution's tails are 0.5, 0.1587, 0.0228 and 0.0014
  EXPECT_NEAR(1.0 * beyond[0] / kDraws, 0.5, 0.005);
  EXPECT_NEAR(1.0 * beyond[1] / kDraws, 0.1612, 0.004);
  EXPECT_NEAR(1.0 * beyond[2] / kDraws, 0.0219, 0.0015);
  EXPECT_NEAR(1.0 * beyond[3] / kDraws, 0.00082, 0.0003);
}

/// Correlation of two draws at the same and at neighbouring quanta.
template <class One, class Other>
void expect_independent(One one, Other other) {
  double same = 0, next = 0;
  for (Cycle i = 0; i < kDraws; ++i) {
    const double a = one(i * kQuantum);
    same += a * other(i * kQuantum);
    next += a * other((i + 1) * kQuantum);
  }
  EXPECT_NEAR(same / kDraws, 0, 0.011);
  EXPECT_NEAR(next / kDraws, 0, 0.011);
}

TEST(SampleNoise, is_the_seeds_the_robots_the_sensors_and_the_lamps_own) {
  const auto draw = [](std::uint64_t seed, int robot, NoiseOf what, int sensor) {
    return
        [noise = SampleNoise(seed, robot), what, sensor](Cycle at) { return noise.normal(what, sensor, at); };
  };
  const auto one = draw(1, 0, NoiseOf::AmbientDark, 0);
  expect_independent(one, draw(2, 0, NoiseOf::AmbientDark, 0));
  expect_independent(one, draw(1, 1, NoiseOf::AmbientDark, 0));
  expect_independent(one, draw(1, 0, NoiseOf::AmbientDark, 1));
  expect_independent(one, draw(1, 0, NoiseOf::AmbientLit, 0));
  expect_independent(one, draw(1, 0, NoiseOf::Reflection, 0));
  expect_independent(draw(1, 0, NoiseOf::Microphone, 0), draw(1, 0, NoiseOf::Microphone, 2));
  expect_independent(draw(1, 0, NoiseOf::Microphone, 2), draw(1, 0, NoiseOf::Accelerometer, 0));
  // neighbouring quanta of one sensor, and samples as far apart as the library's
  double next = 0, library = 0;
  for (Cycle i = 0; i < kDraws; ++i) {
    next += one(i * kQuantum) * one((i + 1) * kQuantum);
    library += one(i * 58'500) * one((i + 1) * 58'500);
  }
  EXPECT_NEAR(next / kDraws, 0, 0.011);
  EXPECT_NEAR(library / kDraws, 0, 0.011);
}

TEST(SampleNoise, is_one_within_a_quantum) {
  const SampleNoise noise(1, 0);
  for (const auto& [what, quantum] : {std::pair{NoiseOf::AmbientDark, board::kSlowNoiseQuantum},
                                      std::pair{NoiseOf::Accelerometer, board::kSlowNoiseQuantum},
                                      std::pair{NoiseOf::Microphone, board::kMicNoiseQuantum}}) {
    const double first = noise.normal(what, 1, 1000 * quantum);
    EXPECT_EQ(noise.normal(what, 1, 1001 * quantum - 1), first);
    EXPECT_NE(noise.normal(what, 1, 1001 * quantum), first);
    EXPECT_NE(noise.normal(what, 1, 1000 * quantum - 1), first);
  }
}

TEST(SampleNoise, uniform_noise_fills_its_range) {
  const SampleNoise noise(1, 0);
  double least = 1, most = -1, sum = 0, squares = 0;
  for (Cycle i = 0; i < kDraws; ++i) {
    const double x = noise.uniform(NoiseOf::Reflection, 7, i * kQuantum);
    least = std::min(least, x), most = std::max(most, x), sum += x, squares += x * x;
  }
  EXPECT_GE(least, -1);
  EXPECT_LT(least, -0.9999);
  EXPECT_LT(most, 1);
  EXPECT_GT(most, 0.9999);
  EXPECT_NEAR(sum / kDraws, 0, 0.006);
  EXPECT_NEAR(squares / kDraws, 1.0 / 3, 0.003);
}

}  // namespace
