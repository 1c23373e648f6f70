// SPDX-License-Identifier: MIT
// Vehicle 3b avoids light by braking, and accelerates away toward darker areas.
#include "tests/support/light_vehicle.h"

using namespace firmware_test;

namespace {

class Braitenberg3b : public LightVehicle {};

TEST_P(Braitenberg3b, turns_away_braking_and_goes_on_faster_in_the_dark) {
  Robot& vehicle = start("braitenberg_3b", GetParam());
  run_for(0.5);
  const double first = watch(vehicle, 0.5).back().speed_steps_s;
  const auto seen = watch(vehicle, 30);
  const auto slowest = std::min_element(seen.begin(), seen.end(), [](const Glimpse& a, const Glimpse& b) {
    return a.speed_steps_s < b.speed_steps_s;
  });
  EXPECT_LT(slowest->speed_steps_s, 0.8 * first) << "did not brake";
  EXPECT_GT(slowest->away_m, 0.08) << "reached the lamp";
  EXPECT_GT(seen.back().away_m, kStartM + 0.1);
  EXPECT_GT(seen.back().aside_deg, 120);
  EXPECT_GT(last_speed(seen), 1.5 * slowest->speed_steps_s);
  EXPECT_NEAR(last_speed(seen), 500, 15);  // its speed in the dark
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Starts, Braitenberg3b, ::testing::Range(0, 8));

}  // namespace
