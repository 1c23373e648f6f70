// SPDX-License-Identifier: MIT
// The soccer supervisor against the ball's own positions, and the one of S16, which lets the ball fall.
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
  }
  std::pair<int, int> score() {
    int blue = -1, yellow = -1;
    std::sscanf(team().labels().at(0).text.c_str(), "blue %d : %d yellow", &blue, &yellow);
    return {blue, yellow};
  }
  void be_quiet() {
    team().say = [](const std::string&) {};
  }
  sim::BodyState ball() { return twin().simulation().state(ball_); }
  void put_ball(double x_m, double y_m) { twin().simulation().move(ball_, {x_m, y_m, 0}); }
  int ball_ = 0;
};

TEST_F(SoccerTest, a_goal_counts_once_and_the_ball_lies_in_the_middle_again) {
  be_quiet();
  run_for(0.05);
  EXPECT_EQ(score(), std::make_pair(0, 0));
  put_ball(0.8, 0.05);
  run_for(0.1);
  EXPECT_EQ(score(), std::make_pair(1, 0));
  run_for(1);
  EXPECT_EQ(score(), std::make_pair(1, 0)) << "one goal counts once";
  // the pause of 2 s is over: the ball is on the floor in the middle, players stand where they began
  ASSERT_TRUE(run_until([&] { return std::fabs(ball().pose.x_m) < 0.001; }, 2));
  EXPECT_LT(ball().z_m, 0.001);
  EXPECT_NEAR(ball().pose.y_m, 0, 1e-3);
  EXPECT_NEAR(robot(0).x_m(), -0.66, 0.001);
  put_ball(-0.8, 0);
  run_for(0.1);
  EXPECT_EQ(score(), std::make_pair(1, 1));
}

// S16: it falls and bounces; with a restitution of e to e2 h [derived]
TEST_F(SoccerTest, in_the_labs_solution_the_ball_falls_from_ten_centimetres) {
  world.supervisors.at(0).program = "soccer_drop";
  be_quiet();
  run_for(0.02);
  const double h = 0.1, e = world.objects[0].material.restitution;
  EXPECT_GT(ball().z_m, 0.09);
  EXPECT_LE(ball().z_m, h);
  EXPECT_EQ(ball().pose.x_m, 0);
  ASSERT_TRUE(run_until([&] { return ball().climb_m_s > 0.3; }, 1));
  double highest = 0;
  run_until([&] { return highest = std::max(highest, ball().z_m), ball().climb_m_s < 0; }, 1);
  EXPECT_NEAR(highest, e * e * h, 0.1 * e * e * h);
  put_ball(0.8, 0.05);
  run_for(0.1);
  EXPECT_EQ(score(), std::make_pair(1, 0));
  EXPECT_TRUE(run_until([&] { return ball().z_m > 0.09; }, 3)) << "after a goal as well";
}

TEST_F(SoccerTest, a_ball_over_the_line_beside_the_goal_is_none) {
  be_quiet();
  run_for(0.05);
  put_ball(0.8, 0.4);  // behind the boards
  run_for(0.1);
  EXPECT_EQ(score(), std::make_pair(0, 0));
}

TEST_F(SoccerTest, the_score_of_a_match_is_the_number_of_times_the_ball_came_in) {
  world.seed = 3;  // of six seeds, two have a single goal in ten minutes
  be_quiet();
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
  run_for(0.1);  // the supervisor looks each 32 ms
  EXPECT_EQ(score(), seen);
  expect_no_traps();
}

TEST_F(SoccerTest, players_and_supervisor_give_one_match_for_a_seed) {
  const auto match = [](std::uint64_t seed, int threads) {
    struct Run : SoccerTest {
      void TestBody() override {}
      std::uint64_t go(std::uint64_t its_seed, int its_threads) {
        SetUp();
        world.seed = its_seed;
        options.threads = its_threads;
        be_quiet();
        run_for(3);
        return digest();
      }
    } run;
    return run.go(seed, threads);
  };
  const auto first = match(2, 1);
  EXPECT_EQ(match(2, 1), first);
  EXPECT_EQ(match(2, 2), first);
  EXPECT_NE(match(3, 1), first);
}

}  // namespace
