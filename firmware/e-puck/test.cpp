// SPDX-License-Identifier: MIT
// The lab's example, as printed. Its numbering and speed unit are the lab's; what it does follows from its
// text.
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class LabExample : public FirmwareTest {
 protected:
  LabExample() {
    world.webots.speed_unit_rad_s = 0.1;
    world.webots.sensor_order = "lab";
  }
};

// 20 and 16 units of 0.1 rad/s: 2 and 1.6 rad/s, 318.3 and 254.6 steps/s, which the motor driver quantises to
// 10000 / (10000 / 318) = 322.6 and 10000 / (10000 / 255) = 256.4. From 0.3 s (the start-up takes 0.24 s)
// to 4.3 s.
TEST_F(LabExample, drives_a_slight_curve_and_prints_a_line_a_step) {
  Robot& r = add_robot("e-puck");
  run_for(0.3);
  const auto left = r.left_steps(), right = r.right_steps();
  const std::size_t lines = r.console().size();
  run_for(4.0);
  EXPECT_NEAR(r.left_steps() - left, 4.0 * 322.6, 15);
  EXPECT_NEAR(r.right_steps() - right, 4.0 * 256.4, 12);
  EXPECT_NEAR(r.console().size() - lines, 4000 / 64, 1);  // run() returned 64
  // nothing is near: the table's last row at most, 34 counts of the old profile
  for (const std::string& line : r.console()) {
    ASSERT_EQ(line.substr(0, 2), "v=");
    EXPECT_LT(std::stoi(line.substr(2)), 100);
  }
  expect_no_traps();
}

// ps2 of the lab is the left one of the two in front. Seen from the robot, a wall 1 cm ahead of it reads far
// above 512: it spins clockwise for 1280 ms by 2 rad/s * 1.28 s = 2.56 rad of each wheel, 2.56 * 20.5 / 26.5
// rad = 113 degrees.
TEST_F(LabExample, spins_round_for_1280_ms_when_its_one_sensor_sees_a_wall) {
  wall(0.055, -0.2, 0.055, 0.2);
  Robot& r = add_robot("e-puck");
  EXPECT_TRUE(run_until([&] { return !r.console().empty() && r.console().back() != "v=0"; }, 1.0));
  const std::size_t lines = r.console().size();
  const double start = r.heading_deg();
  EXPECT_GT(std::stoi(r.console().back().substr(2)), 512);
  run_for(1.2);
  EXPECT_EQ(r.console().size(), lines) << "run() was called again before the 1280 ms it asked for were over";
  EXPECT_LT(r.heading_deg(), start - 90);
  run_for(0.12);
  EXPECT_GT(r.console().size(), lines);
  EXPECT_NEAR(r.heading_deg(), start - 113, 8);
  expect_no_traps();
}

// "As you may have noticed, the original version does not allow the robot to avoid obstacles very well":
// seven sensors are never looked at. A wall to its right, into which it curves, is not seen by the left front
// one until it is touched.
TEST_F(LabExample, does_not_avoid_obstacles_very_well) {
  struct Run : LabExample {
    void TestBody() override {}
    int collisions_of(double heading_deg) {
      arena(1.0, 1.0);
      box(0.25, -0.22, 0.1);
      box(-0.2, -0.3, 0.1);
      box(-0.25, 0.25, 0.1);
      Robot& r = add_robot("e-puck").at(0, 0, heading_deg);
      run_for(60);
      EXPECT_GT(r.distance_m(), 1.0);
      expect_no_traps();
      return r.collisions();
    }
  };
  int collisions = 0;  // one start may lead past everything
  for (const double heading_deg : {0, 90, 180, 270}) collisions += Run().collisions_of(heading_deg);
  EXPECT_GT(collisions, 0);
}

// in the product's numbering ps2 looks to the right
TEST_F(LabExample, with_the_product_numbering_it_looks_to_the_right_instead) {
  world.webots.sensor_order = "product";
  wall(-0.2, -0.055, 0.2, -0.055);
  Robot& r = add_robot("e-puck");
  EXPECT_TRUE(run_until([&] { return !r.console().empty() && r.console().back() != "v=0"; }, 1.0));
  EXPECT_GT(std::stoi(r.console().back().substr(2)), 512);
}

}  // namespace
