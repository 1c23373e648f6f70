// SPDX-License-Identifier: MIT
// camera_follow: from anywhere, it ends in front of the ball at its distance, and follows when the ball is
// moved. 14 columns of 16 / 716.54 and a ball of 30 mm: half angle atan(7 * 16 / 716.54) = 8.884 deg, 0.03 /
// sin = 0.194 m from the lens, 0.224 m from the axle; a column more or less is 14 mm. Touching would be 0.067
// m.
#include <cmath>
#include <random>

#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

struct Where {
  double distance_m, bearing_deg;
};

Where to_ball(const sim::Simulation& simulation) {
  const sim::Pose2 robot = simulation.pose(0), ball = simulation.pose(2);
  const sim::Vec2 rel = sim::Frame2(robot).to_local({ball.x_m, ball.y_m});
  return {sim::length(rel), sim::degrees(std::atan2(rel.y, rel.x))};
}

class CameraFollow : public FirmwareTest, public ::testing::WithParamInterface<int> {};

TEST_P(CameraFollow, faces_the_ball_keeps_its_distance_and_follows_it) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  load_world("worlds/red_ball.toml");
  world.seed = seed;
  const char* const cameras[] = {"po3030k", "po6030k", "po8030d"};
  robot(0).settings().own["camera"] = cameras[seed % 3];
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto draw = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const double x_m = draw(-0.45, -0.2), y_m = draw(-0.1, 0.3);
  robot(0).at(x_m, y_m, draw(-180, 180));
  run_for(25);
  Where there = to_ball(twin().simulation());
  EXPECT_NEAR(there.distance_m, 0.224, 0.035);
  EXPECT_NEAR(there.bearing_deg, 0, 6);
  EXPECT_TRUE(robot(0).led(8));

  const double to_x_m = draw(-0.3, 0.0);
  twin().simulation().move(2, {to_x_m, draw(-0.1, 0.05), 0});
  run_for(25);
  there = to_ball(twin().simulation());
  EXPECT_NEAR(there.distance_m, 0.224, 0.035);
  EXPECT_NEAR(there.bearing_deg, 0, 6);
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Seeds, CameraFollow, ::testing::Range(1, 10));

TEST_F(FirmwareTest, camera_follow_turns_and_turns_when_nothing_is_red) {
  Robot& robot = add_robot("camera_follow");
  arena(1, 1);
  run_for(12);
  // 150 steps/s of each wheel: 41 degrees a second
  EXPECT_GT(std::fabs(robot.heading_deg()), 270);
  EXPECT_LT(std::hypot(robot.x_m(), robot.y_m()), 0.01);
  EXPECT_FALSE(robot.led(8));
}

}  // namespace
