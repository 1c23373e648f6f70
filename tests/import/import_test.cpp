// SPDX-License-Identifier: MIT
// Small worlds of Webots, one per feature, and what must stand in ours. Expectations are worked out by hand
// from the .wbt text.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"
#include "import/import.h"
#include "sim_core/load/world_loader.h"
#include "twinpuck_paths.h"

namespace {

constexpr double kDeg = sim::kPi / 180;

struct Result {
  wbt::Imported made;
  sim::WorldDesc world;

  /// Whether one line of the report says all of these.
  bool reports(int line, std::initializer_list<const char*> words) const {
    for (const wbt::Remark& r : made.report) {
      bool all = line == 0 || r.line == line;
      for (const char* w : words) all = all && r.text.find(w) != std::string::npos;
      if (all) return true;
    }
    return false;
  }
  std::string all_reports() const {
    std::string out;
    for (const wbt::Remark& r : made.report) out += std::to_string(r.line) + ": " + r.text + "\n";
    return out;
  }
  bool has(const std::string& text) const { return made.toml.find(text) != std::string::npos; }
};

Result import(const std::string& text, const std::string& folder = "") {
  wbt::Options options;
  options.file = "test.wbt";
  options.folder = folder;
  options.out_folder = folder;
  options.model = board::epuck_model();
  Result out;
  out.made = wbt::import_world(text, options);
  EXPECT_TRUE(out.made.errors.empty()) << out.made.errors.front().text;
  const auto loaded =
      sim::parse_world(out.made.toml, folder + "/test.toml", {board::epuck_model()}, board::part_kinds());
  EXPECT_TRUE(loaded.world.has_value()) << loaded.report("test.toml") << "\n" << out.made.toml;
  if (loaded.world) out.world = *loaded.world;
  return out;
}

const std::string kOld = "#VRML_SIM V6.0 utf8\n";
const std::string kNew = "#VRML_SIM R2023b utf8\n";

TEST(Import, both_axis_conventions_give_the_same_world) {
  // a box 0.3 m to the right and 0.2 m further away, turned by 30 degrees; a robot that looks to the left
  const Result a = import(kOld + R"(
Solid { children [ DEF S Shape { geometry Plane { size 2 1 } } ] boundingObject USE S }
Solid {
  translation 0.3 0.05 -0.2
  rotation 0 1 0 0.5235988
  children [ DEF B Shape { geometry Box { size 0.2 0.1 0.04 } } ]
  boundingObject USE B
}
EPuck { translation -0.5 0 0.1 rotation 0 1 0 1.5707963 controller "blink" }
)");
  const Result b = import(kNew + R"(
Solid { children [ DEF S Shape { geometry Plane { size 2 1 } } ] boundingObject USE S }
Solid {
  translation 0.3 0.2 0.05
  rotation 0 0 1 0.5235988
  children [ DEF B Shape { geometry Box { size 0.2 0.04 0.1 } } ]
  boundingObject USE B
}
E-puck { translation -0.5 -0.1 0 rotation 0 0 1 3.1415927 controller "blink" name "e-puck" }
)");
  for (const Result* r : {&a, &b}) {
    ASSERT_TRUE(r->world.arena.has_value());
    EXPECT_NEAR(r->world.arena->size_m.x, 2, 1e-6);
    EXPECT_NEAR(r->world.arena->size_m.y, 1, 1e-6);
    EXPECT_EQ(r->world.arena->wall_height_m, 0);
    ASSERT_EQ(r->world.objects.size(), 1u) << r->made.toml;
    const sim::ObjectDesc& o = r->world.objects[0];
    EXPECT_NEAR(o.pose.x_m, 0.3, 1e-6);
    EXPECT_NEAR(o.pose.y_m, 0.2, 1e-6);
    EXPECT_NEAR(o.pose.heading_rad, 30 * kDeg, 1e-4);
    EXPECT_NEAR(o.size_m.x, 0.2, 1e-6);
    EXPECT_NEAR(o.size_m.y, 0.04, 1e-6);
    EXPECT_NEAR(o.size_m.z, 0.1, 1e-6);
    EXPECT_EQ(o.z_m, 0);
    EXPECT_FALSE(o.movable);
    ASSERT_EQ(r->world.robots.size(), 1u);
    EXPECT_NEAR(r->world.robots[0].pose.x_m, -0.5, 1e-6);
    EXPECT_NEAR(r->world.robots[0].pose.y_m, -0.1, 1e-6);
    EXPECT_NEAR(std::abs(r->world.robots[0].pose.heading_rad), sim::kPi, 1e-4);
    EXPECT_EQ(r->world.robots[0].firmware, "blink");
  }
  EXPECT_TRUE(a.has("axes = \"nue\""));
  EXPECT_FALSE(b.has("axes = "));
}

TEST(Import, the_years_between_are_told_by_their_field_or_by_their_turns) {
  const char* const rest =
      "\nSolid { translation 0.3 0.05 0.4 rotation 0 1 0 0.1 boundingObject Box { size 0.1 0.1 0.1 } }\n";
  const Result said =
      import("#VRML_SIM R2021a utf8\nWorldInfo { coordinateSystem \"NUE\" }" + std::string(rest));
  const Result guessed = import("#VRML_SIM R2021a utf8\nWorldInfo { }" + std::string(rest));
  for (const Result* r : {&said, &guessed}) {
    ASSERT_EQ(r->world.objects.size(), 1u);
    EXPECT_NEAR(r->world.objects[0].pose.y_m, -0.4, 1e-6);
  }
  const Result up = import(
      "#VRML_SIM R2021b utf8\nWorldInfo { }\nSolid { translation 0.3 0.4 0.05 rotation 0 0 1 0.1 "
      "boundingObject Box { "
      "size 0.1 0.1 0.1 } }\n");
  ASSERT_EQ(up.world.objects.size(), 1u);
  EXPECT_NEAR(up.world.objects[0].pose.y_m, 0.4, 1e-6);
}

TEST(Import, cylinders_stand_on_y_before_2022_and_on_z_since) {
  const Result a =
      import(kOld + "Solid { translation 0 0.1 0 boundingObject Cylinder { radius 0.05 height 0.2 } }");
  const Result b =
      import(kNew + "Solid { translation 0 0 0.1 boundingObject Cylinder { radius 0.05 height 0.2 } }");
  for (const Result* r : {&a, &b}) {
    ASSERT_EQ(r->world.objects.size(), 1u);
    EXPECT_EQ(r->world.objects[0].kind, sim::ObjectKind::Cylinder);
    EXPECT_NEAR(r->world.objects[0].radius_m, 0.05, 1e-6);
    EXPECT_NEAR(r->world.objects[0].size_m.z, 0.2, 1e-6);
  }
}

TEST(Import, transforms_within_each_other_add_up_and_scale) {
  // the inner shift of 0.1 along x is doubled and turned by 90 degrees: (1, 0.2)
  const Result r = import(kNew + R"(
Transform {
  translation 1 0 0
  rotation 0 0 1 1.5707963
  scale 2 2 2
  children [ Solid { translation 0.1 0 0.05 boundingObject Box { size 0.1 0.05 0.1 } } ]
}
)");
  ASSERT_EQ(r.world.objects.size(), 1u);
  const sim::ObjectDesc& o = r.world.objects[0];
  EXPECT_NEAR(o.pose.x_m, 1, 1e-6);
  EXPECT_NEAR(o.pose.y_m, 0.2, 1e-6);
  EXPECT_NEAR(o.size_m.x, 0.1, 1e-6);  // written along the axes: 0.05 doubled along x, 0.1 doubled along y
  EXPECT_NEAR(o.size_m.y, 0.2, 1e-6);
  EXPECT_NEAR(o.size_m.z, 0.2, 1e-6);
  EXPECT_NEAR(o.pose.heading_rad, 0, 1e-6);
}

TEST(Import, world_settings_are_carried) {
  const Result r = import(kOld + R"(
WorldInfo { title "a \"lab\"" info [ "by us" ] basicTimeStep 16 gravity 0 -3.7 0 }
Background { skyColor [ 0.4 0.7 1 ] }
EPuck { }
)");
  EXPECT_EQ(r.world.title, "a \"lab\"");
  EXPECT_NEAR(r.world.gravity_m_s2, 3.7, 1e-9);
  EXPECT_NEAR(r.world.webots.time_step_s, 0.016, 1e-9);
  EXPECT_NEAR(r.world.webots.speed_unit_rad_s, 0.00628, 1e-9);
  EXPECT_EQ(r.world.webots.axes, sim::Axes::Nue);
  EXPECT_NEAR(r.world.sky.colour.g, 0.7, 1e-9);
  EXPECT_EQ(r.world.proximity.profile, "webots-old");
  EXPECT_EQ(r.world.proximity.noise_law, sim::NoiseLaw::Uniform);
  EXPECT_TRUE(r.has("# by us"));
  EXPECT_EQ(import(kOld + "WorldInfo { fast2d \"enki\" }\nEPuck { }").world.engine, sim::Engine::Planar);
  EXPECT_EQ(import(kOld + "EPuckNoPhysics { }").world.engine, sim::Engine::Kinematic);
  EXPECT_EQ(import(kNew + "E-puck { kinematic TRUE }").world.engine, sim::Engine::Kinematic);
  EXPECT_EQ(import(kNew + "E-puck { }").world.proximity.profile, "webots-new");
}

TEST(Import, arenas_and_known_blocks) {
  const Result r = import(kNew + R"(
RectangleArena { floorSize 2 1.5 wallHeight 0.05 wallThickness 0.02 }
WoodenBox { translation 0.5 0.2 0.05 size 0.1 0.1 0.1 }
CardboardBox { translation -0.5 0.2 0.1 size 0.2 0.2 0.2 mass 1.5 }
DEF GOAL Obstacle { translation 0 -0.5 0.025 color 0 0 1 }
Wall { translation 0 0.5 0 size 0.1 0.4 0.3 }
E-puck { }
)");
  ASSERT_TRUE(r.world.arena);
  EXPECT_NEAR(r.world.arena->size_m.x, 2, 1e-9);
  EXPECT_NEAR(r.world.arena->size_m.y, 1.5, 1e-9);
  EXPECT_NEAR(r.world.arena->wall_height_m, 0.05, 1e-9);
  EXPECT_NEAR(r.world.arena->wall_thickness_m, 0.02, 1e-9);
  ASSERT_EQ(r.world.objects.size(), 4u) << r.made.toml;
  std::map<sim::ObjectKind, int> kinds;
  for (const auto& o : r.world.objects) {
    ++kinds[o.kind];
    EXPECT_EQ(o.z_m, 0);
    EXPECT_EQ(o.movable, o.mass_kg == 1.5);
    if (o.kind == sim::ObjectKind::Cylinder) {
      EXPECT_NEAR(o.radius_m, 0.04, 1e-9);
      EXPECT_EQ(o.def, "GOAL");
      EXPECT_EQ(o.material.colour.b, 1);
    }
  }
  EXPECT_EQ(kinds[sim::ObjectKind::Box], 3);
  EXPECT_TRUE(r.made.report.empty() || !r.reports(0, {"RectangleArena"})) << r.all_reports();
}

TEST(Import, an_arena_that_is_turned_by_quarters_has_its_sides_exchanged) {
  for (const auto& [turn, x_m] :
       {std::pair{"1.5707963", 1.5}, {"-1.5707963", 1.5}, {"3.1415927", 2}, {"-4.712389", 1.5}}) {
    const Result r = import(kNew + "RectangleArena { rotation 0 0 1 " + turn + " floorSize 2 1.5 }\n");
    ASSERT_TRUE(r.world.arena) << turn;
    EXPECT_NEAR(r.world.arena->size_m.x, x_m, 1e-9) << turn;
    EXPECT_NEAR(r.world.arena->size_m.y, 3.5 - x_m, 1e-9) << turn;
  }
}

// the floor is laid of pieces of at least a quarter of the largest; a plate that lies elsewhere is none
TEST(Import, a_floor_is_the_rectangle_around_its_larger_pieces) {
  const auto plate = [](const std::string& x, const std::string& side) {
    return "Solid { translation " + x + " 0 -0.01 boundingObject Box { size " + side + " 0.8 0.02 } }\n";
  };
  const Result r =
      import(kNew + plate("0", "0.8") + plate("0.6", "0.4") + plate("3", "0.1") + "E-puck { }\n");
  ASSERT_TRUE(r.world.arena) << r.made.toml;
  EXPECT_NEAR(r.world.arena->size_m.x, 1.2, 1e-6);
}

TEST(Import, an_arena_that_lies_askew_becomes_walls) {
  const Result r = import(kNew + "RectangleArena { rotation 0 0 1 0.5 floorSize 1 1 }\n");
  EXPECT_FALSE(r.world.arena);
  ASSERT_EQ(r.world.walls.size(), 1u);
  EXPECT_TRUE(r.world.walls[0].closed);
  EXPECT_EQ(r.world.walls[0].points_m.size(), 4u);
  // middle line at 0.505 m from the middle along both of its own axes
  EXPECT_NEAR(sim::length(r.world.walls[0].points_m[0]), 0.505 * std::sqrt(2.0), 1e-3);
}

TEST(Import, physics_makes_things_movable_and_gives_them_mass) {
  const Result r = import(kNew + R"(
RectangleArena { floorSize 3 3 }
Solid { translation 0 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } physics Physics { density -1 mass 0.2 } }
Solid { translation 0.5 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } physics Physics { density 500 } }
DEF BALL Solid { translation 0 1 0.3 contactMaterial "rubber" boundingObject Sphere { radius 0.02 } physics Physics { density -1 mass 0.01 } }
WorldInfo { contactProperties [ ContactProperties { material1 "rubber" coulombFriction [ 0.7 ] bounce 0.8 } ] }
)");
  ASSERT_EQ(r.world.objects.size(), 3u);
  EXPECT_NEAR(r.world.objects[0].mass_kg, 0.2, 1e-9);
  EXPECT_NEAR(r.world.objects[1].mass_kg, 0.5, 1e-9);  // 500 kg/m3 times a litre
  const sim::ObjectDesc& ball = r.world.objects[2];
  EXPECT_EQ(ball.kind, sim::ObjectKind::Ball);
  EXPECT_TRUE(ball.movable);
  EXPECT_NEAR(ball.z_m, 0.28, 1e-6);
  EXPECT_EQ(ball.def, "BALL");
  EXPECT_NEAR(ball.floor_friction, 0.7, 1e-9);
  EXPECT_NEAR(ball.material.restitution, 0.8, 1e-9);
}

TEST(Import, what_has_no_bounding_object_is_left_out_by_name) {
  const Result r = import(kNew +
                          "RectangleArena { }\nSolid {\n translation 0 0 0.1\n children [ Shape { geometry "
                          "Box { size 0.1 0.1 0.1 } } ]\n}\n");
  EXPECT_EQ(r.world.objects.size(), 0u);
  EXPECT_TRUE(r.reports(3, {"Solid", "not carried", "no boundingObject"})) << r.all_reports();
}

TEST(Import, nothing_goes_without_a_line) {
  struct Case {
    const char* node;
    std::size_t objects;
    std::initializer_list<const char*> words;  // none: carried whole
  };
  const std::string box =
      " children [ DEF B Shape { geometry Box { size 0.1 0.1 0.1 } } ] boundingObject USE B }";
  const std::string charger = "Charger { translation 0 0 0.05" + box,
                    solid = "Solid { translation 0 0 0.05" + box,
                    track = "Track { translation 0 0 0.05" + box;
  for (const Case& c :
       {Case{charger.c_str(), 1, {"Charger", "that it charges robots", "it is a body that stands there"}},
        Case{"Charger { radius 0.1 }", 0, {"Charger", "that it charges robots"}},
        Case{track.c_str(), 1, {"Track", "that its belt moves"}},
        Case{"Solid { }", 0, {"Solid", "it has no shape"}},
        Case{"Solid { children [ Solid { } ] }", 0, {"Solid", "it has no shape"}},
        Case{"Shape { }", 0, {"Shape", "it has no geometry"}}, Case{solid.c_str(), 1, {}},
        Case{"Solid { children [ PointLight { location 0 0 1 } ] }", 0, {}}}) {
    const Result r = import(kNew + "RectangleArena { }\n" + c.node + "\n");
    EXPECT_EQ(r.world.objects.size(), c.objects) << c.node;
    EXPECT_EQ(r.made.objects, static_cast<int>(c.objects)) << c.node;
    EXPECT_EQ(r.made.report.size(), c.words.size() > 0 ? 1u : 0u) << c.node << "\n" << r.all_reports();
    if (c.words.size() > 0) EXPECT_TRUE(r.reports(3, c.words)) << c.node << "\n" << r.all_reports();
  }
}

TEST(Import, a_node_without_end_takes_no_other_with_it) {
  const auto world = [](int levels) {
    std::string text = kNew + "RectangleArena { }\nDEF G0 Group { children [ Pose { } ] }\n";
    for (int i = 1; i <= levels; ++i)
      text += fmt::format("DEF G{0} Group {{ children [ USE G{1} USE G{1} ] }}\n", i, i - 1);
    return text + "E-puck { controller \"c\" }\n";
  };
  const Result one = import(world(17));
  EXPECT_EQ(one.world.robots.size(), 1u) << one.all_reports();
  EXPECT_TRUE(one.reports(3, {"more than 200000 nodes"})) << one.all_reports();
  // ... but for a world that is made of nothing else: then all that is left out has its line
  const Result many = import(world(21));
  EXPECT_EQ(many.world.robots.size(), 0u);
  EXPECT_TRUE(many.reports(25, {"E-puck", "too many nodes stand before it"})) << many.all_reports();
}

TEST(Import, texts_are_utf_8_as_the_world_file_is) {
  const Result r = import(
      "#VRML_SIM R2023b utf8\nWorldInfo { title \"\u00fc \\\"\u03c0\\\"\" }\nE-puck { name \"p\u00fcc\" "
      "customData \"gr\u00f6\u00dfe\" "
      "controller \"c\" }\nE-puck { name \"b\xff\" controller \"c\" }\n");
  EXPECT_EQ(r.world.title, "\u00fc \"\u03c0\"");
  ASSERT_EQ(r.world.robots.size(), 2u);
  EXPECT_EQ(r.world.robots[0].name, "p\u00fcc");
  EXPECT_EQ(r.world.robots[0].custom_data, "gr\u00f6\u00dfe");
  EXPECT_EQ(r.world.robots[1].name, "b?");
}

// Webots' lidar has 512 columns and 4 rows unless its world says otherwise
TEST(Import, distances_that_are_too_many_are_thinned_and_reported) {
  const Result r = import(kNew +
                          "E-puck { turretSlot [ Lidar { name \"l\" }\n"
                          "RangeFinder { name \"r\" width 640 height 480 } ] }\n");
  const auto& devices = r.world.robots.at(0).devices;
  ASSERT_EQ(devices.size(), 2u) << r.all_reports();
  EXPECT_EQ(devices[0].width, 512);
  EXPECT_EQ(devices[0].height, 4);
  EXPECT_EQ(devices[1].width, 640 / 6);
  EXPECT_EQ(devices[1].height, 480 / 6);
  EXPECT_TRUE(r.reports(3, {"640 columns and 480 rows", "12000", "106 columns and 80 rows"}))
      << r.all_reports();
}

// `check` counts objects alike
TEST(Import, walls_and_ramps_are_no_objects) {
  const Result r = import(kNew +
                          "RectangleArena { rotation 0 0 1 0.3 }\n"
                          "Solid { translation 0 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } }\n");
  EXPECT_GT(r.world.walls.size(), 0u);
  EXPECT_EQ(r.made.objects, static_cast<int>(r.world.objects.size()));
}

TEST(Import, a_tilted_board_becomes_a_ramp_cut_off_at_the_floor) {
  // 1 m long, 10 degrees, its middle at the height where half of it is under the floor
  const Result r = import(kNew + R"(
RectangleArena { floorSize 4 4 }
Solid { translation 0 0 -0.005 rotation 0 1 0 -0.1745329 boundingObject Box { size 1 0.4 0.01 } }
)");
  ASSERT_EQ(r.world.ramps.size(), 1u) << r.all_reports();
  const sim::RampDesc& ramp = r.world.ramps[0];
  EXPECT_NEAR(ramp.low_m, 0, 1e-9);
  EXPECT_NEAR(ramp.high_m, 0.5 * std::sin(10 * kDeg), 2e-4);
  EXPECT_NEAR(ramp.size_m.x, 0.5 * std::cos(10 * kDeg), 2e-3);
  EXPECT_NEAR(ramp.size_m.y, 0.4, 1e-6);
  EXPECT_NEAR(ramp.pose.heading_rad, 0, 1e-6);
  EXPECT_NEAR(ramp.pose.x_m, 0.25 * std::cos(10 * kDeg), 2e-3);
}

TEST(Import, meshes_become_prisms_and_hollow_ones_their_walls) {
  const Result r = import(kNew + R"(
RectangleArena { floorSize 4 4 }
Solid {
  boundingObject IndexedFaceSet {
    coord Coordinate { point [ 0 0 0, 0.2 0 0, 0 0.2 0, 0 0 0.1, 0.2 0 0.1, 0 0.2 0.1 ] }
    coordIndex [ 0, 2, 1, -1, 3, 4, 5, -1, 0, 1, 4, 3, -1, 1, 2, 5, 4, -1, 2, 0, 3, 5, -1 ]
  }
}
Solid {
  boundingObject IndexedFaceSet {
    coord Coordinate { point [ 1 1 0, 2 1 0, 2 1 0.2, 1 1 0.2, 1 2 0, 1 2 0.2 ] }
    coordIndex [ 0, 1, 2, 3, -1, 0, 3, 5, 4, -1 ]
  }
}
)");
  ASSERT_EQ(r.world.objects.size(), 3u) << r.made.toml;
  int walls = 0;  // the loader lists kind by kind
  for (const sim::ObjectDesc& o : r.world.objects) {
    if (o.kind == sim::ObjectKind::Polygon) {
      EXPECT_EQ(o.corners_m.size(), 3u);
      EXPECT_NEAR(o.size_m.z, 0.1, 1e-6);
      continue;
    }
    ++walls;
    EXPECT_EQ(o.kind, sim::ObjectKind::Box);
    EXPECT_NEAR(std::max(o.size_m.x, o.size_m.y), 1, 1e-6);
    EXPECT_NEAR(std::min(o.size_m.x, o.size_m.y), 0.002, 1e-6);
    EXPECT_NEAR(o.size_m.z, 0.2, 1e-6);
  }
  EXPECT_EQ(walls, 2);
}

// a section 0.2 m wide and 0.1 m deep along spines of all kinds, as ISO/IEC 14772-1 lays its planes
TEST(Import, extrusions_follow_their_spines) {
  struct Case {
    const char* fields;
    double x_m, y_m, z_m, above_m;  // of the upright prism around it
  };
  for (const Case& c : {
           Case{"spine [ 0 0 0, 0 0 0.3 ]", 0.2, 0.1, 0.3, 0},
           Case{"spine [ 0 0 0.2, 1 0 0.2 ]", 1, 0.2, 0.1, 0.15},
           // round a corner in plan: its depth stays upright, its width goes round
           Case{"spine [ 0 0 0.1, 1 0 0.1, 1 1 0.1 ]", 1.1, 1.1, 0.1, 0.05},
           Case{"spine [ 0 0 0, 0 0 0.3 ] scale [ 1 1, 2 0.5 ]", 0.4, 0.1, 0.3, 0},
           Case{"spine [ 0 0 0, 0 0 0.3 ] scale [ 2 0.5 ]", 0.4, 0.05, 0.3, 0},
           Case{"spine [ 0 0 0, 0 0 0.3 ] orientation [ 0 1 0 1.5707963 ]", 0.1, 0.2, 0.3, 0},
           // a square ring: closed spines bend at their ends, too
           Case{"spine [ 0 0 0.1, 1 0 0.1, 1 1 0.1, 0 1 0.1, 0 0 0.1 ]", 1 + 0.2 * 0.70711, 1 + 0.2 * 0.70711,
                0.1, 0.05},
       }) {
    const Result r =
        import(kNew +
               "RectangleArena { floorSize 8 8 }\nSolid { boundingObject Extrusion { crossSection [ 0.1 "
               "0.05, 0.1 -0.05, -0.1 -0.05, -0.1 0.05, 0.1 0.05 ] " +
               c.fields + " } }\n");
    ASSERT_EQ(r.world.objects.size(), 1u) << c.fields << r.all_reports();
    const sim::ObjectDesc& o = r.world.objects[0];
    std::vector<sim::Vec2> corners = o.corners_m;
    if (o.kind == sim::ObjectKind::Box)
      for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5}) corners.push_back({x * o.size_m.x, y * o.size_m.y});
    ASSERT_FALSE(corners.empty()) << c.fields;
    const sim::SinCos turn = sim::sin_cos(o.pose.heading_rad);
    double least_x = 9, most_x = -9, least_y = 9, most_y = -9;
    for (const sim::Vec2 v : corners) {
      const double x = turn.c * v.x - turn.s * v.y, y = turn.s * v.x + turn.c * v.y;
      least_x = std::min(least_x, x), most_x = std::max(most_x, x);
      least_y = std::min(least_y, y), most_y = std::max(most_y, y);
    }
    EXPECT_NEAR(most_x - least_x, c.x_m, 1e-4) << c.fields;
    EXPECT_NEAR(most_y - least_y, c.y_m, 1e-4) << c.fields;
    EXPECT_NEAR(o.size_m.z, c.z_m, 1e-4) << c.fields;
    EXPECT_NEAR(o.z_m, c.above_m, 1e-4) << c.fields;
  }
}

TEST(Import, use_repeats_what_def_named) {
  const Result r = import(kOld + R"(
Solid { translation 0.5 0.05 0 children [ DEF W Shape { appearance Appearance { material Material { diffuseColor 1 0.5 0.25 } } geometry Box { size 0.02 0.1 1 } } ] boundingObject USE W }
Solid { translation -0.5 0.05 0 children [ USE W ] boundingObject USE W }
Solid { children [ USE NOBODY ] }
)");
  ASSERT_EQ(r.world.objects.size(), 2u);
  for (const auto& o : r.world.objects) {
    EXPECT_NEAR(o.size_m.y, 1, 1e-6);
    EXPECT_NEAR(o.material.colour.g, 0.5, 1e-6);
  }
  EXPECT_TRUE(r.reports(5, {"USE NOBODY", "no DEF"})) << r.all_reports();
}

TEST(Import, a_colour_is_written_unless_it_is_the_usual_one) {
  for (const sim::Colour& c :
       {sim::Colour{0.5, 1, 1}, sim::Colour{1, 0.5, 1}, sim::Colour{1, 1, 0.5}, sim::Colour{1, 1, 1}}) {
    const std::string diffuse = fmt::format("{} {} {}", c.r, c.g, c.b);
    const Result r =
        import(kOld + ("Solid { children [ DEF S Shape { appearance Appearance { material Material { "
                       "diffuseColor " +
                       diffuse +
                       " } } geometry Box { size 0.1 0.1 0.1 } } ] "
                       "boundingObject USE S }"));
    ASSERT_EQ(r.world.objects.size(), 1u);
    const sim::Colour& made = r.world.objects[0].material.colour;
    EXPECT_TRUE(made.r == c.r && made.g == c.g && made.b == c.b) << diffuse;
    EXPECT_EQ(r.has("colour = "), diffuse != "1 1 1") << r.made.toml;
  }
}

TEST(Import, lights_become_lamps_and_ambient_light) {
  const Result r = import(kOld + R"(
PointLight { location 0.2 0.6 -0.5 intensity 0.6 ambientIntensity 0.5 attenuation 1 0 0 }
DEF SUN DirectionalLight { direction 0 -1 0 intensity 0.8 }
PointLight { location 0 1 0 on FALSE }
EPuck { }
)");
  ASSERT_EQ(r.world.lamps.size(), 3u);
  EXPECT_NEAR(r.world.lamps[0].position_m.y, 0.5, 1e-6);
  EXPECT_NEAR(r.world.lamps[0].position_m.z, 0.6, 1e-6);
  EXPECT_NEAR(r.world.lamps[0].intensity_w_m2, 0.6, 1e-9);
  EXPECT_NEAR(r.world.ambient_w_m2, 0.5, 1e-9);
  EXPECT_GT(r.world.lamps[1].position_m.z, 100);
  EXPECT_NEAR(r.world.lamps[1].position_m.x, 0, 1e-6);
  EXPECT_FALSE(r.world.lamps[2].on);
}

// every kind of node and field that becomes something in our world
const char* const kEverything = R"(
WorldInfo { basicTimeStep 32 gravity 9.81 randomSeed 7
  contactProperties [ ContactProperties { coulombFriction 0.7 bounce 0.3 } ] }
Background { skyColor [ 0.1 0.2 0.3 ] }
PointLight { location 0.1 0.2 0.9 attenuation 0.5 0.25 0.125 intensity 2 ambientIntensity 0.5 color 1 0.5 0.25 }
DirectionalLight { direction 0.1 0.2 -1 intensity 0.5 }
RectangleArena { translation 0.1 0.2 0 rotation 0 0 1 0 floorSize 3 2 wallHeight 0.2 wallThickness 0.02 }
RectangleArena { translation 5 5 0 rotation 0 0 1 0.5 floorSize 3 2 wallHeight 0.2 wallThickness 0.02 }
CircleArena { translation -5 5 0 radius 0.4 wallHeight 0.2 wallThickness 0.02 }
Wall { translation 0.1 0.9 0 rotation 0 0 1 0.3 size 0.4 0.02 0.1 }
WoodenBox { translation 0.6 0.6 0.05 size 0.1 0.1 0.1 mass 0.2 }
SoccerBall { translation 0.9 0.6 0.02 radius 0.02 mass 0.05 }
OilBarrel { translation 0.9 -0.6 0.05 radius 0.05 height 0.1 }
Solid { translation -0.6 0.3 0 rotation 0 0 1 0.2 scale 1 1 1
  boundingObject Group { children [
    IndexedFaceSet { coord Coordinate { point [ 0 0 0 0.2 0 0 0.1 0.1 0 0 0 0.1 0.2 0 0.1 0.1 0.1 0.1 ] }
      coordIndex [ 0 1 2 -1 3 4 5 -1 0 1 4 3 -1 1 2 5 4 -1 2 0 3 5 -1 ] } ] }
  physics Physics { mass 0.1 density -1 } }
Solid { translation -0.6 -0.3 0.05 boundingObject Transform { translation 0 0 0.1 rotation 1 0 0 0.2
  children [ Box { size 0.1 0.3 0.02 } ] } }
Solid { translation 0 0.6 0.05 boundingObject Group { children [
  Transform { translation 0.1 0 0 children [ Box { size 0.1 0.1 0.1 } ] } Sphere { radius 0.03 } ] }
  physics Physics { density 500 } }
E-puck { translation 0.3 0 0 rotation 0 0 1 1 battery [ 7000 7200 ] emitter_channel 3
  distance_sensor_numberOfRays 5
  turretSlot [ GPS { name "gps" } Emitter { name "radio" channel 3 range 1 baudRate 9600 } ] }
DifferentialWheels { translation -0.3 0 0 axleLength 0.052 wheelRadius 0.0205 speedUnit 0.1 slipNoise 0.2 name "b"
  children [
    DistanceSensor { name "ps0" lookupTable [ 0.001 4095 0.1 0.07 34 0.7 ] numberOfRays 4 aperture 0.3
      gaussianWidth 2 }
    DistanceSensor { name "ps1" lookupTable [ 0.000001 4095 0.1 0.0000012 34 0.7 ] } ] }
Supervisor { name "judge" controller "c" controllerArgs "one" }
)";

// the class of: a lookup table that ended at 4009 m, written and then refused
TEST(Import, whatever_the_numbers_are_what_is_written_loads) {
  const std::string text = kEverything;
  int numbers = 0;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && std::string_view("0123456789.-").find(text[end]) != std::string_view::npos)
      ++end;
    const bool is_number = end > at && text[at - 1] == ' ' && (text[end] == ' ' || text[end] == '\n');
    if (is_number) {
      ++numbers;
      for (const char* other : {"0", "3e-7", "0.004", "-0.3", "999.99996", "-1000.1", "4009"})
        import(kNew + text.substr(0, at) + other + text.substr(end));
    }
    at = std::max(end, at + 1);
  }
  EXPECT_GT(numbers, 150);
}

TEST(Import, whatever_the_names_are_what_is_written_loads) {
  for (const std::string& name :
       {std::string(","), std::string("a=b"), std::string("left, right"), std::string("a\\\"b"),
        std::string("\xc3\xa9"), std::string("tab\there"), std::string(300, 'x')}) {
    const Result r = import(kNew + "WorldInfo { title \"" + name + "\" }\nSolid { name \"" + name +
                            "\" boundingObject Box { size 0.1 0.1 0.1 } }\nE-puck { name \"" + name +
                            "\" controller \"" + name + "\" translation 1 0 0 turretSlot [ GPS { name \"" +
                            name + "\" } ] }\nE-puck { name \"" + name + "\" }\nSupervisor { name \"" + name +
                            "\" controller \"" + name + "\" controllerArgs \"" + name + "\" }\n");
    EXPECT_EQ(r.world.robots.size(), 2u) << name;
    EXPECT_NE(r.made.report.size(), 0u) << name;
  }
}

TEST(Import, what_our_worlds_have_no_room_for_is_reported) {
  const Result far = import(kNew +
                            "E-puck { name \"a\" children [ ] }\nDifferentialWheels { name \"b\" "
                            "translation 1 0 0 axleLength 0.052 wheelRadius 0.0205 speedUnit 4000 children [ "
                            "DistanceSensor { name \"ps0\" lookupTable [ 0 10 0 4009 5 0 ] } ] }\n");
  EXPECT_TRUE(far.reports(0, {"lookupTable", "beyond 10 m", "the profile's"})) << far.all_reports();
  EXPECT_TRUE(far.reports(0, {"a speedUnit of 4000 rad/s"})) << far.all_reports();
  const Result bright = import(kNew + "PointLight { attenuation 0.0000001 0 0 }\n");
  EXPECT_TRUE(bright.reports(0, {"PointLight", "attenuation makes no sense"})) << bright.all_reports();
  const Result high = import(kNew +
                             "RectangleArena { translation 0 0 -900 }\nSolid { translation 0 0 500 "
                             "boundingObject Box { size 1 1 1 } }\n");
  EXPECT_TRUE(high.reports(0, {"Solid", "larger or further away"})) << high.all_reports();
  const Result names = import(kNew +
                              "E-puck { name \"a,b\" turretSlot [ GPS { name "
                              "\"a name of more than thirty-one characters\" } ] }\n");
  EXPECT_EQ(names.world.robots.at(0).name, "a_b");
  EXPECT_TRUE(names.reports(0, {"the name \"a,b\"", "a_b"})) << names.all_reports();
  EXPECT_TRUE(names.reports(0, {"a device of so long a name"})) << names.all_reports();
}

// worlds/*.toml were checked by hand against Webots' documentation and the numbers in the .wbt beside them
TEST(Import, each_node_and_each_field_becomes_what_the_world_beside_it_says) {
  for (const std::string name : {"defaults", "looks", "shapes"}) {
    const auto text_of = [&](const std::string& ending) {
      std::ifstream in(TWINPUCK_SOURCE_DIR "/tests/import/worlds/" + name + ending, std::ios::binary);
      return std::string{std::istreambuf_iterator<char>(in), {}};
    };
    const std::string made = import(text_of(".wbt")).made.toml, kept = testing::TempDir() + name + ".toml";
    if (made != text_of(".toml")) std::ofstream(kept) << made;
    EXPECT_EQ(made, text_of(".toml")) << "read what has changed, and copy " << kept;
  }
}

// textures/half.png is half red, half blue; blue.jpg is 0.2, 0.4, 0.8; broken.png is no picture
TEST(Import, pictures_beside_the_world_become_their_average_colour) {
  const auto box = [](int i, const std::string& look) {
    return "SolidBox { translation " + std::to_string(i) + " 0 0.05 size 0.1 0.1 0.1 appearance " + look +
           " }\n";
  };
  const Result r = import(
      kNew +
          "RectangleArena { floorSize 2 1 floorTileSize 2 1 floorAppearance PBRAppearance { baseColorMap "
          "ImageTexture { url \"textures/half.png\" } } }\n" +
          box(2,
              "PBRAppearance { baseColor 1 1 0.5 baseColorMap ImageTexture { url \"textures/half.png\" } }") +
          box(3, "Appearance { texture ImageTexture { url \"blue.jpg\" } }") +
          box(4, "PBRAppearance { baseColorMap ImageTexture { url \"textures/broken.png\" } }") +
          box(5, "PBRAppearance { baseColorMap ImageTexture { url \"elsewhere/half.png\" } }"),
      TWINPUCK_SOURCE_DIR "/tests/import/worlds");
  EXPECT_EQ(r.world.floor.image, "textures/half.png");
  ASSERT_EQ(r.world.objects.size(), 4u);
  const double expected[][3] = {{0.5, 0, 0.25}, {0.2, 0.4, 0.8}, {1, 1, 1}, {0.5, 0, 0.5}};
  for (std::size_t i = 0; i < 4; ++i) {
    const sim::Colour& c = r.world.objects[i].material.colour;
    EXPECT_NEAR(c.r, expected[i][0], 0.01) << i;
    EXPECT_NEAR(c.g, expected[i][1], 0.01) << i;
    EXPECT_NEAR(c.b, expected[i][2], 0.01) << i;
  }
  EXPECT_TRUE(r.reports(5, {"textures/broken.png", "cannot be read", "the colour without it"}))
      << r.all_reports();
  const Result repeated = import(
      kNew +
          "RectangleArena { floorSize 2 1 floorTileSize 1 1 floorAppearance PBRAppearance { baseColorMap "
          "ImageTexture { url \"textures/half.png\" } } }\nRectangleArena { }\n",
      TWINPUCK_SOURCE_DIR "/tests/import/worlds");
  EXPECT_EQ(repeated.world.floor.image, "");
  EXPECT_NEAR(repeated.world.floor.colour.r, 0.5, 1e-6);
  EXPECT_TRUE(repeated.reports(2, {"a picture that is repeated", "its average colour"}))
      << repeated.all_reports();
}

}  // namespace
