// SPDX-License-Identifier: MIT
// Agreement is measured by the length of the mean of all directions' unit vectors: 1 when all are equal,
// about 1/sqrt(10) = 0.32 for ten random ones.
#include <cmath>

#include "tests/support/firmware_test.h"

using firmware_test::FirmwareTest;

namespace {

class RadioFlock : public FirmwareTest, public ::testing::WithParamInterface<int> {
 protected:
  double agreement() {
    double c = 0, s = 0;
    for (int i = 0; i < 10; ++i) {
      const double heading = sim::radians(robot(i).heading_deg());
      c += std::cos(heading) / 10;
      s += std::sin(heading) / 10;
    }
    return std::hypot(c, s);
  }
};

TEST_P(RadioFlock, ten_robots_agree_on_a_direction) {
  load_world("worlds/flock.toml");
  world.seed = static_cast<std::uint64_t>(GetParam());
  run_for(0.1);
  EXPECT_LT(agreement(), 0.4);
  run_for(30);
  EXPECT_GT(agreement(), 0.98);
  // and they go on: all together a good way from where they were
  for (int i = 0; i < 10; ++i) EXPECT_GT(robot(i).distance_m(), 0.5) << i;
  expect_no_traps();
}

TEST_P(RadioFlock, out_of_range_of_each_other_they_do_not) {
  load_world("worlds/flock.toml");
  world.seed = static_cast<std::uint64_t>(GetParam());
  world.radio.range_m = 0.05;
  run_for(30);
  EXPECT_LT(agreement(), 0.6);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RadioFlock, ::testing::Values(1, 2, 3, 4, 5));

}  // namespace
