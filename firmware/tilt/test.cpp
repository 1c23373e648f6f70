// SPDX-License-Identifier: MIT
// tilt climbs its ramp, and shows the lowest side.
#include <cmath>

#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class Tilt : public FirmwareTest {};

TEST_F(Tilt, climbs_the_ramp_and_stops_on_the_platform) {
  load_world("worlds/ramp.toml");
  EXPECT_TRUE(run_until([&] { return robot(0).led(8); }, 30)) << "body LED: arrived";
  const double x_m = robot(0).x_m();
  EXPECT_GT(x_m, 0.22) << "the platform begins at 0.2";
  EXPECT_LT(x_m, 0.36);
  EXPECT_NEAR(twin().simulation().state(0).z_m, 0.05, 1e-6);
  EXPECT_EQ(robot(0).collisions(), 0);
  run_for(1);
  EXPECT_NEAR(robot(0).x_m(), x_m, 0.002) << "it stays";
  expect_no_traps();
}

TEST_F(Tilt, a_slanting_start_is_corrected_uphill) {
  load_world("worlds/ramp.toml");
  robot(0).settings().pose = {-0.2, -0.06, sim::radians(25)};
  ASSERT_TRUE(run_until([&] { return twin().simulation().state(0).z_m > 0.03; }, 20));
  EXPECT_NEAR(robot(0).heading_deg(), 0, 6);
}

TEST_F(Tilt, shows_the_lowest_side) {
  // calibrated on the level, then put on a ramp that rises by 12 degrees towards +x. Ring LEDs are numbered
  // clockwise from the front: a robot that looks 45 n degrees to the left of downhill has it at LED n
  sim::RampDesc ramp;
  ramp.pose = {5, 0, 0};
  ramp.size_m = {2, 2};
  ramp.high_m = 2 * std::tan(sim::radians(12));
  world.ramps.push_back(ramp);
  for (int n = 0; n < 8; ++n) add_robot("tilt").at(0.1 * n, 0).selector(1);
  run_for(0.5);
  for (int n = 0; n < 8; ++n) robot(n).push_to(5 - 0.4 + 0.1 * n, 0, 180 + 45.0 * n);
  run_for(0.5);
  for (int n = 0; n < 8; ++n) EXPECT_EQ(robot(n).leds() & 0xFF, 1u << n) << n;
}

}  // namespace
