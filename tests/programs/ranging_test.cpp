// SPDX-License-Identifier: MIT
// Distances that an e-puck's lidar, range finder and distance sensors see, against numbers
// worked out by hand.
#include "programs/puck/ranging.h"

#include <cmath>

#include "tests/sim_core/fixture.h"

namespace {

// a wall 0.5 m ahead and one 0.3 m to the left, 0.1 m high; the robot looks along x
const char* const kWorld =
    "twinpuck = 1\n[arena]\nsize = [20, 20]\nwall_height = 0\n"
    "[[box]]\nposition = [0.55, 0]\nsize = [0.1, 4, 0.1]\n[[box]]\nposition = [0, 0.35]\nsize = [0.2, 0.1, "
    "0.1]\n"
    "[[robot]]\nname = \"eye\"\n";

class Ranging : public ::testing::Test {
 protected:
  const sim::Scene& scene() const { return simulation_->scene(); }
  std::unique_ptr<sim::Simulation> simulation_ =
      sim_test::cruising(sim_test::world_of(kWorld, {sim_test::puck()}), 0, 0);
};

sim::DeviceDesc device(sim::DeviceKind kind, int width, int height, double fov_rad, double far_m) {
  sim::DeviceDesc d;
  d.kind = kind;
  d.width = width;
  d.height = height;
  d.fov_rad = fov_rad;
  d.far_m = far_m;
  d.at_m = {0.1, 0, 0.05};
  return d;
}

TEST_F(Ranging, a_lidar_sees_from_the_left_to_the_right) {
  // three rays of a fov of 3 rad: 1 rad to the left, ahead, 1 rad to the right
  const auto seen = programs::ranges(scene(), 0, device(sim::DeviceKind::Lidar, 3, 1, 3, 2), scene().now());
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_NEAR(seen[1], 0.4, 1e-6) << "from 0.1 to 0.5";
  EXPECT_NEAR(seen[2], 0.4 / std::cos(1), 1e-6);
  EXPECT_NEAR(seen[0], 0.4 / std::cos(1), 1e-6) << "0.3 m to the left it is past the box's edge";
  auto turned = device(sim::DeviceKind::Lidar, 1, 1, 0.1, 2);
  turned.at_m.x = 0;
  turned.heading_rad = sim::kPi / 2;
  EXPECT_NEAR(programs::ranges(scene(), 0, turned, scene().now())[0], 0.3, 1e-6);
}

TEST_F(Ranging, what_is_too_near_or_too_far_is_infinite) {
  auto d = device(sim::DeviceKind::Lidar, 1, 1, 0.1, 0.39);
  EXPECT_TRUE(std::isinf(programs::ranges(scene(), 0, d, scene().now())[0]));
  d.far_m = 1;
  d.near_m = 0.41;
  EXPECT_TRUE(std::isinf(programs::ranges(scene(), 0, d, scene().now())[0]));
}

TEST_F(Ranging, a_range_finder_measures_along_its_line_of_sight) {
  // three columns on a plane: the wall is equally far in all; the lower row sees the floor
  const auto seen =
      programs::ranges(scene(), 0, device(sim::DeviceKind::RangeFinder, 3, 2, 1.6, 1), scene().now());
  ASSERT_EQ(seen.size(), 6u);
  const double t = std::tan(0.8), down = 0.5 * t * 2 / 3;
  EXPECT_TRUE(std::isinf(seen[1])) << "above the wall";
  EXPECT_NEAR(seen[4], 0.05 / down, 1e-6) << "floor before the wall";
  auto level = device(sim::DeviceKind::RangeFinder, 3, 1, 1.6, 1);
  for (const double range : programs::ranges(scene(), 0, level, scene().now())) EXPECT_NEAR(range, 0.4, 1e-6);
}

TEST_F(Ranging, a_distance_sensor_looks_its_table_up) {
  auto d = device(sim::DeviceKind::Distance, 0, 0, 0, 0);
  d.table = {{0, 1000, 0}, {0.8, 200, 0}};
  EXPECT_NEAR(programs::measured_distance(scene(), 0, d, scene().now()), 600, 1e-3) << "0.4 m";
  d.rays = 3;
  d.aperture_rad = 2;  // 1 rad to both sides
  const double mean = (0.4 + 2 * 0.4 / std::cos(1)) / 3;
  EXPECT_NEAR(programs::measured_distance(scene(), 0, d, scene().now()), 1000 - 1000 * mean, 1e-3);
  EXPECT_EQ(programs::looked_up(d.table, -1), 1000);
  EXPECT_EQ(programs::looked_up(d.table, 5), 200);
}

}  // namespace
