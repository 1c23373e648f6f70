// SPDX-License-Identifier: MIT
// Vehicle 3a approaches light, brakes and stops in front of it.
#include "tests/support/light_vehicle.h"

using namespace firmware_test;

namespace {

class Braitenberg3a : public LightVehicle {};

TEST_P(Braitenberg3a, stops_in_front_of_the_lamp) {
  Robot& vehicle = start("braitenberg_3a", GetParam(), 0.7);
  run_for(0.5);
  const auto seen = watch(vehicle, 30);
  EXPECT_GT(seen.front().speed_steps_s, 200);
  double nearest_m = 1;
  for (const Glimpse& g : seen) nearest_m = std::min(nearest_m, g.away_m);
  EXPECT_GT(nearest_m, 0.1) << "ran into the lamp";
  EXPECT_LT(last_speed(seen), 0.01) << "does not stand";
  // an eye that faces the lamp, 0.55 of whose light it gets, reads 500 at 0.196 m from the sensors
  EXPECT_NEAR(seen.back().away_m, 0.22, 0.04);
  EXPECT_LT(seen.back().aside_deg, 20);
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Starts, Braitenberg3a, ::testing::Range(0, 8));

TEST_F(FirmwareTest, braitenberg_3a_drives_on_when_the_lamp_is_off) {
  load_world("worlds/braitenberg.toml");
  world.lamps[0].on = false;
  Robot& vehicle = robot(0);
  vehicle.settings().firmware = "braitenberg_3a";
  run_for(8);
  // equal speeds; the run may end between the two steps of a tick
  EXPECT_NEAR(static_cast<double>(vehicle.left_steps()), static_cast<double>(vehicle.right_steps()), 1);
  EXPECT_NEAR(static_cast<double>(vehicle.left_steps()), 500 * 8, 300);
}

}  // namespace
