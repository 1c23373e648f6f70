// SPDX-License-Identifier: MIT
// Vehicle 2a avoids light by accelerating away from it.
#include "tests/support/light_vehicle.h"

using namespace firmware_test;

namespace {

class Braitenberg2a : public LightVehicle {};

const Glimpse& fastest_of(const std::vector<Glimpse>& seen) {
  return *std::max_element(seen.begin(), seen.end(), [](const Glimpse& a, const Glimpse& b) {
    return a.speed_steps_s < b.speed_steps_s;
  });
}

TEST_P(Braitenberg2a, leaves_accelerating) {
  Robot& vehicle = start("braitenberg_2a", GetParam(), 0.5);
  run_for(0.5);
  const auto seen = watch(vehicle, 30);
  // in the light it flees far faster than in the dark, the lamp already aside
  EXPECT_GT(fastest_of(seen).speed_steps_s, 1.6 * 200);
  if (GetParam() == 3 || GetParam() == 4) {  // the lamp nearly ahead: it speeds up before it is round
    EXPECT_GT(fastest_of(seen).speed_steps_s, 1.05 * seen.front().speed_steps_s);
  }
  const auto turned =
      std::find_if(seen.begin(), seen.end(), [](const Glimpse& g) { return g.aside_deg > 90; });
  ASSERT_NE(turned, seen.end()) << "did not turn away";
  EXPECT_GT(turned->speed_steps_s, 1.2 * 200);
  // then it leaves the lamp behind and calms down in the dark
  EXPECT_GT(seen.back().away_m, 0.7);
  EXPECT_GT(seen.back().aside_deg, 120);
  EXPECT_NEAR(last_speed(seen), 200, 20);  // SLOW; commands 20 times a second cost it half a step each
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Starts, Braitenberg2a, ::testing::Range(0, 8));

class Braitenberg2aNear : public LightVehicle {};

TEST_P(Braitenberg2aNear, flees_faster_the_nearer_it_was) {
  // twice the light at least: 1600 / (1 + 20 d2) counts at d metres
  Robot& vehicle = start("braitenberg_2a", GetParam(), 0.3);
  run_for(0.5);
  EXPECT_GT(fastest_of(watch(vehicle, 10)).speed_steps_s, 2.2 * 200);
}

INSTANTIATE_TEST_SUITE_P(Starts, Braitenberg2aNear, ::testing::Values(1, 6));

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
