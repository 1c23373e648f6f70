// SPDX-License-Identifier: MIT
// The soccer supervisor against the ball's own positions.
#include <cmath>
#include <cstdio>

#include "tests/support/firmware_test.h"

namespace {

using firmware_test::FirmwareTest;

class SoccerTest : public FirmwareTest {
 protected:
  void SetUp() override {
    load_world("worlds/soccer.toml");
    world.seed = 2;                                 // a match in which somebody scores early
    ball_ = static_cast<int>(world.robots.size());  // the only movable object
    team().say = [](const std::string&) {};
  }
  std::pair<int, int> score() {
    int blue = -1, yellow = -1;
    std::sscanf(team().labels().at(0).text.c_str(), "blue %d : %d yellow", &blue, &yellow);
    return {blue, yellow};
  }
  sim::BodyState ball() { return twin().simulation().state(ball_); }
  int ball_ = 0;
};

TEST_F(SoccerTest, a_goal_counts_and_the_ball_falls_from_ten_centimetres) {
  run_for(0.05);
  EXPECT_EQ(score(), std::make_pair(0, 0));
  twin().simulation().move(ball_, {0.8, 0.05, 0});
  run_for(0.1);
  EXPECT_EQ(score(), std::make_pair(1, 0));
  run_for(1);
  EXPECT_EQ(score(), std::make_pair(1, 0)) << "one goal counts once";
  // the pause of 2 s is over: the ball is in the air over the middle, players stand where they began
  ASSERT_TRUE(run_until([&] { return ball().z_m > 0.09; }, 2));
  EXPECT_LE(ball().z_m, 0.1);
  EXPECT_EQ(ball().pose.x_m, 0);
  EXPECT_EQ(ball().pose.y_m, 0);
  EXPECT_NEAR(robot(0).x_m(), -0.66, 0.001);
  // S16: it falls and bounces; with a restitution of 0.6 to 0.36 of the height [derived: e2 h]
  const double h = 0.1, e = world.objects[0].material.restitution;
  ASSERT_TRUE(run_until([&] { return ball().climb_m_s > 0.3; }, 1));
  double highest = 0;
  run_until([&] { return highest = std::max(highest, ball().z_m), ball().climb_m_s < 0; }, 1);
  EXPECT_NEAR(highest, e * e * h, 0.1 * e * e * h);
  twin().simulation().move(ball_, {-0.8, 0, 0});
  run_for(0.1);
  EXPECT_EQ(score(), std::make_pair(1, 1));
}

TEST_F(SoccerTest, a_ball_over_the_line_beside_the_goal_is_none) {
  run_for(0.05);
  twin().simulation().move(ball_, {0.8, 0.4, 0});  // behind the boards
  run_for(0.1);
  EXPECT_EQ(score(), std::make_pair(0, 0));
}

TEST_F(SoccerTest, the_score_of_a_match_is_the_number_of_times_the_ball_came_in) {
  std::pair<int, int> seen{0, 0};
  bool inside = false;
  const auto watch = [&] {
    const sim::Pose2& at = ball().pose;
    const bool in = std::fabs(at.x_m) > 0.75 && std::fabs(at.y_m) < 0.18;
    if (in && !inside) ++(at.x_m > 0 ? seen.first : seen.second);
    inside = in;
    return seen.first + seen.second > 1;
  };
  EXPECT_TRUE(run_until(watch, 600)) << "two goals in ten minutes are expected";
  run_for(0.1);  // the supervisor looks after the tick
  EXPECT_EQ(score(), seen);
  expect_no_traps();
}

}  // namespace
