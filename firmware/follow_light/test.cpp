// SPDX-License-Identifier: MIT
// follow_light comes to the lamp from wherever it starts, and stays.
#include <cmath>

#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

double away_m(const Robot& robot, const sim::LampDesc& lamp) {
  return std::hypot(robot.x_m() - lamp.position_m.x, robot.y_m() - lamp.position_m.y);
}

class FollowLight : public FirmwareTest, public ::testing::WithParamInterface<int> {};

// twelve starts around the room, each with its own noise, gains and offsets
TEST_P(FollowLight, comes_to_the_lamp_and_stays) {
  load_world("worlds/light.toml");
  const sim::LampDesc lamp = world.lamps[0];
  world.seed = static_cast<std::uint64_t>(GetParam()) + 1;
  world.proximity.noise_scale = 1;
  Robot& puck = robot(0);
  const double bearing = sim::radians(150.0 + 10 * GetParam());
  puck.at(0.48 * std::cos(bearing), 0.48 * std::sin(bearing), 97.0 * GetParam());
  puck.settings().variation.gain_spread = 0.1;
  puck.settings().variation.offset_spread_counts = 10;
  puck.settings().variation.wheel_spread = 0.01;
  ASSERT_TRUE(run_until([&] { return away_m(puck, lamp) < 0.1; }, 30))
      << "still " << away_m(puck, lamp) << " m away";
  double farthest_m = 0;
  run_until(
      [&] {
        farthest_m = std::fmax(farthest_m, away_m(puck, lamp));
        return false;
      },
      15);
  EXPECT_LT(farthest_m, 0.2);
  EXPECT_LE(puck.longest_wall_touch_s(), 0.2);
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Starts, FollowLight, ::testing::Range(0, 12));

TEST_F(FirmwareTest, follow_light_turns_to_a_lamp_behind_it) {
  // the lamp is straight behind; a robot that drove ahead would leave it
  sim::LampDesc lamp;
  lamp.position_m = {-0.4, 0.02, 0.1};
  lamp.intensity_w_m2 = 2;
  lamp.attenuation = {1, 0, 6};
  world.lamps.push_back(lamp);
  Robot& robot = add_robot("follow_light");
  run_for(4);
  EXPECT_LT(robot.x_m(), -0.05);
  EXPECT_LT(std::cos(sim::radians(robot.heading_deg())), -0.8);
  EXPECT_TRUE(robot.led(8));
}

}  // namespace
