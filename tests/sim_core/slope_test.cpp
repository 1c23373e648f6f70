// SPDX-License-Identifier: MIT
// Ramps, tilted floors, and what a body on them truly feels. Expectations are trigonometry by hand.
#include "sim_core/world/true_motion.h"
#include "tests/sim_core/fixture.h"

using namespace sim_test;

namespace {

constexpr double kG = 9.81;

/// A robot on a 20 degree ramp that is 1 m long and wide and rises towards +x; heading relative to uphill.
std::string on_ramp(double heading_deg, const std::string& more = "", const std::string& world = "") {
  return "twinpuck = 1\n[world]\n" + world +
         "\n[[ramp]]\nposition = [0, 0]\nsize = [1, 1]\nangle = 20\n[[robot]]\nheading = " +
         std::to_string(heading_deg) + "\n" + more;
}

const double kSin = std::sin(sim::radians(20)), kCos = std::cos(sim::radians(20));

TEST(Slope, robot_on_a_ramp_pitches_rolls_and_rises) {
  struct Case {
    double heading_deg, pitch_deg, roll_deg, forward, left;
  };
  // nose uphill; uphill on its right, so the left side is low; nose downhill; uphill on its left
  for (const Case& c : {Case{0, 20, 0, kSin, 0}, Case{90, 0, -20, 0, -kSin}, Case{180, -20, 0, -kSin, 0},
                        Case{-90, 0, 20, 0, kSin}}) {
    auto s = cruising(world_of(on_ramp(c.heading_deg)), 0, 0);
    run_for(*s, 0.1);
    const sim::Stance stance = sim::stance(s->scene(), 0, s->now());
    EXPECT_NEAR(sim::degrees(stance.pitch_rad), c.pitch_deg, 1e-6);
    EXPECT_NEAR(sim::degrees(stance.roll_rad), c.roll_deg, 1e-6);
    EXPECT_NEAR(stance.origin_m.z, 0.5 * std::tan(sim::radians(20)), 1e-9);
    EXPECT_NEAR(s->state(0).z_m, 0.5 * std::tan(sim::radians(20)), 1e-9);
    const sim::Vec3 f = sim::specific_force_m_s2(s->scene(), 0, s->now());
    EXPECT_NEAR(f.x, kG * c.forward, 1e-6) << c.heading_deg;
    EXPECT_NEAR(f.y, kG * c.left, 1e-6) << c.heading_deg;
    EXPECT_NEAR(f.z, kG * kCos, 1e-6) << c.heading_deg;
  }
}

TEST(Slope, tilted_floor_tilts_everything_on_it) {
  auto s = cruising(world_of("twinpuck = 1\n[floor]\ntilt = [10, -5]\n[[robot]]\nheading = 90\n"), 0, 0);
  run_for(*s, 0.1);
  // it looks along +y, which falls by 5 degrees; its left is -x, which falls by 10
  const sim::Vec3 f = sim::specific_force_m_s2(s->scene(), 0, s->now());
  EXPECT_NEAR(f.x, -kG * std::sin(sim::radians(5)), 1e-6);
  EXPECT_NEAR(f.y, -kG * std::sin(sim::radians(10)), 1e-6);
  EXPECT_NEAR(f.x * f.x + f.y * f.y + f.z * f.z, kG * kG, 1e-6);
  EXPECT_EQ(s->state(0).z_m, 0);
  EXPECT_NEAR(s->pose(0).x_m, 0, 1e-12) << "grip of 1 holds on 11 degrees";
}

TEST(Slope, way_along_the_slope_is_shorter_in_plan) {
  for (const char* engine : {"dynamic", "kinematic"}) {
    const std::string world = "engine = \"" + std::string(engine) + "\"";
    auto up = cruising(world_of(on_ramp(0, "position = [-0.2, 0]\n", world)), sim::kPi, sim::kPi);
    run_for(*up, 4);
    const double way = 4 * sim::kPi * 0.0205;  // 0.2576 m along the slope
    EXPECT_NEAR(up->pose(0).x_m, -0.2 + way * kCos, 0.002) << engine;
    EXPECT_NEAR(up->state(0).z_m, (0.3 + way * kCos) * std::tan(sim::radians(20)), 0.001) << engine;
    auto across = cruising(world_of(on_ramp(90, "", world)), sim::kPi, sim::kPi);
    run_for(*across, 4);
    EXPECT_NEAR(across->pose(0).y_m, way, 0.002) << engine;
    EXPECT_NEAR(across->pose(0).x_m, 0, 0.001) << engine;
  }
}

TEST(Slope, a_full_turn_on_the_slope_is_a_full_turn_in_plan) {
  auto s = cruising(world_of(on_ramp(0, "", "engine = \"kinematic\"")), -sim::kPi, sim::kPi);
  // 2 * 0.0644 m/s over the axle of 53 mm: 2.4303 rad/s
  run_for(*s, 2 * sim::kPi / (2 * sim::kPi * 0.0205 / 0.053));
  EXPECT_NEAR(s->pose(0).heading_rad, 2 * sim::kPi, 0.01);
}

TEST(Slope, standing_wheels_hold_up_to_the_angle_of_friction_and_slide_beyond) {
  // friction 0.3 holds up to atan(0.3) = 16.7 degrees
  const std::string slippery = "\n[floor]\nfriction = 0.3\n";
  auto holds = cruising(world_of("twinpuck = 1\n[floor]\nfriction = 0.3\n[[ramp]]\nposition = [0, 0]\n"
                                 "size = [1, 1]\nangle = 16\n[[robot]]\nheading = 30\n"),
                        0, 0);
  run_for(*holds, 1);
  EXPECT_NEAR(holds->pose(0).x_m, 0, 1e-9);
  for (double heading_deg : {0.0, 90.0}) {
    auto slides = cruising(world_of(on_ramp(heading_deg) + slippery), 0, 0);
    run_for(*slides, 0.5);
    // along the slope g (sin 20 - 0.3 cos 20) = 0.5896 m/s2; in plan 0.5540; in 0.5 s 0.0693 m down
    EXPECT_NEAR(slides->pose(0).x_m, -0.0693, 0.001) << heading_deg;
    EXPECT_NEAR(slides->pose(0).y_m, 0, 1e-6) << heading_deg;
    // only friction is felt along the slope: 0.3 of what the floor bears
    const sim::Vec3 f = sim::specific_force_m_s2(slides->scene(), 0, slides->now());
    EXPECT_NEAR(heading_deg == 0 ? f.x : -f.y, 0.3 * kG * kCos, 0.02) << heading_deg;
  }
}

TEST(Slope, tilted_floor_lets_a_slippery_robot_slide_near_walls_too) {
  // 20 degrees down towards -x, friction 0.3; the wall beside it puts the robot into the contact solver
  auto s = cruising(world_of("twinpuck = 1\n[floor]\nfriction = 0.3\ntilt = [20, 0]\n[[box]]\n"
                             "position = [0, 0.1375]\nsize = [1, 0.2, 0.1]\n[[robot]]\n"),
                    0, 0);
  run_for(*s, 0.5);
  // the floor's own plane is the plan: 0.5 * 0.5896 * 0.25
  EXPECT_NEAR(s->pose(0).x_m, -0.0737, 0.002);
}

TEST(Slope, ramp_platform_and_ramp_down_are_driven_over) {
  const auto world = world_of(R"(twinpuck = 1
[[ramp]]
position = [0.2, 0]
size = [0.2, 0.2]
angle = 20
[[ramp]]
position = [0.4, 0]
size = [0.2, 0.2]
heights = [0.0727940, 0.0727940]
[[ramp]]
position = [0.6, 0]
size = [0.2, 0.2]
heading = 180
angle = 20
[[robot]]
)");
  auto s = cruising(world, 4, 4);  // 0.082 m/s
  double highest = 0;
  while (s->pose(0).x_m < 0.8 && s->now() < sim::from_seconds(15)) {
    s->step();
    highest = std::max(highest, s->state(0).z_m);
  }
  EXPECT_GE(s->pose(0).x_m, 0.8);
  EXPECT_NEAR(highest, 0.2 * std::tan(sim::radians(20)), 1e-6);
  EXPECT_NEAR(s->state(0).z_m, 0, 1e-12);
  EXPECT_EQ(s->touches(0).collisions, 0);
}

TEST(Slope, sensors_see_a_steep_ramp_ahead_and_tilt_with_their_robot) {
  // level robot, eye at 37 mm ahead and 25 mm up: a 35 degree ramp is met where it is 25 mm high, 35.7 mm in
  const auto before = world_of(R"(twinpuck = 1
[proximity]
profile = "webots-old"
rays = 1
[[ramp]]
position = [0.15, 0]
size = [0.2, 0.2]
angle = 35
[[robot]]
model = "one-eyed"
)");
  auto s = cruising(before, 0, 0);
  run_for(*s, 0.05);
  const sim::RayTrace ray = sim::trace_proximity(s->scene(), 0, 0, s->now()).front();
  EXPECT_TRUE(ray.hit);
  EXPECT_NEAR(ray.distance_m, 0.05 + 0.025 / std::tan(sim::radians(35)) - 0.037, 1e-6);
  // a black one answers with 0.2 of it: as if it were five times as far away
  auto black_world = before;
  black_world.ramps[0].material.colour = {0, 0, 0};
  auto black = cruising(black_world, 0, 0);
  run_for(*black, 0.05);
  EXPECT_NEAR(sim::sense_proximity(black->scene(), 0, 0, black->now()).apparent_distance_m,
              5 * sim::sense_proximity(s->scene(), 0, 0, s->now()).apparent_distance_m, 1e-6);
  // nose down on a 20 degree slope the eye looks along the slope at a low box beyond its foot
  auto down = cruising(world_of(on_ramp(180, "model = \"one-eyed\"\nposition = [-0.45, 0]\n") +
                                "[[box]]\nposition = [-0.59, 0]\nsize = [0.1, 0.4, 0.03]\n"),
                       0, 0);
  run_for(*down, 0.05);
  const sim::RayTrace low = sim::trace_proximity(down->scene(), 0, 0, down->now()).front();
  const double eye_m = 0.45 + 0.037 * kCos + 0.025 * kSin;  // distance from the origin, on -x
  EXPECT_TRUE(low.hit);
  EXPECT_NEAR(low.from_m.x, -eye_m, 1e-9);
  EXPECT_NEAR(low.from_m.z, 0.05 * kSin / kCos + 0.025 * kCos - 0.037 * kSin, 1e-9);
  EXPECT_NEAR(low.distance_m, (0.54 - eye_m) / kCos, 1e-6);
}

TEST(Slope, lamp_straight_above_lights_a_sensor_that_looks_uphill) {
  // a level sensor does not see a lamp above it; nose up by 20 degrees its facing is sin 20
  const std::string lamp = "[[lamp]]\nposition = [0, 0, 50]\nintensity = 10\n";
  auto level = cruising(
      world_of("twinpuck = 1\n[[robot]]\nmodel = \"one-eyed\"\nposition = [-0.037, 0]\n" + lamp), 0, 0);
  EXPECT_NEAR(sim::sense_irradiance_w_m2(level->scene(), 0, 0, 0), 0, 0.001);
  auto up = cruising(world_of(on_ramp(0, "model = \"one-eyed\"\nposition = [-0.037, 0]\n") + lamp), 0, 0);
  EXPECT_NEAR(sim::sense_irradiance_w_m2(up->scene(), 0, 0, 0), 10 * kSin, 0.01);
}

TEST(Slope, edges_of_a_ramp_stop_robots_on_both_sides) {
  for (const char* engine : {"dynamic", "kinematic"}) {
    const std::string world = "engine = \"" + std::string(engine) + "\"";
    auto on_it = cruising(world_of(on_ramp(90, "position = [0, 0.3]\n", world)), 5, 5);
    run_for(*on_it, 4);
    // the kerb is 2 mm thick: 0.5 - 0.002 - 0.037
    EXPECT_NEAR(on_it->pose(0).y_m, 0.461, 0.001) << engine;
    auto below = cruising(world_of(on_ramp(180, "position = [0.7, 0]\n", world)), 5, 5);
    run_for(*below, 4);
    EXPECT_NEAR(below->pose(0).x_m, 0.537, 0.001) << engine << ": the high end is a wall from outside";
    EXPECT_EQ(below->state(0).z_m, 0);
  }
}

TEST(Slope, loose_objects_slide_or_hold_and_rise) {
  const auto with_box = [](double friction) {
    return world_of(on_ramp(0, "position = [0, 0.4]\n") +
                    "[[box]]\nposition = [0.2, 0]\nsize = [0.04, 0.04, 0.04]\nmovable = true\nfriction = " +
                    std::to_string(friction) + "\n");
  };
  auto holds = cruising(with_box(0.5), 0, 0);
  run_for(*holds, 1);
  EXPECT_NEAR(holds->pose(1).x_m, 0.2, 0.0005);
  EXPECT_NEAR(holds->state(1).z_m, 0.7 * std::tan(sim::radians(20)), 0.001);
  EXPECT_NEAR(sim::degrees(sim::stance(holds->scene(), 1, holds->now()).pitch_rad), 20, 1e-6);
  auto slides = cruising(with_box(0.1), 0, 0);
  run_for(*slides, 0.3);
  // g (sin 20 - 0.1 cos 20) cos 20 = 2.287 m/s2 in plan: 0.1029 m
  EXPECT_NEAR(slides->pose(1).x_m, 0.2 - 0.1029, 0.004);
  EXPECT_NEAR(slides->state(1).z_m, (slides->pose(1).x_m + 0.5) * std::tan(sim::radians(20)), 1e-6);
}

// Without friction a ball rolls as high as it came from, whatever bends lie between: 512 Hz is the usual tick, at
// 96 Hz a ball goes 9 mm in one. docs/limits.md says what remains.
TEST(Slope, a_ball_that_rolls_over_bends_keeps_its_energy) {
  struct Case {
    double down_deg, up_deg;
    int hz;
    double within;
  };
  for (const Case& c :
       {Case{30, 5, 512, 0.02}, Case{5, 30, 512, 0.02}, Case{20, 20, 512, 0.02}, Case{40, 10, 512, 0.02},
        Case{10, 40, 512, 0.02}, Case{30, 5, 2048, 0.005}, Case{30, 5, 96, 0.1}, Case{5, 30, 96, 0.1}}) {
    // the ramp down ends at x = -0.5, the one up begins at 0.5; the ball begins 0.15 m up the first one
    auto s = cruising(
        world_of("twinpuck = 1\n[world]\nphysics_hz = " + std::to_string(c.hz) +
                 "\n[[ramp]]\nposition = [-0.7, 0]\nsize = [0.4, 0.3]\nheading = 180\nangle = " +
                 std::to_string(c.down_deg) +
                 "\n[[ramp]]\nposition = [1.1, 0]\nsize = [1.2, 0.3]\nangle = " + std::to_string(c.up_deg) +
                 "\n[[ball]]\nradius = 0.02\nposition = [-0.65, 0]\nmovable = true\nrolling_friction = 0\n"
                 "[[robot]]\nposition = [0, 1.5]\n"),
        0, 0);
    double farthest = 0;
    for (int tick = 0; tick < 8 * c.hz; ++tick) {
      s->step();
      farthest = std::max(farthest, s->pose(1).x_m);
    }
    const double from = 0.15 * std::tan(sim::radians(c.down_deg)),
                 to = (farthest - 0.5) * std::tan(sim::radians(c.up_deg));
    EXPECT_NEAR(to / from, 1, c.within) << c.down_deg << " " << c.up_deg << " " << c.hz;
  }
}

TEST(Slope, a_box_that_slides_off_a_ramp_keeps_its_speed_along_the_floor) {
  // without friction 0.15 m of a ramp of 30 degrees are 0.0866 m of height: sqrt(2 g h) = 1.3035 m/s
  auto s = cruising(
      world_of("twinpuck = 1\n[[ramp]]\nposition = [-0.7, 0]\nsize = [0.4, 0.3]\nheading = 180\nangle = 30\n"
               "[[box]]\nsize = [0.04, 0.04, 0.04]\nposition = [-0.65, 0]\nmovable = true\nfriction = 0\n"
               "[[robot]]\nposition = [0, 1.5]\n"),
      0, 0);
  for (int tick = 0; tick < 3 * 512 && s->pose(1).x_m < 0; ++tick) s->step();
  EXPECT_NEAR(s->state(1).velocity_m_s.x, std::sqrt(2 * kG * 0.15 * std::tan(sim::radians(30))), 0.03);
}

TEST(Slope, a_bend_keeps_the_speed_along_the_surface) {
  for (const auto& [before, after] :
       {std::pair(sim::Vec2{-0.577, 0}, sim::Vec2{0, 0}), std::pair(sim::Vec2{0, 0}, sim::Vec2{0.3, 0.2}),
        std::pair(sim::Vec2{-0.1, 0.4}, sim::Vec2{0.5, -0.1})}) {
    const sim::Vec2 v{0.7, 0.2}, w = sim::behind_bend(v, before, after);
    const auto square = [](sim::Vec2 plan, sim::Vec2 slope) {
      return dot(plan, plan) + dot(slope, plan) * dot(slope, plan);
    };
    EXPECT_NEAR(square(w, after), square(v, before), 1e-12);
  }
}

TEST(TrueMotion, a_blow_lasts_five_milliseconds_and_takes_all_the_speed) {
  for (int hz : {96, 512, 1024}) {
    // 0.1 m/s against a wall whose face is 0.05 m before the robot's
    auto s = cruising(world_of("twinpuck = 1\n[world]\nphysics_hz = " + std::to_string(hz) +
                               "\n[[box]]\nposition = [0.137, 0]\nsize = [0.1, 0.4, 0.1]\n[[robot]]\n"),
                      0.1 / 0.0205, 0.1 / 0.0205);
    run_for(*s, 0.3);
    double lowest = 0, sum = 0;
    const sim::Clicks step = sim::kClicksPerSecond / 8192;
    for (int tick = 0; tick < hz / 2; ++tick) {
      s->step();
      for (sim::Clicks at = s->now() - s->scene().tick_clicks(); at < s->now(); at += step) {
        const double f = sim::specific_force_m_s2(s->scene(), 0, at).x;
        lowest = std::min(lowest, f);
        sum += f * sim::to_seconds(step);
      }
    }
    EXPECT_NEAR(sum, -0.1, 0.01) << hz;
    const double lasts_s = std::max(0.005, 1.0 / hz);
    EXPECT_NEAR(lowest, -0.1 / lasts_s, 0.35 * 0.1 / lasts_s) << hz;
  }
}

TEST(TrueMotion, circles_pull_inwards_and_turn) {
  auto s = cruising(world_of("twinpuck = 1\n[[robot]]\n"), 2, 4);
  run_for(*s, 2);
  // v = 0.0615 m/s, spin = 2 * 0.0205 / 0.053 = 0.77358 rad/s: the turn is to the left
  const sim::Vec3 f = sim::specific_force_m_s2(s->scene(), 0, s->now() - 1000);
  EXPECT_NEAR(f.y, 0.0615 * 0.77358, 0.001);
  EXPECT_NEAR(f.x, 0, 0.001);
  EXPECT_NEAR(f.z, kG, 1e-9);
  const sim::Vec3 turn = sim::angular_rate_rad_s(s->scene(), 0, s->now());
  EXPECT_NEAR(turn.z, 0.77358, 1e-4);
  EXPECT_NEAR(turn.x, 0, 1e-9);
}

TEST(TrueMotion, turning_on_a_slope_is_felt_about_the_body_axis) {
  auto s = cruising(world_of(on_ramp(45)), -sim::kPi, sim::kPi);
  run_for(*s, 1);
  const sim::Vec3 turn = sim::angular_rate_rad_s(s->scene(), 0, s->now());
  EXPECT_NEAR(turn.z, 2 * sim::kPi * 0.0205 / 0.053, 0.01);
  EXPECT_NEAR(turn.x, 0, 0.01);
  EXPECT_NEAR(turn.y, 0, 0.01);
}

TEST(SlopeWorlds, mistakes_are_named) {
  const auto report = [](const std::string& text) {
    const sim::LoadedWorld loaded = sim::parse_world("twinpuck = 1\n" + text, "w.toml", {puck()});
    return loaded.report("w.toml");
  };
  EXPECT_EQ(report("[[ramp]]\nposition = [0, 0]\n"),
            "w.toml:2:1: ramp: got neither angle nor heights, expected one of them (deg; m)");
  EXPECT_EQ(report("[[ramp]]\nposition = [0, 0]\nangle = 10\nheights = [0, 0.1]\n"),
            "w.toml:5:11: ramp.heights: got 'angle' besides, expected one of them");
  EXPECT_EQ(report("[[ramp]]\nposition = [0, 0]\nheights = [0, 0.3]\n"),
            "w.toml:4:11: ramp.heights: got a rise of 0.3 m over 0.2 m, expected at most 0.1678 m (40 deg)");
  EXPECT_EQ(report("[[ramp]]\nposition = [0, 0]\nangle = 50\n"),
            "w.toml:4:9: ramp.angle: got 50, expected number from 0 to 40 deg");
  EXPECT_EQ(report("[floor]\ntilt = [50, 0]\n"),
            "w.toml:3:8: floor.tilt: got [50, 0], expected two numbers [x, y] from -40 to 40 deg");
  EXPECT_EQ(report("[[ramp]]\nposition = [0, 0]\nangle = 10\n"), "");
}

}  // namespace
