// SPDX-License-Identifier: MIT
// Falling, bouncing and rolling, held against the laws by hand: h_n = e^(2n) h_0, v^2 / (2 c g), 5/7 g sin.
#include <cmath>

#include "tests/sim_core/fixture.h"

using namespace sim_test;

namespace {

constexpr double kG = 9.81;

std::string ball(double restitution, const std::string& more, int hz = 512, const char* engine = "dynamic") {
  return "twinpuck = 1\n[world]\nengine = \"" + std::string(engine) +
         "\"\nphysics_hz = " + std::to_string(hz) +
         "\n[[ball]]\nname = \"ball\"\nposition = [0, 0]\nradius = 0.02\nmovable = true\nmass = 0.02\n"
         "restitution = " +
         std::to_string(restitution) + "\n" + more;
}

/// Tops of the bounces above `ground_m`, as a viewer sees them: the highest z between two
/// ticks near the ground.
std::vector<double> tops(sim::Simulation& s, int body, double ground_m, double seconds) {
  std::vector<double> heights;
  double highest = 0, last_climb = 0;
  while (s.now() < sim::from_seconds(seconds)) {
    s.step();
    const sim::BodyState& b = s.state(body);
    if (b.climb_m_s > 0 && last_climb <= 0) highest = 0;  // it has just bounced
    highest = std::max(highest, b.z_m - ground_m);
    if (b.climb_m_s <= 0 && last_climb > 0) heights.push_back(highest);
    last_climb = b.climb_m_s;
  }
  return heights;
}

TEST(Bounce, heights_follow_the_restitution_law_at_any_tick_rate) {
  for (const char* engine : {"dynamic", "kinematic"}) {
    for (int hz : {96, 512}) {
      for (double e : {0.3, 0.5, 0.8}) {
        auto s = cruising(world_of(ball(e, "z = 0.1\n", hz, engine)), 0, 0);
        const std::vector<double> seen = tops(*s, 0, 0, 3);
        // a top that lasts fewer than four ticks cannot be seen by looking at ticks: v = e^n sqrt(2 g h0)
        int n = 1;
        for (;; ++n) {
          const double speed = std::pow(e, n) * std::sqrt(2 * kG * 0.1);
          if (2 * speed / kG * hz < 4) break;
          ASSERT_GE(seen.size(), static_cast<std::size_t>(n)) << e << " " << hz;
          const double law = std::pow(e, 2 * n) * 0.1;
          // sampling misses at most g (tick / 2)^2 / 2
          EXPECT_LE(seen[n - 1], law * 1.0001) << engine << e << " " << hz << " bounce " << n;
          EXPECT_GE(seen[n - 1], law * 0.9999 - kG / (8.0 * hz * hz))
              << engine << e << " " << hz << " bounce " << n;
          EXPECT_NEAR(seen[n - 1], law, 0.1 * law) << engine << e << " " << hz << " bounce " << n;
        }
        EXPECT_GT(n, hz == 512 ? 2 : 1);
      }
    }
  }
}

TEST(Bounce, energy_between_bounces_is_exact_even_where_ticks_see_no_top) {
  // e = 0.5 from 10 cm: g z + v^2 / 2 is g h0 e^(2n), so each value over the last one is 1/4
  auto s = cruising(world_of(ball(0.5, "z = 0.1\n", 96)), 0, 0);
  double last = kG * 0.1;
  int bounces = 0;
  for (int tick = 0; tick < 96; ++tick) {
    s->step();
    const sim::BodyState& b = s->state(0);
    const double energy = kG * b.z_m + 0.5 * b.climb_m_s * b.climb_m_s;
    if (energy < 5e-4) break;
    const double passed = std::log(last / energy) / std::log(4.0);  // bounces within this tick
    EXPECT_NEAR(passed, std::round(passed), 1e-9);
    bounces += static_cast<int>(std::round(passed));
    last = energy;
  }
  // 0.981 / 4^n: energies above 5e-4 m2/s2 are those of n <= 5; the fifth bounce at 0.41051 s and the sixth
  // at 0.41943 s have the tick at 0.41667 s between them
  EXPECT_EQ(bounces, 5);
}

TEST(Bounce, first_contact_comes_at_its_instant) {
  // sqrt(2 * 0.1 / 9.81) = 0.142784 s; 0.05 s later, with e = 0.5: v = 0.70036 - 0.4905, z = 0.70036 * 0.05 -
  // 9.81 * 0.0025 / 2 = 0.022755 m. At 96 Hz the nearest tick is the 19th, 0.055133 s after the contact:
  // z = 0.70036 * 0.055133 - 4.905 * 0.0030396 = 0.023704 m
  auto s = cruising(world_of(ball(0.5, "z = 0.1\n", 96)), 0, 0);
  for (int tick = 0; tick < 19; ++tick) s->step();
  EXPECT_NEAR(s->state(0).z_m, 0.023704, 2e-6);
}

TEST(Bounce, without_loss_it_bounces_for_ever_at_the_same_height) {
  auto s = cruising(world_of(ball(1, "z = 0.1\n", 96)), 0, 0);
  run_for(*s, 60);
  const sim::BodyState& b = s->state(0);
  EXPECT_NEAR(kG * b.z_m + 0.5 * b.climb_m_s * b.climb_m_s, kG * 0.1, 1e-9);
}

TEST(Bounce, rests_without_jitter) {
  for (int hz : {96, 512}) {
    auto s = cruising(world_of(ball(0.8, "z = 0.1\n[[robot]]\nposition = [0.5, 0]\n", hz)), 0, 0);
    // all bounces last sqrt(2 h / g) (1 + e) / (1 - e) = 1.285 s
    run_for(*s, 1.4);
    const sim::BodyState at_rest = s->state(1);
    EXPECT_EQ(at_rest.z_m, 0);
    EXPECT_EQ(at_rest.climb_m_s, 0);
    for (int tick = 0; tick < 2 * hz; ++tick) {
      s->step();
      ASSERT_EQ(s->state(1).z_m, 0);
      ASSERT_EQ(s->state(1).climb_m_s, 0);
      ASSERT_EQ(s->pose(1).x_m, at_rest.pose.x_m);
      ASSERT_EQ(s->pose(1).y_m, at_rest.pose.y_m);
    }
  }
}

TEST(Bounce, on_a_box_a_platform_and_a_robot) {
  // a box of 6 cm, a platform of 6 cm, a robot of 4.7 cm; e = 0.5 from 0.1 m above each: 25 mm, 6.25 mm
  struct Case {
    const char* name;
    const char* what;
    double top_m;
    int body;
  };
  for (const Case& c :
       {Case{"box", "[[box]]\nposition = [0, 0]\nsize = [0.2, 0.2, 0.06]\n", 0.06, 0},
        Case{"platform", "[[ramp]]\nposition = [0, 0]\nsize = [0.2, 0.2]\nheights = [0.06, 0.06]\n", 0.06, 0},
        Case{"robot", "[[robot]]\n", 0.047, 1}}) {
    auto s = cruising(world_of(ball(0.5, "z = " + std::to_string(c.top_m + 0.1) + "\n" + c.what)), 0, 0);
    const std::vector<double> seen = tops(*s, c.body, c.top_m, 2);
    ASSERT_GE(seen.size(), 2u) << c.name;
    // overlap of 0.1 mm is allowed before solids count as touching
    EXPECT_NEAR(seen[0], 0.025, 0.0003) << c.name;
    EXPECT_NEAR(seen[1], 0.00625, 0.0003) << c.name;
    EXPECT_NEAR(s->state(c.body).z_m, c.top_m, 0.0002) << c.name;
    EXPECT_EQ(s->state(c.body).climb_m_s, 0) << c.name;
  }
}

TEST(Bounce, the_bouncier_of_two_counts) {
  auto s = cruising(world_of("twinpuck = 1\n[[material]]\nname = \"rubber\"\nrestitution = 0.8\n"
                             "[[ball]]\nposition = [0, 0]\nradius = 0.02\nz = 0.2\nmovable = true\n"
                             "restitution = 0.3\n[[ball]]\nposition = [1, 0]\nradius = 0.02\nz = 0.2\n"
                             "movable = true\nrestitution = 0.3\n"
                             "[[box]]\nposition = [0, 0]\nsize = [0.2, 0.2, 0.1]\nmaterial = \"rubber\"\n"
                             "[[ramp]]\nposition = [1, 0]\nheights = [0.1, 0.1]\nmaterial = \"rubber\"\n"),
                    0, 0);
  // 0.1 m above each: 0.64 * 0.1
  EXPECT_NEAR(tops(*s, 0, 0.1, 0.6).at(0), 0.064, 0.0003);
  auto again = cruising(s->scene().world(), 0, 0);
  EXPECT_NEAR(tops(*again, 1, 0.1, 0.6).at(0), 0.064, 0.0003);
}

TEST(Bounce, off_a_slope_it_leaves_by_the_law_of_reflection) {
  // 20 degrees, rising towards +x; h above the slope at x = 0. Impact speed v = sqrt(2 g h) = 1.4007 down,
  // normal part v cos 20 = 1.3162; with e = 0.5 the blow is 1.5 * 1.3162 = 1.9743 along (-sin 20, cos 20): vx
  // = -0.6753, vz = 1.9743 cos 20 - 1.4007 = 0.4545
  const double ground = 0.5 * std::tan(sim::radians(20));
  auto s = cruising(world_of(ball(0.5, "z = " + std::to_string(ground + 0.1) +
                                           "\n[[ramp]]\nposition = [0, 0]\nsize = [1, 1]\nangle = 20\n")),
                    0, 0);
  while (s->state(0).climb_m_s <= 0) s->step();
  EXPECT_NEAR(s->state(0).velocity_m_s.x, -0.6753, 0.001);
  EXPECT_NEAR(s->state(0).velocity_m_s.y, 0, 1e-6);
  EXPECT_NEAR(s->state(0).climb_m_s, 0.4545, kG / 512);
  // 0.1 s of free flight: x by -0.0675, gravity takes 0.981 m/s
  const double x = s->pose(0).x_m, climb = s->state(0).climb_m_s;
  for (int tick = 0; tick < 20; ++tick) s->step();
  EXPECT_NEAR(s->pose(0).x_m - x, -0.6753 * 20 / 512, 0.0005);
  EXPECT_NEAR(s->state(0).climb_m_s, climb - kG * 20 / 512, 1e-6);
}

TEST(Bounce, kinematic_objects_bounce_straight_up_on_a_slope_and_stay_where_they_are) {
  const double ground = 0.5 * std::tan(sim::radians(20));
  auto s = cruising(world_of(ball(0.5,
                                  "z = " + std::to_string(ground + 0.1) +
                                      "\n[[ramp]]\nposition = [0, 0]\nsize = [1, 1]\nangle = 20\n",
                                  512, "kinematic")),
                    0, 0);
  EXPECT_NEAR(tops(*s, 0, ground, 1).at(0), 0.025, 0.0002);
  EXPECT_EQ(s->pose(0).x_m, 0);
  EXPECT_NEAR(s->state(0).z_m, ground, 1e-9);
}

TEST(Rolling, a_ball_rolls_down_a_slope_with_five_sevenths_of_gravity) {
  // 10 degrees, no resistance: 5/7 * 9.81 * sin 10 = 1.2168 m/s2 along the slope; in 0.5 s 0.1521 m, in plan
  // times cos 10: 0.1498 m
  auto s = cruising(world_of(ball(0,
                                  "rolling_friction = 0\n[[ramp]]\nposition = [0, 0]\nsize = [1, 1]\n"
                                  "angle = 10\n")),
                    0, 0);
  run_for(*s, 0.5);
  EXPECT_NEAR(s->pose(0).x_m, -0.1498, 0.001);
}

/// A ball that starts with a speed, 1 cm from a wall or far from it.
struct Thrown {
  std::vector<sim::Placed> fixed;
  sim::Solid wall = sim::Solid::box(0.1, 1, 0, 0.2), sphere = sim::Solid::ball(0.02);
  std::unique_ptr<sim::Motion> motion;
  std::unique_ptr<sim::Neighbours> near;

  Thrown(bool planar, int hz, double speed_m_s, double restitution, double rolling, double wall_x_m) {
    fixed = {{&wall, sim::Frame2({wall_x_m, 0, 0}), 0}};
    sim::MotionDesc desc;
    desc.tick = sim::kClicksPerSecond / hz;
    desc.fixed = &fixed;
    desc.surfaces = {{0.3, 0}};
    desc.solids = {&sphere};
    desc.loose = {{0.02, rolling, 0.3, restitution, true}};
    desc.start = {{{0, 0, 0}, 0, {speed_m_s, 0}, 0, 0}};
    motion = planar ? sim::make_planar_motion(desc) : sim::make_dynamic_motion(desc);
    near = std::make_unique<sim::Neighbours>(fixed, std::vector<double>{0.02}, 0, std::vector<double>{});
  }
  const sim::BodyState& ball() const { return motion->body(0); }
  void run(double seconds, int hz) {
    for (int tick = 0; tick < seconds * hz; ++tick) {
      near->rebuild({{&sphere, sim::Frame2(ball().pose), 0}}, 0, 0, 0);
      motion->step((tick + 1) * sim::kClicksPerSecond / hz, {}, nullptr, *near);
    }
  }
};

TEST(Rolling, resistance_stops_a_ball_after_v2_over_2cg) {
  for (bool planar : {false, true}) {
    for (int hz : {96, 512}) {
      Thrown t(planar, hz, 0.3, 0.5, 0.02, 10);
      t.run(1.8, hz);
      // 0.3 / (0.02 * 9.81) = 1.529 s, 0.09 / (2 * 0.02 * 9.81) = 0.229357798 m
      EXPECT_EQ(t.ball().velocity_m_s.x, 0) << planar << hz;
      // the dynamic engine takes the speed at the end of a tick for all of it: half a tick's way
      EXPECT_NEAR(t.ball().pose.x_m, 0.229357798, planar ? 1e-9 : 0.5 * 0.3 / hz + 0.0005) << planar << hz;
    }
  }
}

TEST(Rolling, off_a_wall_with_the_restitution) {
  for (bool planar : {false, true}) {
    for (int hz : {96, 512}) {
      for (double e : {0.3, 0.5, 0.8}) {
        Thrown t(planar, hz, 0.3, e, 0, 0.1);  // the wall begins at 5 cm
        t.run(0.5, hz);
        EXPECT_NEAR(t.ball().velocity_m_s.x, -0.3 * e, 0.001) << planar << hz << e;
        EXPECT_NEAR(t.ball().velocity_m_s.y, 0, 1e-6);
        // 3 cm at 0.3 m/s, then back for 0.4 s
        EXPECT_NEAR(t.ball().pose.x_m, 0.03 - 0.4 * 0.3 * e, 0.3 * 1.5 / hz) << planar << hz << e;
      }
    }
  }
}

}  // namespace
