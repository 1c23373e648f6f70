// SPDX-License-Identifier: MIT
// U obstacle leaves the lab's corridor, and shows what black paint does to infra-red sensors.
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

constexpr double kMouthM = -0.25;  // x at which the whole robot is out

class UObstacle : public FirmwareTest, public ::testing::WithParamInterface<int> {
 protected:
  /// In the corridor, somewhat askew and off the middle, differently for each number.
  Robot& start(const std::string& file, int number) {
    load_world(file);
    world.seed = static_cast<std::uint64_t>(number);
    Robot& puck = robot(0);
    puck.at(-0.03 + 0.03 * number, number % 2 ? 0.01 : -0.008, 7 * number - 21);
    puck.settings().firmware = "lab/u_obstacle";
    puck.settings().variation.gain_spread = 0.1;
    puck.settings().variation.offset_spread_counts = 8;
    return puck;
  }
};

TEST_P(UObstacle, leaves_the_corridor_without_touching_it) {
  Robot& puck = start("worlds/u_obstacle.toml", GetParam());
  EXPECT_TRUE(run_until([&] { return puck.x_m() < kMouthM; }, 60)) << "at x = " << puck.x_m();
  EXPECT_EQ(puck.collisions(), 0);
  expect_no_traps();
}

TEST_P(UObstacle, bumps_into_black_walls) {
  Robot& puck = start("worlds/u_obstacle_black.toml", GetParam());
  run_until([&] { return puck.x_m() < kMouthM; }, 60);
  EXPECT_GT(puck.collisions(), 0);
}

TEST_P(UObstacle, does_not_mind_white_walls) {
  Robot& puck = start("worlds/u_obstacle_white.toml", GetParam());
  EXPECT_TRUE(run_until([&] { return puck.x_m() < kMouthM; }, 60)) << "at x = " << puck.x_m();
  EXPECT_EQ(puck.collisions(), 0);
}

INSTANTIATE_TEST_SUITE_P(Starts, UObstacle, ::testing::Range(1, 6));

TEST_F(FirmwareTest, u_obstacle_goes_about_in_the_open) {
  load_world("worlds/obstacle.toml");
  Robot& puck = robot(0);
  puck.settings().firmware = "lab/u_obstacle";
  run_for(60);
  EXPECT_GT(puck.distance_m(), 2);
  EXPECT_LE(puck.longest_wall_touch_s(), 0.5);
}

}  // namespace
