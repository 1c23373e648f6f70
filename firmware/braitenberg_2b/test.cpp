// SPDX-License-Identifier: MIT
// Vehicle 2b approaches light, accelerating more and more.
#include "tests/support/light_vehicle.h"

using namespace firmware_test;

namespace {

class Braitenberg2b : public LightVehicle {};

TEST_P(Braitenberg2b, arrives_accelerating) {
  Robot& vehicle = start("braitenberg_2b", GetParam(), 0.7);
  run_for(0.5);
  const auto seen = watch(vehicle, 20);
  const auto arrived =
      std::find_if(seen.begin(), seen.end(), [](const Glimpse& g) { return g.away_m < 0.06; });
  ASSERT_NE(arrived, seen.end()) << "never within 6 cm of the lamp";
  EXPECT_GT(arrived->speed_steps_s, 2 * seen.front().speed_steps_s);
  // faster on every stretch of the way
  double before = 0;
  for (const double at_m : {0.45, 0.35, 0.25, 0.15}) {
    const auto there =
        std::find_if(seen.begin(), seen.end(), [&](const Glimpse& g) { return g.away_m < at_m; });
    EXPECT_GT(there->speed_steps_s, before) << at_m;
    EXPECT_LT(there->aside_deg, 35) << at_m;
    before = there->speed_steps_s;
  }
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Starts, Braitenberg2b, ::testing::Range(0, 8));

}  // namespace
