// SPDX-License-Identifier: MIT
// line_follow on the closed line of worlds/line.toml: x = 0.45 cos t, y = 0.28 sin t + 0.06 sin 2t.
#include <cmath>

#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

/// Distance of a point from the middle of the line, m.
double off_line_m(double x, double y) {
  static const std::vector<sim::Vec2> line = [] {
    std::vector<sim::Vec2> points;
    for (int i = 0; i < 2000; ++i) {
      const double t = 2 * sim::kPi * i / 2000;
      points.push_back({0.45 * std::cos(t), 0.28 * std::sin(t) + 0.06 * std::sin(2 * t)});
    }
    return points;
  }();
  double least = 1e9;
  for (const sim::Vec2& p : line) least = std::min(least, (x - p.x) * (x - p.x) + (y - p.y) * (y - p.y));
  return std::sqrt(least);
}

class LineFollow : public FirmwareTest, public ::testing::WithParamInterface<int> {};

// three laps; the middle of the sensors, 30 mm ahead of the wheels, never leaves the line by more than half
// its width and the outer sensors' 10 mm, so one of the three always sees it
TEST_P(LineFollow, drives_three_laps_and_never_loses_the_line) {
  load_world("worlds/line.toml");
  world.seed = static_cast<std::uint64_t>(GetParam());
  Robot& r = robot(0);
  double turned = 0, before = 0, worst = 0;
  int ticks = 0;
  const auto laps_done = [&] {
    if (++ticks % 16 != 0) return false;  // 32 looks a second: 1.5 mm of way
    const double angle = std::atan2(r.y_m(), r.x_m());
    turned += std::remainder(angle - before, 2 * sim::kPi);
    before = angle;
    const double heading = sim::radians(r.heading_deg());
    worst =
        std::max(worst, off_line_m(r.x_m() + 0.03 * std::cos(heading), r.y_m() + 0.03 * std::sin(heading)));
    return turned > 3 * 2 * sim::kPi;
  };
  run_for(0.1);
  before = std::atan2(r.y_m(), r.x_m());
  EXPECT_TRUE(run_until(laps_done, 240)) << turned / (2 * sim::kPi) << " laps";
  EXPECT_LT(worst, 0.019);
  EXPECT_EQ(r.variable("losses"), 0);
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Seeds, LineFollow, ::testing::Range(1, 6));

}  // namespace
