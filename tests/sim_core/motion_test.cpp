// SPDX-License-Identifier: MIT
// Physics bars: ways on free floor, walls, pushing, friction, heights, falling. Expectations
// are computed by hand.
#include "tests/sim_core/fixture.h"

using namespace sim_test;

namespace {

const char* const kFree = R"(twinpuck = 1
[[robot]]
)";

/// 500 steps/s of 1000 steps per turn: pi rad/s; with a wheel of 20.5 mm 64.4 mm/s.
constexpr double kHalfTurn = sim::kPi;

TEST(Motion, straight_way_on_free_floor_is_the_wheels_way) {
  for (const char* engine : {"dynamic", "kinematic", "planar"}) {
    for (int hz : {96, 128, 256, 512, 1024}) {
      const auto world = world_of("twinpuck = 1\n[world]\nengine = \"" + std::string(engine) +
                                  "\"\nphysics_hz = " + std::to_string(hz) + "\n[[robot]]\nheading = 30\n");
      auto s = cruising(world, kHalfTurn, kHalfTurn);
      run_for(*s, 10);
      const double way = 10 * kHalfTurn * 0.0205;  // 0.6440 m
      EXPECT_NEAR(s->distance_m(0), way, 0.005 * way) << engine << hz;
      EXPECT_NEAR(s->pose(0).x_m, way * std::cos(sim::kPi / 6), 0.005 * way) << engine << hz;
      EXPECT_NEAR(s->pose(0).heading_rad, sim::kPi / 6, 1e-9);
    }
  }
}

TEST(Motion, turning_on_the_spot_follows_the_axle) {
  auto s = cruising(world_of(kFree), -kHalfTurn, kHalfTurn);
  run_for(*s, 4);
  // 2 * v / axle * t = 2 * 0.0644 / 0.053 * 4
  EXPECT_NEAR(s->pose(0).heading_rad, 2 * kHalfTurn * 0.0205 / 0.053 * 4, 0.02);
  EXPECT_NEAR(s->pose(0).x_m, 0, 1e-6);
}

TEST(Motion, a_circle_closes) {
  for (const char* engine : {"dynamic", "kinematic", "planar"}) {
    auto s = cruising(
        world_of("twinpuck = 1\n[world]\nengine = \"" + std::string(engine) + "\"\n[[robot]]\n"), 2, 4);
    // spin = (4 - 2) * 0.0205 / 0.053 = 0.7736 rad/s: once round in 8.122 s; radius 0.0795 m
    run_for(*s, 2 * sim::kPi / (2 * 0.0205 / 0.053));
    EXPECT_NEAR(s->pose(0).x_m, 0, 0.001) << engine;
    EXPECT_NEAR(s->pose(0).y_m, 0, 0.001) << engine;
    EXPECT_NEAR(s->distance_m(0), 2 * sim::kPi * 0.0795, 0.001) << engine;
  }
}

TEST(Motion, pushed_against_a_wall_the_robot_stays) {
  for (const char* engine : {"dynamic", "kinematic", "planar"}) {
    for (int hz : {96, 512}) {
      auto s = cruising(world_of("twinpuck = 1\n[world]\nengine = \"" + std::string(engine) +
                                 "\"\nphysics_hz = " + std::to_string(hz) +
                                 "\n[[box]]\nposition = [0.15, 0]\nsize = [0.1, 0.4, 0.1]\n[[robot]]\n"),
                        kHalfTurn, kHalfTurn);
      run_for(*s, 5);
      // wall at 0.10, radius 0.037: the middle stops at 0.063, with a gap of at most 0.2 mm
      EXPECT_NEAR(s->pose(0).x_m, 0.063, 0.0002) << engine << hz;
      EXPECT_NEAR(s->pose(0).y_m, 0, 0.0005) << engine << hz;
      EXPECT_EQ(s->touches(0).collisions, 1) << engine << hz;
      EXPECT_GT(s->touches(0).longest_wall_touch_s, 3.9) << engine << hz;  // it arrives after 0.98 s
      EXPECT_LT(s->touches(0).longest_wall_touch_s, 4.1) << engine << hz;
    }
  }
}

/// Every rate that a world may choose.
std::vector<int> all_rates() {
  std::vector<int> rates;
  for (int hz = 32; hz <= 4096; ++hz)
    if (sim::kClicksPerSecond % hz == 0) rates.push_back(hz);
  return rates;
}

TEST(Motion, a_lasting_touch_is_one_collision_at_every_rate) {
  struct Case {
    const char *name, *things;
    bool at_wall;
  };
  // what it drives against is 0.063 m (wall) and 0.05 m away: it arrives after 0.98 s and 0.78 s
  const Case cases[] = {
      {"wall", "[[box]]\nposition = [0.15, 0]\nsize = [0.1, 0.4, 0.1]\n[[robot]]\n", true},
      {"corner",
       "[[box]]\nposition = [0.15, 0]\nsize = [0.1, 0.6, 0.1]\n[[box]]\nposition = [0, 0.15]\n"
       "size = [0.2, 0.1, 0.1]\n[[robot]]\nheading = 45\n",
       true},
      {"robot", "[[robot]]\n[[robot]]\nposition = [0.124, 0]\nheading = 180\n", false}};
  const std::vector<int> rates = all_rates();
  EXPECT_GT(rates.size(), 40u);
  for (const char* engine : {"dynamic", "kinematic", "planar"})
    for (const int hz : rates)
      for (const Case& c : cases) {
        const auto world = world_of("twinpuck = 1\n[world]\nengine = \"" + std::string(engine) +
                                    "\"\nphysics_hz = " + std::to_string(hz) + "\n" + c.things);
        auto s = simulation_of(
            world, [](int r) { return std::make_unique<Cruise>(r ? 0 : kHalfTurn, r ? 0 : kHalfTurn); });
        run_for(*s, 3);
        const std::string what = std::string(engine) + " " + c.name + " " + std::to_string(hz);
        EXPECT_EQ(s->touches(0).collisions, 1) << what;
        EXPECT_GT(s->touches(0).longest_touch_s, 1.5) << what;
        if (c.at_wall) {
          EXPECT_GT(s->touches(0).longest_wall_touch_s, 1.5) << what;
        }
      }
}

// what it stands against already when the run begins, or comes to: only what cannot move counts as a wall
TEST(Motion, only_a_touch_of_something_fixed_is_one_of_a_wall) {
  const struct Case {
    const char* things;
    bool is_wall;
  } cases[] = {{"[[box]]\nposition = [%, 0]\nsize = [0.074, 0.4, 0.1]\n", true},
               {"[[robot]]\nposition = [%, 0]\nheading = 180\n", false}};
  for (const char* engine : {"dynamic", "kinematic", "planar"})
    for (const char* at : {"0.074", "0.0741", "0.1"})
      for (const Case& c : cases) {
        std::string things = c.things;
        things.replace(things.find('%'), 1, at);
        auto s = simulation_of(
            world_of("twinpuck = 1\n[world]\nengine = \"" + std::string(engine) + "\"\n[[robot]]\n" + things),
            [](int r) { return std::make_unique<Cruise>(r ? 0 : kHalfTurn, r ? 0 : kHalfTurn); });
        run_for(*s, 2);
        const std::string what = std::string(engine) + " " + things;
        EXPECT_EQ(s->touches(0).collisions, 1) << what;
        EXPECT_GT(s->touches(0).longest_touch_s, 1) << what;
        EXPECT_EQ(s->touches(0).longest_wall_touch_s > 0, c.is_wall) << what;
      }
}

// a robot that slides along what it touches, or stands there, is not stopped by it
TEST(Motion, beside_a_wall_a_kinematic_robot_touches_it_without_being_stopped) {
  for (const double speed : {0.0, kHalfTurn}) {
    auto s =
        cruising(world_of("twinpuck = 1\n[world]\nengine = \"kinematic\"\n[[robot]]\nheading = 90\n[[box]]\n"
                          "position = [0.07405, 0]\nsize = [0.074, 2, 0.1]\n"),
                 speed, speed);
    run_for(*s, 1);
    EXPECT_NEAR(s->distance_m(0), speed * 0.0205, 0.001);
    EXPECT_EQ(s->touches(0).collisions, 1);
    EXPECT_NEAR(s->touches(0).longest_wall_touch_s, 1, 0.01);
  }
}

TEST(Motion, in_a_corner_the_wheels_still_turn_it) {
  for (int hz : {96, 512}) {
    auto s =
        cruising(world_of("twinpuck = 1\n[world]\nphysics_hz = " + std::to_string(hz) +
                          "\n[[box]]\nposition = [0.15, 0]\nsize = [0.1, 0.6, 0.1]\n"
                          "[[box]]\nposition = [0, 0.15]\nsize = [0.2, 0.1, 0.1]\n[[robot]]\nheading = 45\n"),
                 kHalfTurn - 0.05, kHalfTurn + 0.05);
    run_for(*s, 4);
    // walls at 0.10: it stops at 0.063 from both and turns by 0.1 * 0.0205 / 0.053 = 0.0387 rad/s
    EXPECT_NEAR(s->pose(0).x_m, 0.063, 0.0002) << hz;
    EXPECT_NEAR(s->pose(0).y_m, 0.063, 0.0002) << hz;
    const double heading_rad = s->pose(0).heading_rad;
    run_for(*s, 4);
    EXPECT_NEAR((s->pose(0).heading_rad - heading_rad) / 4, 0.0387, 0.002) << hz;
  }
}

TEST(Motion, a_light_box_is_pushed_and_a_heavy_one_is_not) {
  const auto run = [](const char* mass) {
    auto s = cruising(
        world_of(std::string("twinpuck = 1\n[[box]]\nposition = [0.1, 0]\nsize = [0.06, 0.06, 0.05]\n"
                             "movable = true\nfriction = 0.5\nmass = ") +
                 mass + "\n[[robot]]\n"),
        kHalfTurn, kHalfTurn);
    run_for(*s, 5);
    return s->pose(1).x_m;
  };
  // traction 1.0 * 0.15 kg; box friction 0.5 * m: moves below 0.3 kg. Robot front arrives at
  // 0.07 after 0.033 m.
  EXPECT_NEAR(run("0.1"), 0.1 + 5 * kHalfTurn * 0.0205 - 0.033, 0.003);
  EXPECT_NEAR(run("0.6"), 0.1, 0.001);
}

// The robot drives straight on, its line 30 mm beside the box's middle. By the limit surface (moment and force on an
// ellipse, moment at most 0.0383 m times the force) the box turns by a third of a right angle at least within 14 cm.
TEST(Motion, a_box_that_is_pushed_beside_its_middle_turns) {
  for (const char* engine : {"dynamic", "planar"}) {
    auto s =
        cruising(world_of(std::string("twinpuck = 1\n[world]\nengine = \"") + engine +
                          "\"\n[[box]]\nposition = [0.12, 0.03]\nsize = [0.1, 0.1, 0.1]\nmovable = true\n"
                          "mass = 0.05\n[[robot]]\n"),
                 kHalfTurn, kHalfTurn);
    run_for(*s, 3);
    EXPECT_GT(s->pose(1).x_m, 0.2) << engine;
    EXPECT_GT(s->pose(1).heading_rad * 180 / sim::kPi, 15) << engine;
  }
}

TEST(Motion, a_braked_robot_resists_the_push_of_another) {
  sim::RobotModel model = puck();
  model.max_push_n = 1.0;  // less than its tyres hold: 1.0 * 0.15 kg * 9.81 m/s2 = 1.47 N
  const auto world =
      world_of("twinpuck = 1\n[[robot]]\n[[robot]]\nposition = [0.1, 0]\nheading = 90\n", {model});
  auto s = simulation_of(
      world, [](int r) { return std::make_unique<Cruise>(r ? 0 : kHalfTurn, r ? 0 : kHalfTurn); });
  run_for(*s, 5);
  // where free pushing would have moved it by 0.3 m
  EXPECT_LT(s->pose(1).x_m, 0.101);
  EXPECT_NEAR(s->pose(1).x_m - s->pose(0).x_m, 0.074, 0.0003);
  EXPECT_EQ(s->touches(1).collisions, 1);
  EXPECT_EQ(s->touches(1).longest_wall_touch_s, 0);
}

TEST(Motion, a_robot_passes_another_by_a_hair_as_if_alone_and_is_turned_aside_by_one_in_its_way) {
  const auto run = [](double beside_m, sim::Pose2& other) {
    const auto world =
        world_of("twinpuck = 1\n[[robot]]\n[[robot]]\nposition = [0.15, " + std::to_string(beside_m) + "]\n");
    auto s = simulation_of(
        world, [](int r) { return std::make_unique<Cruise>(r ? 0 : kHalfTurn, r ? 0 : kHalfTurn); });
    run_for(*s, 5);
    other = s->pose(1);
    return std::make_pair(s->pose(0), s->touches(0).collisions);
  };
  sim::Pose2 other;
  const auto alone = run(1, other);
  // radii 37 mm: rims pass 0.3 mm apart, then 1 mm too near
  const auto [passing, none] = run(0.0743, other);
  EXPECT_EQ(none, 0);
  EXPECT_NEAR(passing.x_m, alone.first.x_m, 1e-9);
  EXPECT_EQ(passing.y_m, alone.first.y_m);
  EXPECT_EQ(other.x_m, 0.15);
  const auto [turned, one] = run(0.073, other);
  EXPECT_EQ(one, 1);
  EXPECT_LT(turned.y_m, -0.0001);
  EXPECT_GT(other.x_m, 0.1501);
}

TEST(Motion, slip_and_wheel_noise_change_the_way) {
  auto slipping = cruising(world_of("twinpuck = 1\n[[robot]]\nslip = 0.25\n"), kHalfTurn, kHalfTurn);
  run_for(*slipping, 10);
  EXPECT_NEAR(slipping->distance_m(0), 0.75 * 0.6440, 0.003);
  auto noisy = cruising(world_of("twinpuck = 1\n[[robot]]\nwheel_noise = 0.2\n"), kHalfTurn, kHalfTurn);
  run_for(*noisy, 10);
  EXPECT_NE(noisy->pose(0).y_m, 0);
  EXPECT_NEAR(noisy->distance_m(0), 0.6440, 0.03);
}

TEST(Motion, wheel_settings_of_the_world_are_inherited_and_a_robots_own_count_more) {
  auto s = cruising(world_of("twinpuck = 1\n[world]\nslip = 0.25\nwheel_noise = 0.2\n"
                             "[[robot]]\nwheel_noise = 0\n"
                             "[[robot]]\nposition = [0, 1]\nslip = 0\nwheel_noise = 0\n"
                             "[[robot]]\nposition = [0, 2]\n"),
                    kHalfTurn, kHalfTurn);
  run_for(*s, 10);
  EXPECT_NEAR(s->distance_m(0), 0.75 * 0.6440, 0.003);
  EXPECT_EQ(s->pose(0).heading_rad, 0);
  EXPECT_NEAR(s->distance_m(1), 0.6440, 0.003);
  EXPECT_NE(s->pose(2).heading_rad, 0);
}

/// Ways of both wheels in each period of 1/32 s, over the way without noise, in the planar engine (exact).
std::vector<double> wheel_factors(const std::string& keys) {
  auto s = cruising(
      world_of("twinpuck = 1\n[world]\nengine = \"planar\"\nphysics_hz = 32\n" + keys + "[[robot]]\n"), 1, 1);
  std::vector<double> factors;
  for (int tick = 0; tick < 2000; ++tick) {
    const sim::BodyState before = s->state(0);
    s->step();
    const sim::Vec2 way{s->pose(0).x_m - before.pose.x_m, s->pose(0).y_m - before.pose.y_m};
    const double turn = 0.5 * (s->pose(0).heading_rad - before.pose.heading_rad) * 0.053;
    factors.push_back((sim::length(way) - turn) * 32 / 0.0205);
    factors.push_back((sim::length(way) + turn) * 32 / 0.0205);
  }
  return factors;
}

TEST(Motion, wheel_noise_is_uniform_or_gaussian) {
  for (const bool gaussian : {false, true}) {
    const std::vector<double> f = wheel_factors(
        gaussian ? "wheel_noise = 0.1\nwheel_noise_law = \"gaussian\"\n" : "wheel_noise = 0.1\n");
    double sum = 0, squares = 0, furthest = 0;
    for (double x : f) {
      sum += x - 1, squares += (x - 1) * (x - 1);
      furthest = std::max(furthest, std::fabs(x - 1));
    }
    const double n = static_cast<double>(f.size());  // 4000 draws: the mean is good to 0.1 / 63
    EXPECT_NEAR(sum / n, 0, 0.005) << gaussian;
    // standard deviation 0.1, or that of a uniform law of half width 0.1: 0.1 / sqrt 3
    EXPECT_NEAR(std::sqrt(squares / n), gaussian ? 0.1 : 0.05774, 0.004) << gaussian;
    if (gaussian) {
      EXPECT_GT(furthest, 0.25);
    } else {
      EXPECT_LE(furthest, 0.1 + 1e-9);
      EXPECT_GT(furthest, 0.099);
    }
  }
}

TEST(Motion, a_bar_above_the_robot_does_not_stop_it) {
  const char* const text = R"(twinpuck = 1
[[wall]]
points = [[0.2, -0.5], [0.2, 0.5]]
z = %Z
height = 0.05
[[robot]]
)";
  for (const bool high : {true, false}) {
    std::string t = text;
    t.replace(t.find("%Z"), 2, high ? "0.06" : "0.03");  // the robot is 47 mm high
    auto s = cruising(world_of(t), kHalfTurn, kHalfTurn);
    run_for(*s, 8);
    if (high) {
      EXPECT_GT(s->pose(0).x_m, 0.5);
    } else {
      EXPECT_NEAR(s->pose(0).x_m, 0.195 - 0.037, 0.0003);
    }
  }
}

TEST(Motion, a_dropped_ball_falls_and_rests) {
  const auto world =
      world_of("twinpuck = 1\n[[ball]]\nposition = [0, 0]\nradius = 0.02\nz = 0.5\nmovable = true\n");
  auto s = cruising(world, 0, 0);
  // after 0.25 s: 0.5 - 9.81 * 0.25^2 / 2 = 0.19344 m
  run_for(*s, 0.25);
  EXPECT_NEAR(s->state(0).z_m, 0.19344, 1e-5);
  run_for(*s, 1);
  EXPECT_EQ(s->state(0).z_m, 0);
  EXPECT_EQ(s->state(0).climb_m_s, 0);
}

TEST(Motion, a_dropped_box_rests_on_a_table_and_falls_when_the_table_is_gone) {
  const auto world = world_of(R"(twinpuck = 1
[[box]]
name = "table"
position = [0, 0]
size = [0.2, 0.2, 0.1]
movable = true
mass = 5
[[box]]
name = "crate"
position = [0.05, 0]
size = [0.05, 0.05, 0.05]
z = 0.3
movable = true
)");
  auto s = cruising(world, 0, 0);
  run_for(*s, 1);
  EXPECT_NEAR(s->state(1).z_m, 0.1, 0.0005);
  run_for(*s, 1);
  EXPECT_NEAR(s->state(1).z_m, 0.1, 0.0005);
  s->move(0, {1, 0, 0});
  run_for(*s, 1);
  EXPECT_EQ(s->state(1).z_m, 0);
}

TEST(Motion, a_crate_on_a_robots_back_rides_along) {
  const auto world = world_of(R"(twinpuck = 1
[[robot]]
[[box]]
position = [0, 0]
size = [0.03, 0.03, 0.03]
z = 0.05
movable = true
mass = 0.01
)");
  auto s = cruising(world, 1, 1);
  run_for(*s, 5);
  EXPECT_NEAR(s->state(1).z_m, 0.047, 0.0005);
  EXPECT_NEAR(s->pose(0).x_m, 5 * 0.0205, 0.001);
  EXPECT_NEAR(s->pose(1).x_m, s->pose(0).x_m, 0.003);
}

TEST(Motion, a_teleported_robot_starts_at_rest_from_there) {
  auto s = cruising(world_of(kFree), kHalfTurn, kHalfTurn);
  run_for(*s, 1);
  const double way = s->distance_m(0);
  s->move(0, {5, 5, 1});
  EXPECT_EQ(s->pose(0).x_m, 5);
  EXPECT_EQ(s->distance_m(0), way);
  EXPECT_EQ(s->scene().pose(0, s->now() - 100000).x_m, 5);
}

TEST(Motion, far_from_the_origin_the_way_is_as_exact) {
  const auto world = world_of(
      "twinpuck = 1\n[[robot]]\nposition = [500, 500]\n"
      "[[box]]\nposition = [500.02, 500.0385]\nsize = [1, 0.001, 0.05]\n");
  auto s = cruising(world, 0.05, 0.05);  // 1 mm/s along a wall that is never touched but always near
  run_for(*s, 10);
  EXPECT_NEAR(s->pose(0).x_m - 500, 0.01025, 0.00006);
}

}  // namespace
