// SPDX-License-Identifier: MIT
// Vehicle 2a avoids light by accelerating away from it.
#include "tests/support/light_vehicle.h"

using namespace firmware_test;

namespace {

class Braitenberg2a : public LightVehicle {};

TEST_P(Braitenberg2a, leaves_accelerating) {
  Robot& vehicle = start("braitenberg_2a", GetParam());
  run_for(0.5);
  const double first = watch(vehicle, 0.5).back().speed_steps_s;
  const auto seen = watch(vehicle, 30);
  const auto fastest = std::max_element(seen.begin(), seen.end(), [](const Glimpse& a, const Glimpse& b) {
    return a.speed_steps_s < b.speed_steps_s;
  });
  // swerves faster than it came, the lamp already aside; then leaves it behind and calms down in the dark
  EXPECT_GT(fastest->speed_steps_s, 1.1 * first);
  EXPECT_GT(fastest->aside_deg, 30);
  EXPECT_GT(seen.back().away_m, kStartM);
  EXPECT_GT(seen.back().aside_deg, 120);
  EXPECT_NEAR(last_speed(seen), 200, 20);  // SLOW; commands 20 times a second cost it half a step each
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Starts, Braitenberg2a, ::testing::Range(0, 8));

TEST_F(FirmwareTest, braitenberg_2a_goes_straight_in_the_dark) {
  load_world("worlds/braitenberg.toml");
  world.lamps[0].on = false;
  Robot& vehicle = robot(0);
  vehicle.settings().firmware = "braitenberg_2a";
  run_for(5);
  EXPECT_EQ(vehicle.left_steps(), vehicle.right_steps());
  EXPECT_NEAR(static_cast<double>(vehicle.left_steps()), 200 * 5,
              150);  // less the start of the scan and half a step a command
}

}  // namespace
