// SPDX-License-Identifier: MIT
// From 50 cm and any bearing the robot arrives at the clapping post, in 20 of 20 seeds.
#include <cmath>

#include "sim_core/random/counter_random.h"
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class SoundLocate : public FirmwareTest, public ::testing::WithParamInterface<int> {};

TEST_P(SoundLocate, finds_who_claps_from_half_a_metre) {
  load_world("worlds/clap.toml");
  const sim::RandomKey key{static_cast<std::uint64_t>(GetParam()), 0, 0};
  world.seed = static_cast<std::uint64_t>(GetParam());
  const double bearing = 2 * M_PI * sim::random_uniform(key, 0);
  Robot& r = robot(0);
  r.at(0.5 * std::cos(bearing), 0.5 * std::sin(bearing), 360 * sim::random_uniform(key, 1));
  EXPECT_TRUE(run_until([&] { return r.led(9); }, 25)) << "from " << sim::degrees(bearing) << " degrees";
  const double distance_m = std::hypot(r.x_m(), r.y_m());
  EXPECT_LT(distance_m, 0.11);  // radii of 37 and 30 mm, and the 3 cm at which it sees the post
  // it faces the post
  const double heading = sim::radians(r.heading_deg());
  EXPECT_LT(std::cos(heading) * r.x_m() + std::sin(heading) * r.y_m(), -0.9 * distance_m);
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Seeds, SoundLocate, ::testing::Range(1, 21));

// the first turn alone: within 6 degrees of where the clap came from
TEST_P(SoundLocate, first_turn_aims_well) {
  load_world("worlds/clap.toml");
  const sim::RandomKey key{static_cast<std::uint64_t>(GetParam()), 0, 0};
  world.seed = static_cast<std::uint64_t>(GetParam());
  const double bearing = 2 * M_PI * sim::random_uniform(key, 0);
  Robot& r = robot(0);
  const double start_deg = 360 * sim::random_uniform(key, 1);
  r.at(0.5 * std::cos(bearing), 0.5 * std::sin(bearing), start_deg);
  ASSERT_TRUE(run_until([&] { return r.led(8); }, 3));
  ASSERT_TRUE(run_until([&] { return !r.led(8); }, 6));
  double aim_deg = r.heading_deg() - sim::degrees(bearing) - 180;
  aim_deg -= 360 * std::round(aim_deg / 360);
  EXPECT_NEAR(aim_deg, 0, 6);
}

}  // namespace
