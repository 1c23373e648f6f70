// SPDX-License-Identifier: MIT
// How far a world may run beside a clock on the wall that the test turns by hand.
#include "viewer/pace.h"

#include <gtest/gtest.h>

namespace {

using sim::from_seconds;

struct PaceTest : testing::Test {
  void pass(double seconds) {
    wall += std::chrono::duration_cast<viewer::Pace::Wall::duration>(std::chrono::duration<double>(seconds));
  }
  double due_s(double now_s) { return sim::to_seconds(pace.due(from_seconds(now_s))); }

  viewer::Pace::Wall::time_point wall{};
  viewer::Pace pace{[this] { return wall; }};
};

TEST_F(PaceTest, the_world_is_due_at_its_speed) {
  EXPECT_FALSE(pace.plays());
  EXPECT_EQ(pace.speed(), 1);
  pace.begin(from_seconds(10));
  pace.play(true, from_seconds(10));
  pass(0.25);
  EXPECT_NEAR(due_s(10), 10.25, 1e-6);
  EXPECT_NEAR(pace.wait_s(from_seconds(10.5)), 0.25, 1e-6);
  // from here on four times as fast
  pace.set_speed(4, from_seconds(10.25));
  pass(0.125);
  EXPECT_NEAR(due_s(10.25), 10.75, 1e-6);
  EXPECT_NEAR(pace.wait_s(from_seconds(11.25)), 0.125, 1e-6);
  pace.set_speed(0, from_seconds(11));
  EXPECT_EQ(pace.due(from_seconds(11)), sim::kEver);
  EXPECT_EQ(pace.wait_s(from_seconds(99)), 0);
}

TEST_F(PaceTest, what_a_slow_machine_lost_is_not_made_up_for) {
  for (const double speed : {1.0, 8.0}) {
    pace.begin(0);
    pace.set_speed(speed, 0);
    pace.play(true, 0);
    pass(0.2);  // not yet late
    EXPECT_NEAR(due_s(0), 0.2 * speed, 1e-6);
    pass(0.1);  // 0.3 s behind: it begins again from where it is
    EXPECT_NEAR(due_s(0), 0, 1e-6);
    pass(0.1);
    EXPECT_NEAR(due_s(0), 0.1 * speed, 1e-6);
  }
}

TEST_F(PaceTest, a_pause_is_no_delay) {
  pace.begin(0);
  pace.play(true, 0);
  pace.play(false, from_seconds(0.1));
  pass(100);
  pace.play(true, from_seconds(0.1));
  pass(0.05);
  EXPECT_NEAR(due_s(0.1), 0.15, 1e-6);
}

TEST_F(PaceTest, its_speed_is_measured_over_half_a_second) {
  pace.begin(from_seconds(5));
  pace.play(true, from_seconds(5));
  pass(0.4);
  pace.measure(from_seconds(6));
  EXPECT_EQ(pace.measured(), 0) << "not long enough to tell";
  pass(0.2);
  pace.measure(from_seconds(6.5));
  EXPECT_NEAR(pace.measured(), 1.5 / 0.6, 1e-6);
  pass(0.5);
  pace.measure(from_seconds(7));
  EXPECT_NEAR(pace.measured(), 1.5 / 0.6, 1e-6);
  pass(0.5);
  pace.measure(from_seconds(7));
  EXPECT_NEAR(pace.measured(), 0.5, 1e-6);
  pace.play(false, from_seconds(7));
  pace.measure(from_seconds(7));
  EXPECT_EQ(pace.measured(), 0);
}

}  // namespace
