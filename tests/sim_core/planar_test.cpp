// SPDX-License-Identifier: MIT
// The planar engine: wheels exactly, no overlap, pushing by hand-made rules, no heights.
#include <cmath>

#include "sim_core/physics/plan_contact.h"
#include "tests/sim_core/fixture.h"
#include "twinpuck_paths.h"

using namespace sim_test;

namespace {

/// 500 steps/s of 1000 steps per turn: pi rad/s; with a wheel of 20.5 mm 64.4 mm/s.
constexpr double kHalfTurn = sim::kPi, kSpeed = kHalfTurn * 0.0205;

sim::WorldDesc planar(const std::string& rest, int hz = 512, std::vector<sim::RobotModel> models = {puck()}) {
  return world_of(
      "twinpuck = 1\n[world]\nengine = \"planar\"\nphysics_hz = " + std::to_string(hz) + "\n" + rest,
      std::move(models));
}

std::string problems_of(const std::string& rest) {
  return sim::parse_world("twinpuck = 1\n[world]\nengine = \"planar\"\n" + rest, "test.toml", {puck()})
      .report("test.toml");
}

TEST(Planar, straight_way_and_circle_are_the_wheels_own) {
  for (int hz : {96, 512}) {
    auto s = cruising(planar("[[robot]]\nheading = 30\n", hz), kHalfTurn, kHalfTurn);
    run_for(*s, 10);
    EXPECT_NEAR(s->pose(0).x_m, 10 * kSpeed * std::cos(sim::kPi / 6), 1e-9) << hz;  // no start-up, no slip
    EXPECT_NEAR(s->pose(0).y_m, 10 * kSpeed * 0.5, 1e-9) << hz;
    // spin = (4 - 2) * 0.0205 / 0.053 = 0.77358 rad/s, radius 3 * 0.0205 / 0.77358 = 0.0795 m: after 3 s
    // x = r sin, y = r (1 - cos) of 2.32075 rad
    auto arc = cruising(planar("[[robot]]\n", hz), 2, 4);
    run_for(*arc, 3);
    EXPECT_NEAR(arc->pose(0).heading_rad, 2.32075, 1e-5) << hz;
    EXPECT_NEAR(arc->pose(0).x_m, 0.0795 * std::sin(2.32075), 2e-6) << hz;
    EXPECT_NEAR(arc->pose(0).y_m, 0.0795 * (1 - std::cos(2.32075)), 2e-6) << hz;
  }
}

TEST(Planar, against_a_wall_it_stays_and_slides_along_it) {
  for (int hz : {96, 512}) {
    for (double heading_deg : {0.0, 60.0}) {
      auto s = cruising(planar("[[box]]\nposition = [0.15, 0]\nsize = [0.1, 4, 0.1]\n[[robot]]\nheading = " +
                                   std::to_string(heading_deg) + "\n",
                               hz),
                        kHalfTurn, kHalfTurn);
      run_for(*s, 5);
      // wall at 0.10, radius 0.037; what the wall does not take is driven: y = 5 v sin
      EXPECT_NEAR(s->pose(0).x_m, 0.063, 0.0001) << hz;
      EXPECT_NEAR(s->pose(0).y_m, 5 * kSpeed * std::sin(sim::radians(heading_deg)), 1e-6) << hz;
      EXPECT_EQ(s->touches(0).collisions, 1) << hz;
      const double arrives = 0.063 / (kSpeed * std::cos(sim::radians(heading_deg)));
      EXPECT_NEAR(s->touches(0).longest_wall_touch_s, 5 - arrives, 0.03) << hz;
    }
  }
}

TEST(Planar, a_box_is_pushed_when_the_robot_can_push_more_than_its_friction) {
  sim::RobotModel model = puck();
  model.max_push_n = 1.0;
  const auto run = [&](const char* mass, int hz) {
    auto s = cruising(planar("[[box]]\nposition = [0.1, 0]\nsize = [0.06, 0.06, 0.05]\nmovable = true\n"
                             "friction = 0.5\nmass = " +
                                 std::string(mass) + "\n[[robot]]\n",
                             hz, {model}),
                      kHalfTurn, kHalfTurn);
    run_for(*s, 5);
    EXPECT_NEAR(s->pose(1).x_m - s->pose(0).x_m, 0.067, 0.0001);
    EXPECT_NEAR(s->pose(1).y_m, 0, 1e-9);
    EXPECT_NEAR(s->pose(1).heading_rad, 0, 1e-9);
    return s->pose(1).x_m;
  };
  for (int hz : {96, 512}) {
    // friction 0.5 m g: 1 N is that of 0.20387 kg. The robot's front meets the box after 33 mm.
    EXPECT_NEAR(run("0.2", hz), 0.1 + 5 * kSpeed - 0.033, 0.0002) << hz;
    EXPECT_NEAR(run("0.21", hz), 0.1, 0.0001) << hz;
  }
}

TEST(Planar, two_robots_push_what_one_cannot_and_from_both_sides_nothing_moves) {
  sim::RobotModel model = puck();
  model.max_push_n = 1.0;
  const std::string box =
      "[[box]]\nposition = [0.1, 0]\nsize = [0.06, 0.2, 0.05]\nmovable = true\nfriction = 0.5\nmass = 0.3\n";
  auto together = cruising(
      planar(box + "[[robot]]\nposition = [0, 0.05]\n[[robot]]\nposition = [0, -0.05]\n", 512, {model}),
      kHalfTurn, kHalfTurn);
  run_for(*together, 5);
  EXPECT_NEAR(together->pose(2).x_m, 0.1 + 5 * kSpeed - 0.033, 0.0003);
  auto against =
      cruising(planar(box + "[[robot]]\n[[robot]]\nposition = [0.2, 0]\nheading = 180\n", 512, {model}),
               kHalfTurn, kHalfTurn);
  run_for(*against, 5);
  EXPECT_NEAR(against->pose(2).x_m, 0.1, 0.0002);
  EXPECT_NEAR(against->pose(0).x_m, 0.033, 0.0002);
  EXPECT_NEAR(against->pose(1).x_m, 0.167, 0.0002);
}

TEST(Planar, a_box_between_robot_and_wall_holds_the_robot) {
  auto s = cruising(planar("[[box]]\nposition = [0.1, 0]\nsize = [0.06, 0.06, 0.05]\nmovable = true\n"
                           "[[wall]]\npoints = [[0.205, -1], [0.205, 1]]\n[[robot]]\n"),
                    kHalfTurn, kHalfTurn);
  run_for(*s, 5);
  // the wall begins at 0.2: box at 0.17, robot at 0.17 - 0.03 - 0.037
  EXPECT_NEAR(s->pose(1).x_m, 0.17, 0.0003);
  EXPECT_NEAR(s->pose(0).x_m, 0.103, 0.0005);
  EXPECT_LT(std::fabs(s->state(1).velocity_m_s.x), 0.001);
  EXPECT_LT(std::fabs(s->state(0).velocity_m_s.x), 0.001);
}

TEST(Planar, head_on_robots_meet_in_the_middle_and_a_standing_one_is_not_moved) {
  auto s =
      cruising(planar("[[robot]]\n[[robot]]\nposition = [0.2, 0]\nheading = 180\n"), kHalfTurn, kHalfTurn);
  run_for(*s, 5);
  EXPECT_NEAR(s->pose(0).x_m, 0.063, 0.0001);
  EXPECT_NEAR(s->pose(1).x_m, 0.137, 0.0001);
  EXPECT_EQ(s->touches(0).collisions, 1);
  EXPECT_EQ(s->touches(1).collisions, 1);
  EXPECT_EQ(s->touches(0).longest_wall_touch_s, 0);
  auto standing = simulation_of(planar("[[robot]]\n[[robot]]\nposition = [0.2, 0]\n"), [](int r) {
    return std::make_unique<Cruise>(r ? 0 : kHalfTurn, r ? 0 : kHalfTurn);
  });
  run_for(*standing, 5);
  EXPECT_NEAR(standing->pose(0).x_m, 0.126, 0.0001);
  EXPECT_EQ(standing->pose(1).x_m, 0.2);
}

TEST(Planar, a_box_hit_beside_its_middle_turns) {
  auto s = cruising(planar("[[box]]\nposition = [0.1, 0.025]\nsize = [0.06, 0.06, 0.05]\nmovable = true\n"
                           "[[robot]]\n"),
                    kHalfTurn, kHalfTurn);
  run_for(*s, 2);
  EXPECT_GT(s->pose(1).heading_rad, 0.1);  // its middle is left of the push: counter-clockwise
  EXPECT_GT(s->pose(1).x_m, 0.12);
}

TEST(Planar, balls_share_momentum) {
  // equal balls without loss: the first stops, the second has its speed (0.0644 m/s * 2: a robot of endless
  // mass kicks a ball of e = 1 at twice its own speed)
  for (const bool along_y : {false, true}) {
    const auto at = [along_y](const char* way) {
      return std::string("position = ") + (along_y ? "[0, " : "[") + way + (along_y ? "]\n" : ", 0]\n");
    };
    const std::string ball = "radius = 0.02\nmovable = true\nrestitution = 1\nrolling_friction = 0\n";
    auto s = cruising(planar("[[ball]]\n" + at("0.1") + ball + "[[ball]]\n" + at("0.3") + ball +
                             "[[robot]]\n" + (along_y ? "heading = 90\n" : "")),
                      kHalfTurn, kHalfTurn);
    const auto speed = [&s, along_y](int body) {
      const sim::Vec2 v = s->state(body).velocity_m_s;
      return along_y ? v.y : v.x;
    };
    // contact after 43 mm / v = 0.668 s; the ball needs 160 mm / 2 v = 1.243 s: 1.911 s
    run_for(*s, 1.8);
    EXPECT_NEAR(speed(1), 2 * kSpeed, 1e-6);
    EXPECT_EQ(speed(2), 0);
    run_for(*s, 0.2);
    EXPECT_NEAR(speed(1), 0, 1e-6);
    EXPECT_NEAR(speed(2), 2 * kSpeed, 1e-6);
  }
}

TEST(Planar, nothing_falls_and_everything_is_as_high_as_needed) {
  // a ball from 10 cm lies on the floor at once; a bar above the robot stops it
  auto s =
      cruising(planar("[[ball]]\nposition = [-0.5, 0]\nradius = 0.02\nz = 0.1\nmovable = true\n"
                      "[[wall]]\npoints = [[0.2, -0.5], [0.2, 0.5]]\nz = 0.06\nheight = 0.05\n[[robot]]\n"),
               kHalfTurn, kHalfTurn);
  EXPECT_EQ(s->state(1).z_m, 0);
  run_for(*s, 8);
  EXPECT_EQ(s->state(1).z_m, 0);
  EXPECT_EQ(s->state(1).climb_m_s, 0);
  EXPECT_NEAR(s->pose(0).x_m, 0.195 - 0.037, 0.0001);
  s->move(1, {-0.5, 0.2, 0}, 0.1);
  EXPECT_EQ(s->state(1).z_m, 0);
}

TEST(Planar, worlds_that_need_heights_are_refused) {
  EXPECT_EQ(problems_of("[[ramp]]\nposition = [0, 0]\nangle = 10\n"),
            "test.toml:4:1: ramp: got a ramp with the planar engine, expected none; engines dynamic and "
            "kinematic know heights");
  EXPECT_EQ(
      problems_of("[floor]\ntilt = [5, 0]\n"),
      "test.toml: floor.tilt: got [5, 0] deg with the planar engine, expected [0, 0]; engines dynamic and "
      "kinematic know heights");
  const std::string table =
      "[[box]]\nname = \"table\"\nposition = [0, 0]\n[[box]]\nname = \"crate\"\n"
      "position = [0, 0]\nsize = [0.05, 0.05, 0.05]\nz = 0.2\nmovable = true\n";
  EXPECT_EQ(
      problems_of(table),
      "test.toml:7:1: box 'crate': got position [0, 0] m inside box 'table' (line 4), expected free room "
      "(the planar engine knows no heights)");
}

TEST(Planar, sensors_are_those_of_the_other_engines) {
  const auto reading = [](const char* engine, double wall_z_m) {
    auto s = cruising(world_of("twinpuck = 1\n[world]\nengine = \"" + std::string(engine) +
                               "\"\n[[box]]\nposition = [0.1, 0]\nsize = [0.1, 1, 0.1]\nz = " +
                               std::to_string(wall_z_m) + "\n[[robot]]\n"),
                      0, 0);
    run_for(*s, 0.1);
    return s->minds()[0]->proximity_counts(s->scene(), 0) +
           sim::sense_proximity(s->scene(), 0, 0, s->now()).value;
  };
  EXPECT_GT(reading("planar", 0), 100);
  EXPECT_EQ(reading("planar", 0), reading("dynamic", 0));
  EXPECT_EQ(reading("planar", 0.06), reading("dynamic", 0.06));  // rays pass below a bar, which still stops
}

TEST(Planar, a_crowd_repeats_on_any_number_of_threads_and_nobody_overlaps) {
  for (int robots : {0, 100, 1000}) {
    sim::WorldDesc world;
    if (robots == 0) {
      world = planar("[[ball]]\nposition = [0, 0]\nradius = 0.02\nmovable = true\n");
    } else {
      const std::string file = TWINPUCK_SOURCE_DIR "/bench/worlds/brait_" + std::to_string(robots) + ".toml";
      const sim::LoadedWorld loaded = sim::load_world(file, {puck()});
      ASSERT_TRUE(loaded.world) << loaded.report(file);
      world = *loaded.world;
      world.engine = sim::Engine::Planar;
    }
    std::uint64_t digests[2];
    double deepest = 1;
    for (int threads : {1, 3}) {
      auto s = simulation_of(
          world, [](int r) { return std::make_unique<Braitenberg>(r); }, threads);
      run_for(*s, robots == 1000 ? 1 : 5);
      digests[threads / 3] = s->digest();
      for (int r = 0; r < s->robots(); ++r) {
        const sim::Vec2 at{s->pose(r).x_m, s->pose(r).y_m};
        for (int o = r + 1; o < s->robots(); ++o) {
          deepest = std::min(deepest, sim::length(sim::Vec2{s->pose(o).x_m, s->pose(o).y_m} - at) - 0.074);
        }
        for (const sim::Placed& wall : s->scene().layout().fixed) {
          deepest = std::min(deepest, sim::plan_distance_m(at, wall) - 0.037);
        }
      }
    }
    EXPECT_EQ(digests[0], digests[1]) << robots;
    EXPECT_GT(deepest, -0.0005) << robots;
  }
}

TEST(Planar, a_yard_full_of_boxes_and_balls_stays_sound) {
  // twelve robots drive curves through thirty things in a square metre
  for (int hz : {96, 512}) {
    std::string text = "[arena]\nsize = [1, 1]\n";
    for (int i = 0; i < 42; ++i) {
      const std::string at = "position = [" + std::to_string(-0.42 + 0.14 * (i % 7)) + ", " +
                             std::to_string(-0.4 + 0.16 * (i / 7)) +
                             "]\nheading = " + std::to_string(i * 37) + "\n";
      if (i % 7 % 3 == 1) {
        text += "[[robot]]\n" + at;
      } else if (i % 2) {
        text += "[[ball]]\nradius = 0.02\nmovable = true\nmass = 0.02\nrestitution = 0.5\n" + at;
      } else {
        text += "[[box]]\nsize = [0.06, 0.04, 0.05]\nmovable = true\nmass = 0.05\n" + at;
      }
    }
    auto s = simulation_of(planar(text, hz),
                           [](int r) { return std::make_unique<Cruise>(6 - 0.1 * r, 5 + 0.1 * r); });
    double deepest = 0, fastest = 0;
    for (int second = 0; second < 10; ++second) {
      run_for(*s, 1);
      std::vector<sim::Placed> all;
      for (int b = 0; b < 42; ++b) all.push_back(s->scene().placed(b, s->now()));
      for (int a = 0; a < 42; ++a) {
        ASSERT_LT(std::fabs(s->pose(a).x_m), 0.5) << "inside the walls";
        ASSERT_LT(std::fabs(s->pose(a).y_m), 0.5) << "inside the walls";
        fastest = std::max(fastest, sim::length(s->state(a).velocity_m_s));
        for (int b = a + 1; b < 42; ++b) {
          deepest = std::max(deepest, sim::plan_contact(all[a], all[b]).depth_m);
        }
        for (const sim::Placed& wall : s->scene().layout().fixed) {
          deepest = std::max(deepest, sim::plan_contact(all[a], wall).depth_m);
        }
      }
    }
    EXPECT_LT(deepest, 0.0002) << hz;  // a contact keeps 0.05 mm
    EXPECT_LT(fastest, 0.4) << hz;     // a ball may leave a robot at 1.5 times its 0.12 m/s, and be hit again
  }
}

}  // namespace
