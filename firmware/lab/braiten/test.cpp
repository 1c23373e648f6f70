// SPDX-License-Identifier: MIT
// Braiten turns away from what is near, and is trapped where nothing prefers a side.
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

/// Runs in the lab's corridor; true when the whole robot has left it within two minutes.
class Braiten : public FirmwareTest {
 protected:
  Robot& start(double noise_scale, int seed) {
    load_world("worlds/u_obstacle.toml");
    world.proximity.noise_scale = noise_scale;
    world.seed = static_cast<std::uint64_t>(seed);
    robot(0).settings().firmware = "lab/braiten";
    return robot(0);
  }
};

TEST_F(Braiten, stands_before_the_dead_end_without_noise) {
  Robot& puck = start(0, 1);
  run_for(20);
  const double x_m = puck.x_m();
  EXPECT_GT(x_m, 0.15);  // it drove towards the end at x = 0.29
  run_for(100);
  EXPECT_NEAR(puck.x_m(), x_m, 0.005);
  EXPECT_NEAR(puck.y_m(), 0, 0.005);
  EXPECT_EQ(puck.collisions(), 0);
  expect_no_traps();
}

TEST_F(Braiten, avoids_a_box_on_either_side) {
  arena(1, 1);
  world.proximity.profile = "webots-old";
  box(0.2, 0.03, 0.1);
  Robot& puck = add_robot("lab/braiten").at(0, 0, 0);
  run_for(3);
  EXPECT_LT(puck.heading_deg(), -15);  // the box is more to its left: it turns right
  EXPECT_EQ(puck.collisions(), 0);
}

class BraitenWithNoise : public Braiten, public ::testing::WithParamInterface<int> {};

TEST_P(BraitenWithNoise, gets_out) {
  Robot& puck = start(8, GetParam());
  EXPECT_TRUE(run_until([&] { return puck.x_m() < -0.25; }, 300)) << "at x = " << puck.x_m();
}

INSTANTIATE_TEST_SUITE_P(Seeds, BraitenWithNoise, ::testing::Range(1, 4));

}  // namespace
