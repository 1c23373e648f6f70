// SPDX-License-Identifier: MIT
// A world whose furniture changes while its robots drive on.
#include <functional>
#include <map>

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

// each number of each change by hand is in the digest, though nothing moves or looks
TEST(Interventions, are_in_the_digest_with_all_that_they_say) {
  using Change = std::function<void(sim::Simulation&)>;
  const sim::Candidate box{0, false}, robot{1, true};
  const std::vector<std::pair<const char*, Change>> changes = {
      {"nothing", [](sim::Simulation&) {}},
      {"wheel noise", [](sim::Simulation& s) { s.set_wheel_noise(0, 0.1); }},
      {"more wheel noise", [](sim::Simulation& s) { s.set_wheel_noise(0, 0.2); }},
      {"another's wheel noise", [](sim::Simulation& s) { s.set_wheel_noise(1, 0.1); }},
      {"grip of the left", [](sim::Simulation& s) { s.set_wheel_grip(0, 0.5, 1); }},
      {"grip of the right", [](sim::Simulation& s) { s.set_wheel_grip(0, 1, 0.5); }},
      {"another's grip", [](sim::Simulation& s) { s.set_wheel_grip(1, 0.5, 1); }},
      {"proximity noise", [](sim::Simulation& s) { s.set_proximity_noise(0, 2); }},
      {"more proximity noise", [](sim::Simulation& s) { s.set_proximity_noise(0, 3); }},
      {"another's proximity noise", [](sim::Simulation& s) { s.set_proximity_noise(1, 2); }},
      {"a box in red",
       [&](sim::Simulation& s) {
         s.set_colour(box, {1, 0, 0});
       }},
      {"in green",
       [&](sim::Simulation& s) {
         s.set_colour(box, {0, 1, 0});
       }},
      {"in blue",
       [&](sim::Simulation& s) {
         s.set_colour(box, {0, 0, 1});
       }},
      {"a robot in red",
       [&](sim::Simulation& s) {
         s.set_colour(robot, {1, 0, 0});
       }},
      {"a lamp is off",
       [](sim::Simulation& s) {
         s.set_lamp(0, false, 1, {0, 0, 1});
       }},
      {"is on",
       [](sim::Simulation& s) {
         s.set_lamp(0, true, 1, {0, 0, 1});
       }},
      {"another one",
       [](sim::Simulation& s) {
         s.set_lamp(1, true, 1, {0, 0, 1});
       }},
      {"is brighter",
       [](sim::Simulation& s) {
         s.set_lamp(0, true, 2, {0, 0, 1});
       }},
      {"is elsewhere",
       [](sim::Simulation& s) {
         s.set_lamp(0, true, 1, {1, 0, 1});
       }},
      {"is at its side",
       [](sim::Simulation& s) {
         s.set_lamp(0, true, 1, {0, 1, 1});
       }},
      {"is higher",
       [](sim::Simulation& s) {
         s.set_lamp(0, true, 1, {0, 0, 2});
       }},
      {"a robot is put back", [](sim::Simulation& s) { s.begin_again(0); }},
      {"another one is", [](sim::Simulation& s) { s.begin_again(1); }},
      {"what has no name", [](sim::Simulation& s) { s.note_intervention(77); }},
  };
  std::map<std::uint64_t, std::string> seen;
  for (const auto& [name, change] : changes) {
    const auto digest = [&change = change] {
      const sim::WorldDesc world = world_of(
          "twinpuck = 1\n[[box]]\nposition = [0, 0.5]\nsize = [0.1, 0.1, 0.1]\n[[lamp]]\nposition = [0, 0, "
          "1]\n"
          "[[lamp]]\nposition = [0, 0, 1]\n[[robot]]\n[[robot]]\nposition = [0.3, 0]\n");
      sim::Minds minds;
      for (int r = 0; r < 2; ++r) minds.push_back(std::make_unique<Cruise>(0, 0));
      sim::Simulation simulation(world, std::move(minds));
      simulation.run_until(sim::from_seconds(0.1));
      change(simulation);
      simulation.run_until(sim::from_seconds(0.2));
      return simulation.digest();
    };
    const std::uint64_t one = digest();
    EXPECT_EQ(digest(), one) << name;
    EXPECT_EQ(seen.emplace(one, name).first->second, name);
  }
}

// a robot on a way of its own, in which nothing is due for long: what is changed is so at once
TEST(Interventions, count_from_the_tick_on_in_which_they_come) {
  const auto way_m = [](const std::function<void(sim::Simulation&)>& change) {
    auto simulation = drive(kOpen);
    simulation->run_until(sim::from_seconds(1));
    change(*simulation);
    simulation->run_until(sim::from_seconds(2));
    return simulation->distance_m(0);
  };
  const double whole_m = way_m([](sim::Simulation&) {});
  EXPECT_NEAR(way_m([](sim::Simulation& s) { s.set_wheel_grip(0, 0.5, 0.5); }), 0.75 * whole_m,
              0.005 * whole_m);
  EXPECT_NEAR(way_m([](sim::Simulation& s) { s.set_wheel_grip(0, 0, 0); }), 0.5 * whole_m, 0.005 * whole_m);
  EXPECT_GT(std::fabs(way_m([](sim::Simulation& s) { s.set_wheel_noise(0, 0.3); }) - whole_m), 1e-4);
}

}  // namespace
