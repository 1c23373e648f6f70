// SPDX-License-Identifier: MIT
// Tables, ray placement, weights, colour rule, pose history. Source of the numbers: [FRM] A3, B1, B2.
#include "sim_core/light/profiles.h"
#include "sim_core/light/response_curve.h"
#include "tests/sim_core/fixture.h"

using namespace sim_test;

namespace {

TEST(Proximity, four_rays_weigh_as_the_lab_computes) {
  // exp(-(0.15 / 0.3)^2) = 0.7788; 1 / (1 + 3 * 0.7788) = 0.2997; the others 0.2334
  const auto rays = sim::plan_rays(4, 0.3, 1, sim::RayLayout::Cone);
  ASSERT_EQ(rays.size(), 4u);
  EXPECT_NEAR(rays[0].weight, 0.2997, 5e-5);
  for (int i = 1; i < 4; ++i) {
    EXPECT_NEAR(rays[static_cast<std::size_t>(i)].weight, 0.2334, 5e-5);
    EXPECT_NEAR(rays[static_cast<std::size_t>(i)].dir.x, std::cos(0.15), 1e-12);
  }
}

TEST(Proximity, every_number_of_rays_has_a_placement_whose_weights_add_up) {
  for (int n = 1; n <= 40; ++n) {
    for (auto layout : {sim::RayLayout::Cone, sim::RayLayout::Fan}) {
      for (double width : {0.0, 0.5, 1.0}) {
        const auto rays = sim::plan_rays(n, 0.5, width, layout);
        ASSERT_EQ(static_cast<int>(rays.size()), n);
        double sum = 0;
        for (const auto& r : rays) {
          sum += r.weight;
          EXPECT_LE(r.off_axis_rad, 0.25 + 1e-12);
          EXPECT_NEAR(r.dir.x * r.dir.x + r.dir.y * r.dir.y + r.dir.z * r.dir.z, 1, 1e-12);
        }
        EXPECT_NEAR(sum, 1, 1e-12);
      }
    }
  }
}

TEST(Proximity, a_fan_of_three_lies_in_the_plane) {
  const auto rays = sim::plan_rays(3, sim::radians(30), 1, sim::RayLayout::Fan);
  EXPECT_NEAR(rays[0].dir.y, std::sin(sim::radians(15)), 1e-12);
  EXPECT_NEAR(rays[1].dir.y, 0, 1e-12);
  EXPECT_NEAR(rays[2].dir.y, -std::sin(sim::radians(15)), 1e-12);
  for (const auto& r : rays) EXPECT_EQ(r.dir.z, 0);
}

TEST(Proximity, width_zero_leaves_the_ray_on_the_axis) {
  const auto rays = sim::plan_rays(4, 0.3, 0, sim::RayLayout::Cone);
  EXPECT_EQ(rays[0].weight, 1);
  EXPECT_EQ(rays[1].weight, 0);
}

TEST(Proximity, tables_are_linear_between_rows_and_clamped_beyond) {
  const auto& old = sim::find_profile("webots-old")->table;
  EXPECT_EQ(sim::look_up(old, -1).value, 4095);
  EXPECT_EQ(sim::look_up(old, 0.0025).value, (4095 + 3474) / 2.0);
  EXPECT_NEAR(sim::look_up(old, 0.0025).relative_noise, 0.021, 1e-12);
  EXPECT_EQ(sim::look_up(old, 0.01).value, 2211);
  EXPECT_EQ(sim::look_up(old, 1).value, 34);
  EXPECT_EQ(sim::look_up(old, 1).relative_noise, .704);
}

TEST(Proximity, a_curve_equals_its_table_everywhere) {
  for (const auto& p : sim::proximity_profiles()) {
    const sim::ResponseCurve curve(p.table);
    for (int i = -10; i < 14000; ++i) {
      const double d = i * 1e-5;
      EXPECT_NEAR(curve.at(d).value, sim::look_up(p.table, d).value, 1e-9) << p.name << d;
    }
    for (const auto& row : p.table) EXPECT_EQ(curve.at(row.distance_m).value, row.value) << p.name;
  }
}

TEST(Proximity, enki_and_inverse_square_tables_follow_their_laws) {
  // Enki at 5 mm: 3731 * (0.7 - 0.09) / (0.25 - 0.3 + 0.7) = 3501; at 20 mm 650
  EXPECT_NEAR(sim::look_up(sim::find_profile("enki")->table, 0.005).value, 3501, 1);
  EXPECT_NEAR(sim::look_up(sim::find_profile("enki")->table, 0.02).value, 650, 1);
  EXPECT_NEAR(sim::look_up(sim::find_profile("inverse-square")->table, 0.02).value, 625, 0.5);
  EXPECT_NEAR(sim::look_up(sim::find_profile("inverse-square")->table, 0.005).value, 4095, 0.5);
  EXPECT_NEAR(sim::look_up(sim::find_profile("argos")->table, 0.01).value, 3043, 1);
}

/// A wall `gap` metres in front of the one-eyed robot's sensor.
std::string wall_world(double gap, const std::string& more = "", const std::string& material = "") {
  return "twinpuck = 1\n[proximity]\nnoise_scale = 0\n" + more + "\n[[box]]\nposition = [" +
         std::to_string(0.037 + gap + 0.05) + ", 0]\nsize = [0.1, 0.6, 0.1]\n" + material +
         "\n[[robot]]\nmodel = \"one-eyed\"\n";
}

TEST(Proximity, white_wall_straight_ahead_reads_the_table) {
  for (const auto& p : sim::proximity_profiles()) {
    if (p.aperture_rad != 0 && !p.rays_answer_singly && p.rays > 1) continue;
    for (double mm : {0.5, 5., 10., 20., 30., 50.}) {
      auto s = cruising(world_of(wall_world(mm / 1000, std::string("profile = \"") + p.name + "\"")), 0, 0);
      const auto r = sim::sense_proximity(s->scene(), 0, 0, 0);
      EXPECT_NEAR(r.value, sim::look_up(p.table, mm / 1000).value, 0.002) << p.name << " " << mm;
      EXPECT_EQ(r.relative_noise, 0);
    }
  }
}

TEST(Proximity, black_and_blue_walls_look_five_times_as_far) {
  for (const char* colour : {"[0, 0, 0]", "[0, 0, 1]"}) {
    auto s = cruising(
        world_of(wall_world(0.01, "profile = \"webots-old\"", std::string("colour = ") + colour)), 0, 0);
    const auto r = sim::sense_proximity(s->scene(), 0, 0, 0);
    EXPECT_NEAR(r.apparent_distance_m, 0.05, 1e-6);
    EXPECT_NEAR(r.value, 90, 0.01);
  }
  // generic sensors see no colour
  auto s = cruising(
      world_of(wall_world(0.01, "profile = \"webots-old\"\ntype = \"generic\"", "colour = [0, 0, 0]")), 0, 0);
  EXPECT_NEAR(sim::sense_proximity(s->scene(), 0, 0, 0).value, 2211, 0.01);
}

TEST(Proximity, the_newer_rule_counts_roughness) {
  const std::string rough = "[[material]]\nname = \"matt\"\nroughness = 1\n";
  auto s = cruising(world_of("twinpuck = 1\n" + rough +
                             "[proximity]\nprofile = \"webots-old\"\ncolour_rule = \"new\"\n"
                             "[[box]]\nposition = [0.107, 0]\nmaterial = \"matt\"\nsize = [0.1, 0.6, 0.1]\n"
                             "[[robot]]\nmodel = \"one-eyed\"\n"),
                    0, 0);
  // f = .2 + .8 * .5 = .6; 20 mm look like 33.3 mm
  EXPECT_NEAR(sim::sense_proximity(s->scene(), 0, 0, 0).apparent_distance_m, 0.02 / 0.6, 1e-6);
}

TEST(Proximity, nothing_ahead_reads_the_last_row) {
  auto s = cruising(
      world_of("twinpuck = 1\n[proximity]\nprofile = \"webots-old\"\n[[robot]]\nmodel = \"one-eyed\"\n"), 0,
      0);
  EXPECT_EQ(sim::sense_proximity(s->scene(), 0, 0, 0).value, 34);
}

TEST(Proximity, cone_rays_that_miss_count_as_the_whole_range) {
  // four rays of 0.3 rad, wall at 60 mm: centre 0.060, cones 0.060 / cos 0.15 = 0.06068
  auto s =
      cruising(world_of(wall_world(0.06, "profile = \"webots-old\"\nrays = 4\naperture_rad = 0.3")), 0, 0);
  const double d = 0.29970 * 0.06 + 0.70030 * 0.06 / std::cos(0.15);
  EXPECT_NEAR(sim::sense_proximity(s->scene(), 0, 0, 0).apparent_distance_m, d, 1e-6);
}

TEST(Proximity, a_wall_lower_than_the_sensor_is_not_seen) {
  auto low = cruising(world_of("twinpuck = 1\n[[box]]\nposition = [0.1, 0]\nsize = [0.1, 0.6, 0.02]\n"
                               "[[robot]]\nmodel = \"one-eyed\"\n"),
                      0, 0);
  EXPECT_NEAR(sim::sense_proximity(low->scene(), 0, 0, 0).apparent_distance_m, 0.1, 1e-9);
}

TEST(Proximity, other_robots_are_seen_and_the_own_body_is_not) {
  auto s =
      cruising(world_of("twinpuck = 1\n[proximity]\ncolour_rule = \"none\"\n[[robot]]\nmodel = \"one-eyed\"\n"
                        "[[robot]]\nposition = [0.104, 0]\n"),
               0, 0);
  // 0.104 - 0.037 - 0.037 = 0.030
  EXPECT_NEAR(sim::sense_proximity(s->scene(), 0, 0, 0).apparent_distance_m, 0.030, 1e-9);
}

TEST(Proximity, a_table_may_reach_as_far_as_10_m) {
  const auto world = world_of("twinpuck = 1\n[proximity]\ntable = [[0, 1000, 0], [10, 0, 0]]\n[[robot]]\n");
  EXPECT_EQ(sim::resolve_proximity(world, 0, 0).table.back().distance_m, 10);
}

TEST(Proximity, settings_are_inherited_and_overridden) {
  const auto world = world_of(R"(twinpuck = 1
[proximity]
profile = "webots-old"
noise_scale = 2
[[robot]]
[robot.proximity]
rays = 4
aperture = 20
[[robot.sensor]]
index = 3
profile = "webots-new"
noise_scale = 0
[[robot.sensor]]
index = 5
table = [[0, 1000, 0.1], [0.1, 0, 0]]
[[robot]]
position = [1, 0]
)");
  const auto c0 = sim::resolve_proximity(world, 0, 0), c3 = sim::resolve_proximity(world, 0, 3);
  const auto c5 = sim::resolve_proximity(world, 0, 5), d0 = sim::resolve_proximity(world, 1, 0);
  EXPECT_EQ(c0.rays, 4);
  EXPECT_EQ(c0.noise_scale, 2);
  EXPECT_EQ(c0.table.size(), 9u);
  EXPECT_EQ(c3.table.size(), 10u);
  EXPECT_EQ(c3.noise_scale, 0);
  EXPECT_EQ(c5.table.size(), 2u);
  EXPECT_EQ(c0.profile, "webots-old");
  EXPECT_EQ(c3.profile, "webots-new");
  EXPECT_EQ(c5.profile, "") << "a table of one's own has no name";
  EXPECT_EQ(d0.rays, 1);
}

TEST(Scene, poses_are_carried_on_from_the_tick_before_whenever_they_are_asked_for) {
  auto s = cruising(world_of("twinpuck = 1\n[world]\nengine = \"kinematic\"\nphysics_hz = 128\n[[robot]]\n"),
                    2, 2);
  run_for(*s, 1);
  const double v = 2 * 0.0205;
  for (double back_s : {0.0, 0.001, 0.0078125, 0.02, 0.0399}) {
    const sim::Clicks at = s->now() - sim::from_seconds(back_s);
    EXPECT_NEAR(s->scene().pose(0, at).x_m, v * sim::to_seconds(at), 1e-9) << back_s;
  }
  const sim::Clicks ahead = s->now() + sim::kClicksPerSecond / 256;
  EXPECT_NEAR(s->scene().pose(0, ahead).x_m, v * sim::to_seconds(ahead), 1e-9);
  // a leg that begins at the next tick does not change what was true in this one
  const sim::Clicks early = ahead, tick = s->scene().tick_clicks();
  const double then_m = s->scene().pose(0, early).x_m;
  sim::Scene other(s->scene().world(), {0.1});
  other.advance_to(tick);
  other.begin_leg(0, {tick, {1, 0, 0}, {v, 0}, 0, false}, 0, 0);
  other.advance_to(2 * tick);
  other.begin_leg(0, {2 * tick, {1.004, 0, 0}, {0.5, 0}, 0, false}, 0, 0);
  EXPECT_EQ(other.pose(0, tick + tick / 2).x_m, 1 + v * sim::to_seconds(tick / 2));
  EXPECT_NEAR(other.pose_on_way(0, tick + tick / 2).x_m, 1.002, 1e-12);
  EXPECT_EQ(other.pose_on_way(0, 3 * tick).x_m, 1.004);
  run_for(*s, 0.02);
  EXPECT_EQ(s->scene().pose(0, early).x_m, then_m);
  // before the world began everything stood where it stands at 0
  auto fresh = cruising(world_of("twinpuck = 1\n[[robot]]\nposition = [3, 0]\n"), 2, 2);
  EXPECT_EQ(fresh->scene().pose(0, -1000).x_m, 3);
}

// legs that begin at every tick, and at some; each is known by its place. Of one instant the last counts
TEST(Scene, of_many_legs_the_one_that_had_begun_is_found) {
  for (const int every : {1, 2, 5}) {
    sim::Scene scene(world_of("twinpuck = 1\n[world]\nphysics_hz = 512\n[[robot]]\n"), {0.1});
    const sim::Clicks tick = scene.tick_clicks();
    for (int n = 1; n <= 100; ++n) {
      scene.advance_to(n * tick);
      for (const double x_m : {-1.0, -2.0, n * 1.0})
        if (n % every == 0) scene.begin_leg(0, {n * tick, {x_m, 0, 0}, {}, 0, false}, 0, 0);
    }
    // poses of 40 ms are kept: 20 ticks and a half
    for (int back = 0; back <= 20; ++back) {
      const int at = (100 - back) / every * every;
      EXPECT_EQ(scene.pose(0, (100 - back) * tick).x_m, at) << back << " of " << every;
      EXPECT_EQ(scene.pose(0, (100 - back + 1) * tick - 1).x_m, at) << back << " of " << every;
    }
    // older than all: the oldest
    EXPECT_LE(scene.pose(0, 0).x_m, 100 - 20);
  }
}

TEST(Scene, long_rays_meet_the_nearest_thing) {
  auto s = cruising(
      world_of("twinpuck = 1\n[arena]\nsize = [8, 8]\n[[cylinder]]\nposition = [2, 0]\nradius = 0.1\n"
               "[[robot]]\n[[robot]]\nposition = [3, 0]\n"),
      0, 0);
  sim::SceneHit hit;
  ASSERT_TRUE(s->scene().cast({{0, 0, 0.02}, {1, 0, 0}}, 100, 0, 0, &hit));
  EXPECT_NEAR(hit.distance_m, 1.9, 1e-9);
  EXPECT_NEAR(hit.normal.x, -1, 1e-9);
  ASSERT_TRUE(s->scene().cast({{0, 0, 0.02}, {0, 1, 0}}, 100, 0, 0, &hit));
  EXPECT_NEAR(hit.distance_m, 4, 1e-9);
  ASSERT_TRUE(s->scene().cast({{2.5, 0, 0.02}, {1, 0, 0}}, 100, -1, 0, &hit));
  EXPECT_EQ(hit.robot, 1);
  ASSERT_TRUE(s->scene().cast({{0, 0.5, 0.02}, {0, 0.6, -0.8}}, 100, -1, 0, &hit));
  EXPECT_TRUE(hit.floor);
  EXPECT_NEAR(hit.distance_m, 0.025, 1e-9);
  EXPECT_FALSE(s->scene().cast({{0, 0, 0.02}, {0, 0, 1}}, 100, 0, 0, &hit));
}

TEST(Light, a_lamp_shines_by_its_law_and_casts_shadows) {
  const char* const text = R"(twinpuck = 1
[world]
ambient = 0.5
[[lamp]]
position = [1.037, 0, 0.025]
intensity = 3
attenuation = [0, 0, 2]
[[robot]]
model = "one-eyed"
)";
  auto s = cruising(world_of(text), 0, 0);
  // distance 1 m, straight ahead: 0.5 + 3 / 2
  EXPECT_NEAR(sim::sense_irradiance_w_m2(s->scene(), 0, 0, 0), 2.0, 1e-9);
  auto shaded = cruising(world_of(std::string(text) + "[[box]]\nposition = [0.5, 0]\n"), 0, 0);
  EXPECT_NEAR(sim::sense_irradiance_w_m2(shaded->scene(), 0, 0, 0), 0.5, 1e-9);
  s->move(0, {0, 0, sim::kPi});
  EXPECT_NEAR(sim::sense_irradiance_w_m2(s->scene(), 0, 0, 0), 0.5, 1e-9);
}

// rays that go out together are culled together and have shorter formulas; one by one they
// end at the same places
TEST(Proximity, a_fan_ends_where_its_rays_do) {
  const sim::Solid box = sim::Solid::box(0.3, 0.02, 0, 0.1), prism = sim::Solid::prism(box.outline, 0, 0.1),
                   post = sim::Solid::cylinder(0.04, 0, 0.1), ball = sim::Solid::ball(0.05);
  const sim::Frame2 there(sim::Pose2{0.2, -0.1, 0.7});
  for (const sim::Solid* solid : {&box, &prism, &post, &ball}) {
    const sim::Placed what{solid, there, 0.01};
    int met = 0, missed = 0;
    for (const double rise : {0.0, 0.2})
      for (double x = 0; x < 0.4; x += 0.023)
        for (double y = -0.3; y < 0.1; y += 0.029)
          for (double angle = 0; angle < 6.28; angle += 0.31) {
            sim::Fan fan{{x, y, 0.03}, {}, std::sin(0.26), std::cos(0.26), false, rise == 0, 0.12, {}};
            const sim::SinCos axis = sim::sin_cos(angle);
            fan.axis = {axis.c, axis.s};
            for (const double aside : {-0.25, 0.0, 0.25}) {
              const sim::SinCos way = sim::sin_cos(angle + aside);
              const double level = std::sqrt(1 - rise * rise);
              fan.dirs.push_back({level * way.c, level * way.s, rise});
            }
            sim::RayEnd ends[3] = {{0.12, 1}, {0.12, 1}, {0.05, 1}};
            const bool any = sim::cast_fan(fan, what, 0.5, ends);
            bool any_alone = false;
            for (int i = 0; i < 3; ++i) {
              double alone = i < 2 ? 0.12 : 0.05;
              const bool hit = sim::cast_ray({fan.from, fan.dirs[static_cast<std::size_t>(i)]}, what, alone);
              ASSERT_NEAR(ends[i].distance_m, alone, 1e-12) << x << " " << y << " " << angle << " ray " << i;
              ASSERT_EQ(ends[i].factor, hit ? 0.5 : 1);
              any_alone = any_alone || hit;
              (hit ? met : missed) += 1;
            }
            ASSERT_EQ(any, any_alone);
          }
    EXPECT_GT(met, 1000);
    EXPECT_GT(missed, 1000);
  }
}

TEST(Proximity, what_is_far_is_left_out_for_as_long_as_it_cannot_come) {
  // a post of 5 cm, another robot of 3 cm; rays reach 10 cm
  const sim::Solid post = sim::Solid::cylinder(0.05, 0, 0.1), body = sim::Solid::cylinder(0.03, 0, 0.05);
  const std::vector<sim::Placed> fixed{{&post, sim::Frame2(sim::Pose2{0.17, 0, 0}), 0}};
  sim::Neighbours near(fixed, {0.03, 0.03}, 2, {0.1, 0.1});
  const auto gather = [&](double pace_m_s) {
    near.rebuild(
        {{&body, sim::Frame2(sim::Pose2{0, 0, 0}), 0}, {&body, sim::Frame2(sim::Pose2{0, 0.15, 0}), 0}}, 0,
        pace_m_s, sim::kClicksPerSecond);
  };
  const auto at = [](double s) { return sim::kClicksPerSecond + sim::from_seconds(s); };
  // the post's side is 2 cm beyond reach: 0.2 s at 10 cm/s. The other's is, too, but both may drive: 0.1 s
  gather(0.1);
  ASSERT_EQ(near.end(0) - near.begin(0), 2);
  const sim::Candidate *post_seen = near.begin(0), *robot_seen = post_seen + 1;
  ASSERT_FALSE(post_seen->moving);
  for (const double sign : {-1, 1}) {
    EXPECT_FALSE(near.may_see(post_seen, at(sign * 0.199)));
    EXPECT_TRUE(near.may_see(post_seen, at(sign * 0.2)));
    EXPECT_FALSE(near.may_see(robot_seen, at(sign * 0.099)));
    EXPECT_TRUE(near.may_see(robot_seen, at(sign * 0.1)));
    EXPECT_FALSE(near.may_see(0, at(sign * 0.099)));
    EXPECT_TRUE(near.may_see(0, at(sign * 0.1)));
  }
  gather(0);
  EXPECT_FALSE(near.may_see(0, at(5))) << "nobody moves";
}

// a box has shorter formulas than other prisms; the same corners as a plain prism are what
// they must agree with
TEST(Proximity, a_box_is_the_prism_of_its_corners) {
  const sim::Solid box = sim::Solid::box(0.3, 0.1, 0.02, 0.1);
  const sim::Solid prism = sim::Solid::prism(box.outline, 0.02, 0.1);
  ASSERT_TRUE(box.is_box());
  ASSERT_FALSE(prism.is_box());
  const sim::Frame2 there(sim::Pose2{0.2, -0.1, 0.7});
  const sim::Placed as_box{&box, there, 0}, as_prism{&prism, there, 0};
  int hits = 0, inside = 0;
  for (double x = -0.1; x < 0.5; x += 0.017)
    for (double y = -0.4; y < 0.2; y += 0.019) {
      sim::Vec2 to_box, to_prism;
      const double d = sim::plan_distance_m({x, y}, as_box, &to_box);
      EXPECT_NEAR(d, sim::plan_distance_m({x, y}, as_prism, &to_prism), 1e-12) << x << " " << y;
      EXPECT_NEAR(to_box.x, to_prism.x, 1e-9) << x << " " << y;
      EXPECT_NEAR(to_box.y, to_prism.y, 1e-9) << x << " " << y;
      inside += d < 0;
      for (double angle = 0; angle < 6.28; angle += 0.3) {
        const sim::SinCos way = sim::sin_cos(angle);
        const sim::Vec2 axis{way.c, way.s};
        EXPECT_EQ(sim::out_of_sight({x, y}, axis, 0.25, 0.96, 0.1, as_box),
                  sim::out_of_sight({x, y}, axis, 0.25, 0.96, 0.1, as_prism));
        for (double z : {0.01, 0.05}) {
          const sim::Ray ray{{x, y, z}, {way.c, way.s, 0}};
          double near = 0.2, expected = 0.2;
          const bool hit = sim::cast_ray(ray, as_box, near);
          ASSERT_EQ(hit, sim::cast_ray(ray, as_prism, expected)) << x << " " << y << " " << angle;
          EXPECT_NEAR(near, expected, 1e-12);
          hits += hit;
        }
      }
    }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(inside, 50);
}

// --- the floor's picture

// two by two pixels over an arena of 2 m by 1 m around (1, 0): each holds its left and upper edge, and what is
// outside is plain
TEST(Floor, each_pixel_holds_its_left_and_upper_edge) {
  sim::WorldDesc world;
  world.arena.emplace();
  world.arena->centre_m = {1, 0};
  world.arena->size_m = {2, 1};
  world.floor.colour = {0.5, 0.5, 0.5};
  world.floor.image_width = world.floor.image_height = 2;
  world.floor.image_rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 51, 102, 153};
  const struct {
    sim::Vec2 at_m;
    double r, g, b;
  } cases[] = {{{0, 0.5}, 1, 0, 0},       {{0.999, 0.001}, 1, 0, 0},
               {{1, 0.5}, 0, 1, 0},       {{1.999, 0.25}, 0, 1, 0},
               {{0, 0}, 0, 0, 1},         {{0.5, -0.499}, 0, 0, 1},
               {{1, 0}, 0.2, 0.4, 0.6},   {{-0.001, 0}, 0.5, 0.5, 0.5},
               {{2, 0}, 0.5, 0.5, 0.5},   {{1, 0.501}, 0.5, 0.5, 0.5},
               {{1, -0.5}, 0.5, 0.5, 0.5}};
  for (const auto& c : cases) {
    const sim::Colour got = sim::floor_at(world, c.at_m).colour;
    EXPECT_TRUE(got.r == c.r && got.g == c.g && got.b == c.b)
        << c.at_m.x << ", " << c.at_m.y << ": " << got.r << " " << got.g << " " << got.b;
  }
}

}  // namespace
