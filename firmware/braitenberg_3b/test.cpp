// SPDX-License-Identifier: MIT
// Vehicle 3b avoids light by braking, and accelerates away toward darker areas.
#include "tests/support/light_vehicle.h"

using namespace firmware_test;

namespace {

class Braitenberg3b : public LightVehicle {};

TEST_P(Braitenberg3b, turns_away_braking_and_goes_on_faster_in_the_dark) {
  Robot& vehicle = start("braitenberg_3b", GetParam(), 0.5);
  run_for(0.5);
  const double aside_first = aside_deg(vehicle);
  const auto seen = watch(vehicle, 30);
  const auto slowest = std::min_element(seen.begin(), seen.end(), [](const Glimpse& a, const Glimpse& b) {
    return a.speed_steps_s < b.speed_steps_s;
  });
  // in the light it brakes to less than three quarters of its speed in the dark, and there it turns
  EXPECT_LT(slowest->speed_steps_s, 0.75 * 500) << "did not brake";
  EXPECT_GT(slowest->away_m, 0.1) << "reached the lamp";
  const auto turned =
      std::find_if(seen.begin(), seen.end(), [](const Glimpse& g) { return g.aside_deg > 90; });
  ASSERT_NE(turned, seen.end()) << "did not turn away";
  EXPECT_LT(aside_first, 45);
  EXPECT_LT(turned->away_m, 0.6) << "turned only when it was far";
  EXPECT_GT(turned->speed_steps_s, slowest->speed_steps_s);
  EXPECT_GT(seen.back().away_m, 0.8);
  EXPECT_GT(seen.back().aside_deg, 120);
  EXPECT_NEAR(last_speed(seen), 500, 25);  // FAST, less half a step for each of 20 commands a second
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Starts, Braitenberg3b, ::testing::Range(0, 8));

}  // namespace
