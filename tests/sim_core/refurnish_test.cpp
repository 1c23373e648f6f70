// SPDX-License-Identifier: MIT
// A world whose furniture changes while its robots drive on.
#include "tests/sim_core/fixture.h"

namespace {

using namespace sim_test;

constexpr const char* kOpen =
    "twinpuck = 1\n[arena]\nsize = [2, 1]\n[[robot]]\nname = \"a\"\nposition = [-0.8, 0]\n";
constexpr const char* kBlock =
    "twinpuck = 1\n[arena]\nsize = [2, 1]\n[[box]]\nposition = [0, 0]\nsize = [0.1, 0.4, 0.1]\n"
    "[[robot]]\nname = \"a\"\nposition = [-0.8, 0]\n";

sim::WorldDesc world_of(const std::string& text) {
  sim::LoadedWorld loaded = sim::parse_world(text, "t.toml", {puck()});
  EXPECT_TRUE(loaded.world) << loaded.report("t.toml");
  return loaded.world ? *loaded.world : sim::WorldDesc{};
}

std::unique_ptr<sim::Simulation> drive(const std::string& text, double speed_rad_s = 5) {
  const sim::WorldDesc world = world_of(text);
  sim::Minds minds;
  minds.push_back(std::make_unique<Cruise>(speed_rad_s, speed_rad_s));
  return std::make_unique<sim::Simulation>(world, std::move(minds));
}

TEST(Refurnish, a_wall_put_before_a_driving_robot_stops_it) {
  auto simulation = drive(kOpen);
  simulation->run_until(sim::from_seconds(3));
  const double way_m = simulation->distance_m(0);
  EXPECT_NEAR(way_m, 3 * 5 * 0.0205, 0.002);  // 5 rad/s on wheels of 20.5 mm
  const double x_m = simulation->pose(0).x_m;
  simulation->refurnish(world_of(kBlock), {});
  EXPECT_EQ(simulation->pose(0).x_m, x_m);
  EXPECT_EQ(simulation->distance_m(0), way_m);
  simulation->run_until(sim::from_seconds(12));
  EXPECT_NEAR(simulation->pose(0).x_m, -0.05 - 0.037, 0.002);  // its rim at the box
  EXPECT_GE(simulation->touches(0).collisions, 1);
}

TEST(Refurnish, a_robot_goes_on_where_a_wall_is_taken_away) {
  auto simulation = drive(kBlock);
  simulation->run_until(sim::from_seconds(12));
  EXPECT_NEAR(simulation->pose(0).x_m, -0.05 - 0.037, 0.002);
  const int collisions = simulation->touches(0).collisions;
  simulation->refurnish(world_of(kOpen), {});
  simulation->run_until(sim::from_seconds(15));
  EXPECT_GT(simulation->pose(0).x_m, 0.1);
  EXPECT_EQ(simulation->touches(0).collisions, collisions);
}

TEST(Refurnish, movable_things_keep_their_place_though_others_go) {
  const std::string two =
      "twinpuck = 1\n[[ball]]\nname = \"gone\"\nposition = [1, 1]\nmovable = true\nradius = 0.02\n"
      "[[ball]]\nname = \"kept\"\nposition = [0.5, 0]\nmovable = true\nradius = 0.02\n[[robot]]\nname = "
      "\"a\"\n";
  const std::string one =
      "twinpuck = 1\n[[ball]]\nname = \"kept\"\nposition = [0.5, 0]\nmovable = true\nradius = "
      "0.02\n[[robot]]\nname = \"a\"\n";
  auto simulation = drive(two, 0);
  simulation->move(2, {0.7, 0.2, 0});
  simulation->refurnish(world_of(one), {2});
  simulation->run_until(sim::from_seconds(0.5));
  EXPECT_NEAR(simulation->pose(1).x_m, 0.7, 1e-6);
  EXPECT_NEAR(simulation->pose(1).y_m, 0.2, 1e-6);
}

TEST(Refurnish, sensors_see_the_new_wall) {
  auto simulation = drive(kOpen, 0);
  simulation->run_until(sim::from_seconds(0.1));
  const double before = sim::sense_proximity(simulation->scene(), 0, 0, simulation->now()).value;
  simulation->refurnish(world_of("twinpuck = 1\n[[box]]\nposition = [-0.74, 0]\nsize = [0.02, 0.4, 0.1]\n"
                                 "[[robot]]\nname = \"a\"\nposition = [-0.8, 0]\n"),
                        {});
  EXPECT_GT(sim::sense_proximity(simulation->scene(), 0, 0, simulation->now()).value, before + 100);
}

// the same change at the same tick, twice: the same run; and the digest knows of it
TEST(Refurnish, repeats) {
  const auto digest = [](bool changed) {
    auto simulation = drive(kOpen);
    simulation->run_until(sim::from_seconds(1));
    if (changed) simulation->refurnish(world_of(kBlock), {});
    simulation->run_until(sim::from_seconds(9));
    return simulation->digest();
  };
  EXPECT_EQ(digest(true), digest(true));
  EXPECT_NE(digest(true), digest(false));
}

}  // namespace
