// SPDX-License-Identifier: MIT
// Readings taken apart, response curves of flat walls, notices about odd sensors. Expectations by hand from
// [FRM B1, B2, B3].
#include "sim_core/light/explain.h"

#include "tests/sim_core/fixture.h"
#include "tests/support/wording.h"

using namespace sim_test;

namespace {

/// A wall `gap` metres before the one-eyed robot's sensor, which sits at x = 0.037, 25 mm high.
std::string wall_at(double gap, const std::string& settings, const std::string& wall = "") {
  const bool named = settings.find("profile") != std::string::npos;
  return std::string("twinpuck = 1\n[proximity]\n") + (named ? "" : "profile = \"webots-old\"\n") + settings +
         "\n[[box]]\nname = \"crate\"\nposition = [" + std::to_string(0.037 + gap + 0.05) +
         ", 0]\nsize = [0.1, 0.6, 0.1]\n" + wall + "\n[[robot]]\nmodel = \"one-eyed\"\n";
}

sim::ProximityExplanation explain(const std::string& world, int sensor = 0) {
  auto s = cruising(world_of(world), 0, 0);
  return sim::explain_proximity(s->scene(), 0, sensor, 0);
}

TEST(Explain, one_ray_tells_hit_colour_row_and_value) {
  // 12 mm before a wall of red 0.5: f = 0.2 + 0.8 * 0.5 = 0.6, apparent 20 mm; row 4 alone: 676, noise 0.105
  const auto e = explain(wall_at(0.012, "", "colour = [0.5, 1, 1]"));
  ASSERT_EQ(e.rays.size(), 1u);
  EXPECT_EQ(e.rays[0].met.name, "box 'crate'");
  EXPECT_NEAR(e.rays[0].met.top_m, 0.1, 1e-12);
  EXPECT_NEAR(e.rays[0].trace.colour_factor, 0.6, 1e-12);
  EXPECT_NEAR(e.rays[0].apparent_m, 0.020, 1e-9);
  EXPECT_NEAR(e.distance_m, 0.012, 1e-9);
  EXPECT_NEAR(e.factor, 0.6, 1e-12);
  EXPECT_NEAR(e.response.value, 676, 0.01);
  EXPECT_NEAR(e.response.relative_noise, 0.105, 1e-4);
  EXPECT_NEAR(e.rays[0].bearing_rad, 0, 1e-12);
  EXPECT_EQ(e.config.profile, "webots-old");
}

TEST(Explain, between_two_rows_the_fraction_is_named) {
  // 24 mm: 0.4 of the way from row 4 (20 mm, 676) to row 5 (30 mm, 306): 528
  const auto e = explain(wall_at(0.024, ""));
  EXPECT_EQ(e.step.row, 3);
  EXPECT_FALSE(e.step.clamped);
  EXPECT_NEAR(e.step.fraction, 0.4, 1e-6);
  EXPECT_EQ(e.step.from.value, 676);
  EXPECT_EQ(e.step.to.value, 306);
  EXPECT_NEAR(e.step.result.value, 528, 0.01);
  EXPECT_NEAR(e.response.value, 528, 0.01);
}

TEST(Explain, beyond_the_ends_one_row_answers) {
  const auto& old = sim::find_profile("webots-old")->table;
  const auto far = sim::table_step(old, 0.35);  // black wall at the range's end
  EXPECT_TRUE(far.clamped);
  EXPECT_EQ(far.row, 8);
  EXPECT_EQ(far.result.value, 34);
  EXPECT_EQ(sim::table_step(old, -1).row, 0);
  EXPECT_TRUE(sim::table_step(old, -1).clamped);
  EXPECT_FALSE(sim::table_step(old, 0.07).clamped);
}

TEST(Explain, a_cone_of_four_lies_above_and_to_both_sides_below) {
  const auto e = explain(wall_at(0.02, "rays = 4\naperture_rad = 0.3"));
  ASSERT_EQ(e.rays.size(), 4u);
  EXPECT_NEAR(e.rays[0].trace.weight, 0.2997, 5e-5);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(e.rays[i].trace.weight, 0.2334, 5e-5);
    EXPECT_NEAR(e.rays[i].off_axis_rad, 0.15, 1e-12);
  }
  // the first of a cone points up, the others are its mirror images below [Webots: polarTo3d]
  EXPECT_NEAR(e.rays[1].rise_rad, 0.15, 1e-9);
  EXPECT_NEAR(e.rays[1].bearing_rad, 0, 1e-9);
  EXPECT_NEAR(e.rays[2].bearing_rad, -e.rays[3].bearing_rad, 1e-9);
  EXPECT_LT(e.rays[2].bearing_rad, -0.1);  // to the right first
  EXPECT_NEAR(e.rays[2].rise_rad, e.rays[3].rise_rad, 1e-9);
  EXPECT_LT(e.rays[2].rise_rad, -0.05);
}

TEST(Explain, two_rays_lie_side_by_side) {
  const auto rays = sim::plan_rays(2, 0.4, 1, sim::RayLayout::Cone);
  EXPECT_NEAR(rays[0].dir.y, -std::sin(0.2), 1e-12);
  EXPECT_NEAR(rays[1].dir.y, std::sin(0.2), 1e-12);
  for (const auto& r : rays) EXPECT_NEAR(r.dir.z, 0, 1e-12);
}

TEST(Explain, more_than_ten_rays_fill_orbits_of_four_seven_and_ten) {
  const auto rays = sim::plan_rays(22, 0.6, 1, sim::RayLayout::Cone);  // 1 + 4 + 7 + 10
  int at[4] = {};
  for (const auto& r : rays) {
    const double orbit = r.off_axis_rad / 0.1;  // three orbits within half an aperture of 0.3
    EXPECT_NEAR(orbit, std::round(orbit), 1e-9);
    ++at[static_cast<int>(std::round(orbit))];
  }
  EXPECT_EQ(at[0], 1);
  EXPECT_EQ(at[1], 4);
  EXPECT_EQ(at[2], 7);
  EXPECT_EQ(at[3], 10);
  // not full: the last orbit shares out evenly what is left, on the edge of the cone
  const auto twelve = sim::plan_rays(12, 0.6, 1, sim::RayLayout::Cone);  // 1 + 4 + 7
  EXPECT_NEAR(twelve[11].off_axis_rad, 0.3, 1e-12);
}

TEST(Explain, width_zero_leaves_what_is_nearest_to_the_axis) {
  // nine rays: three at 0.3 of the half aperture, six at the edge; none on the axis
  const auto nine = sim::plan_rays(9, 0.5, 0, sim::RayLayout::Cone);
  for (int i = 0; i < 9; ++i)
    EXPECT_NEAR(nine[static_cast<std::size_t>(i)].weight, i < 3 ? 1. / 3 : 0, 1e-12) << i;
  // so small a width that every weight underflows means the same
  const auto tiny = sim::plan_rays(3, 0.5, 1e-4, sim::RayLayout::Cone);
  for (const auto& r : tiny) EXPECT_NEAR(r.weight, 1. / 3, 1e-12);
}

TEST(Explain, enki_rays_answer_singly_and_add_up) {
  // wall at 20 mm, side rays 20 / cos 15 = 20.7055 mm; F(20) = 650.2, the sum is F(20) again
  const auto e = explain(wall_at(0.02, "profile = \"enki\""));
  ASSERT_EQ(e.rays.size(), 3u);
  const double side = sim::look_up(e.config.table, 0.02 / std::cos(sim::radians(15))).value;
  EXPECT_NEAR(e.rays[0].answer_counts, side, 0.01);
  EXPECT_NEAR(e.rays[1].answer_counts, e.response.value - 2 * side, 0.01);
  EXPECT_NEAR(e.response.value, 650, 1);
}

TEST(Explain, what_is_hit_is_named_whatever_it_is) {
  const std::string world = R"(twinpuck = 1
[arena]
size = [0.4, 0.4]
[[robot]]
name = "me"
position = [0.12, 0]
[[robot]]
name = "you"
position = [0.043, 0.055]
[[cylinder]]
name = "post"
position = [0.12, 0.1]
radius = 0.02
)";
  auto s = cruising(world_of(world), 0, 0);
  const auto name = [&](int sensor) {
    const auto e = sim::explain_proximity(s->scene(), 0, sensor, 0);
    return e.rays[0].trace.hit ? e.rays[0].met.name : "nothing";
  };
  EXPECT_NE(name(0).find("arena wall"), std::string::npos) << name(0);
  EXPECT_NE(name(5).find("post"), std::string::npos) << name(5);
  EXPECT_NE(name(4).find("you"), std::string::npos) << name(4);
  EXPECT_EQ(name(2), "nothing");
}

// whichever way the robot looks: between -180 and 180 degrees
TEST(Explain, rays_have_their_bearing_from_the_robot) {
  for (const double yaw_deg : {-11.0, 0.0, 100.0, 179.0, -179.0})
    for (const double heading_deg : {0.0, 170.0, -170.0}) {
      auto eye = one_eyed();
      eye.proximity[0].yaw_rad = sim::radians(yaw_deg);
      auto s = cruising(world_of("twinpuck = 1\n[[robot]]\nmodel = \"one-eyed\"\nheading = " +
                                     std::to_string(heading_deg) + "\n",
                                 {eye}),
                        0, 0);
      const auto e = sim::explain_proximity(s->scene(), 0, 0, 0);
      EXPECT_NEAR(sim::degrees(e.bearing_rad), yaw_deg, 1e-6);
      EXPECT_NEAR(sim::degrees(e.rays[0].bearing_rad), yaw_deg, 1e-6) << heading_deg;
    }
}

TEST(Explain, a_ray_down_meets_the_floor_and_a_ramp) {
  auto down = one_eyed();
  down.proximity[0].pitch_rad = sim::radians(-30);
  auto s = cruising(world_of("twinpuck = 1\n[[robot]]\nmodel = \"one-eyed\"\n", {down}), 0, 0);
  const auto e = sim::explain_proximity(s->scene(), 0, 0, 0);
  EXPECT_EQ(e.rays[0].met.name, "the floor");
  EXPECT_NEAR(e.rays[0].trace.distance_m, 0.05, 1e-9);  // 25 mm high, 30 degrees down
  EXPECT_NEAR(sim::degrees(e.rays[0].rise_rad), -30, 1e-9);
  auto r = cruising(world_of("twinpuck = 1\n[[ramp]]\nposition = [0.11, 0]\nsize = [0.1, 0.2]\nangle = 20\n"
                             "[[robot]]\nmodel = \"one-eyed\"\n"),
                    0, 0);
  EXPECT_EQ(sim::explain_proximity(r->scene(), 0, 0, 0).rays[0].met.name, "ramp 1");
}

TEST(FlatWall, white_answers_the_table_and_black_five_times_as_far) {
  const sim::ProximityConfig old = sim::config_of(*sim::find_profile("webots-old"));
  sim::Surface white, black;
  black.ir_reflectance = 0;
  const sim::FlatWall w(old, white), b(old, black);
  EXPECT_EQ(w.factor(), 1);
  EXPECT_NEAR(b.factor(), 0.2, 1e-12);
  for (const auto& row : old.table) EXPECT_NEAR(w.at(row.distance_m).value, row.value, 1e-9);
  // lab S4: 7 cm become 1.4 cm
  EXPECT_NEAR(b.at(0.010).value, 90, 1e-9);
  EXPECT_GT(b.at(0.0139).value, 34);
  EXPECT_NEAR(b.at(0.014).value, 34, 1e-9);
  EXPECT_NEAR(b.at(0.005).value, 491, 1e-9);  // 25 mm: between 676 and 306
}

TEST(FlatWall, agrees_with_a_wall_in_a_world) {
  for (const char* settings :
       {"rays = 4\naperture_rad = 0.3", "rays = 7\naperture = 40\ngaussian_width = 0.5",
        "layout = \"fan\"\nrays = 5\naperture = 50"}) {
    for (const double gap : {0.004, 0.018, 0.031}) {
      auto s = cruising(world_of(wall_at(gap, settings, "colour = [0.7, 0, 0]")), 0, 0);
      sim::Surface red;
      red.ir_reflectance = 0.7;
      const sim::FlatWall wall(sim::proximity_config(s->scene(), 0, 0), red);
      EXPECT_NEAR(wall.at(gap).value, sim::sense_proximity(s->scene(), 0, 0, 0).value, 0.01)
          << settings << gap;
    }
  }
}

TEST(Notices, name_rays_that_do_not_count_and_whom_they_concern) {
  const auto notices = sim::proximity_notices(world_of(R"(twinpuck = 1
[proximity]
rays = 4
aperture = 20
gaussian_width = 0
[[robot]]
name = "a"
[[robot]]
name = "b"
position = [1, 0]
[[robot.sensor]]
index = 3
gaussian_width = 1
[[robot.sensor]]
index = 4
aperture = 0
[[robot.sensor]]
index = 5
rays = 2
)"));
  ASSERT_EQ(notices.size(), 4u);
  EXPECT_EQ(
      notices[0],
      "note: robot a, sensors 0 to 7: gaussian_width is 0: only the ray on the axis counts, the weight of "
      "the other 3 is 0");
  EXPECT_TRUE(wording::reads(notices[1],
                             "note: robot b, sensors 0 to 2, 6, 7: gaussian_width is 0: only the ray on the "
                             "axis counts, the weight of the other 3 is 0"));
  EXPECT_TRUE(
      wording::reads(notices[2], "note: robot b, sensor 4: aperture is 0: one ray on the axis instead of 4"));
  EXPECT_TRUE(wording::reads(notices[3],
                             "note: robot b, sensor 5: gaussian_width is 0: none of the 2 rays lies on the "
                             "axis, the 2 nearest to it count alike"));
}

TEST(Notices, there_are_none_about_usual_sensors) {
  for (const auto& p : sim::proximity_profiles()) {
    EXPECT_TRUE(sim::proximity_notices(world_of(std::string("twinpuck = 1\n[proximity]\nprofile = \"") +
                                                p.name + "\"\n[[robot]]\n"))
                    .empty())
        << p.name;
  }
}

const char* const kLampWorld = R"(twinpuck = 1
[world]
ambient = 0.25
[[lamp]]
name = "bulb"
position = [0.537, 0.5, 0.025]
intensity = 6
attenuation = [1, 2, 4]
colour = [1, 0.5, 0]
[[lamp]]
position = [-1, 0, 0.025]
[[lamp]]
name = "off"
position = [1, 0, 0.025]
on = false
[[robot]]
model = "one-eyed"
)";

TEST(ExplainLight, each_lamp_gives_its_share) {
  auto s = cruising(world_of(kLampWorld), 0, 0);
  const auto e = sim::explain_light(s->scene(), 0, 0, 0);
  ASSERT_EQ(e.lamps.size(), 3u);
  // 0.5 m ahead and 0.5 m to the left: d = 0.7071, cosine 0.7071; 1 + 1.41421 + 2 = 4.41421; colour mean 0.5
  EXPECT_NEAR(e.lamps[0].share.distance_m, 0.70711, 1e-5);
  EXPECT_NEAR(e.lamps[0].share.facing, 0.70711, 1e-5);
  EXPECT_NEAR(e.lamps[0].share.divisor, 4.41421, 1e-5);
  EXPECT_NEAR(e.lamps[0].share.w_m2, 6 * 0.5 * 0.70711 / 4.41421, 1e-5);
  EXPECT_EQ(e.lamps[1].name, "lamp 2");
  EXPECT_EQ(e.lamps[1].share.w_m2, 0);  // behind
  EXPECT_LT(e.lamps[1].share.facing, 0);
  EXPECT_FALSE(e.lamps[2].share.on);
  EXPECT_NEAR(e.total_w_m2, 0.25 + 0.480575, 1e-5);
  EXPECT_NEAR(e.total_w_m2, sim::sense_irradiance_w_m2(s->scene(), 0, 0, 0), 0);
}

TEST(ExplainLight, boxes_and_robots_throw_shadows_and_are_named) {
  const std::string between = "[[box]]\nname = \"crate\"\nposition = [0.3, 0.25]\n";
  auto boxed = cruising(world_of(kLampWorld + between), 0, 0);
  auto e = sim::explain_light(boxed->scene(), 0, 0, 0);
  EXPECT_TRUE(e.lamps[0].share.blocked);
  EXPECT_EQ(e.lamps[0].blocked_by, "box 'crate'");
  EXPECT_NEAR(e.total_w_m2, 0.25, 1e-12);
  auto robots = cruising(
      world_of(kLampWorld + std::string("[[robot]]\nname = \"other\"\nposition = [0.3, 0.25]\n")), 0, 0);
  e = sim::explain_light(robots->scene(), 0, 0, 0);
  EXPECT_TRUE(e.lamps[0].share.blocked);
  EXPECT_NE(e.lamps[0].blocked_by.find("other"), std::string::npos) << e.lamps[0].blocked_by;
  // a box lower than the line of sight, 25 mm, throws none
  auto low = cruising(world_of(kLampWorld + between + "size = [0.1, 0.1, 0.02]\n"), 0, 0);
  EXPECT_FALSE(sim::explain_light(low->scene(), 0, 0, 0).lamps[0].share.blocked);
}

}  // namespace
