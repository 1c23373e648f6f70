// SPDX-License-Identifier: MIT
// World files: what is read, and the exact sentence for each kind of mistake.
#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "sim_core/load/schema.h"
#include "sim_core/load/toml_parser.h"
#include "sim_core/world/variation.h"
#include "tests/sim_core/fixture.h"
#include "twinpuck_paths.h"

using namespace sim_test;

namespace {

std::string report_of(const std::string& text) {
  return sim::parse_world(text, "w.toml", {puck(), one_eyed()}).report("w.toml");
}

/// Something of every kind.
constexpr const char* kFullWorld = R"(twinpuck = 1
title = "all of it"
[world]
physics_hz = 256
engine = "kinematic"
gravity = 1.62
seed = 77
ambient = 0.3
[arena]
size = [2, 1]
centre = [1, 0.5]
wall_height = 0.2
wall_thickness = 0.02
material = "brick"
[[material]]
name = "brick"
colour = [0.7, 0.3, 0.2]
ir_reflectance = 0.9
roughness = 0.8
friction = 0.6
restitution = 0.1
[floor]
colour = [0, 0, 0]
friction = 0.5
[[wall]]
points = [[0.5, 0.2], [0.5, 0.6], [0.8, 0.6]]
thickness = 0.03
height = 0.05
[[box]]
name = "crate"
position = [1.5, 0.5]
heading = 90
size = [0.1, 0.2, 0.3]
movable = true
mass = 0.4
friction = 0.2
material = "brick"
colour = [0, 1, 0]
[[cylinder]]
position = [1.2, 0.2]
radius = 0.05
[[ball]]
position = [1.2, 0.8]
radius = 0.03
z = 0.1
[[polygon]]
points = [[0, 0], [0.1, 0], [0, 0.1]]
position = [0.2, 0.8]
[[lamp]]
position = [1, 0.5, 2]
intensity = 4
attenuation = [0, 0, 1]
[[robot]]
name = "ada"
model = "one-eyed"
firmware = "obstacle"
position = [0.2, 0.2]
heading = 180
selector = 7
seed = 5
battery = 3.6
battery_wh = 2.5
wheel_noise = 0.05
slip = 0.01
uart1 = "pty"
uart2 = "tcp:4711"
variation = { left_wheel = 1.01, clock_ppm = -20, boot_delay = 0.5, sensor_gain = [0.9] }
[[robot.key]]
code = 5
time = 1.5
[[robot.key]]
code = 63
time = 0.5
hold = 2
address = 8
)";

TEST(Loader, a_full_world_arrives_in_si_units) {
  const auto w = world_of(kFullWorld);
  EXPECT_EQ(w.robots[0].battery_wh, 2.5);
  ASSERT_EQ(w.robots[0].keys.size(), 2u);
  EXPECT_EQ(w.robots[0].keys[0].code, 5);
  EXPECT_EQ(w.robots[0].keys[0].at_s, 1.5);
  EXPECT_EQ(w.robots[0].keys[0].hold_s, 0.1);
  EXPECT_EQ(w.robots[0].keys[1].code, 63);
  EXPECT_EQ(w.robots[0].keys[1].hold_s, 2);
  EXPECT_EQ(w.robots[0].keys[1].address, 8);
  EXPECT_EQ(w.title, "all of it");
  EXPECT_EQ(w.physics_hz, 256);
  EXPECT_EQ(w.engine, sim::Engine::Kinematic);
  EXPECT_EQ(w.seed, 77u);
  EXPECT_EQ(w.arena->material.colour.r, 0.7);
  EXPECT_EQ(w.arena->material.ir_reflectance, 0.9);
  EXPECT_EQ(w.objects.size(), 4u);
  EXPECT_EQ(w.objects[0].material.colour.g, 1);    // own colour beats the material's
  EXPECT_EQ(w.objects[0].material.friction, 0.6);  // the rest of the material stays
  EXPECT_NEAR(w.objects[0].pose.heading_rad, sim::kPi / 2, 1e-12);
  const sim::RobotDesc& r = w.robots[0];
  EXPECT_NEAR(r.pose.heading_rad, sim::kPi, 1e-12);
  EXPECT_EQ(sim::OwnSettings(w.models[0].keys, r.own).integer("selector"), 7);
  EXPECT_EQ(r.uart2, "tcp:4711");
  EXPECT_EQ(r.variation.left_wheel_ratio, 1.01);
  const auto v = sim::resolve_variation(w, 0);
  EXPECT_EQ(v.seed, 5u);
  EXPECT_EQ(v.boot_delay_s, 0.5);
  EXPECT_EQ(v.sensor_gain, std::vector<double>{0.9});
}

// --- a text that differs in little

/// A tree with all of its values and their places.
void tell_tree(const toml::node& node, std::string& out) {
  const auto& s = node.source();
  out += fmt::format("@{}:{}-{}:{} ", s.begin.line, s.begin.column, s.end.line, s.end.column);
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      out += std::string(key.str()) + "{";
      tell_tree(value, out);
      out += "}";
    }
  } else if (const auto* list = node.as_array()) {
    for (const auto& value : *list) tell_tree(value, out);
  } else {
    std::ostringstream text;
    node.visit([&](const auto& value) {
      if constexpr (toml::is_value<decltype(value)>) text << value.get();
    });
    out += text.str() + "\n";
  }
}

std::string tree_told(sim::TomlTree& tree, const std::string& text) {
  std::optional<toml::parse_error> error;
  std::string out;
  if (const toml::table* root = tree.take(text, error)) {
    for (const auto& [key, value] : *root) {
      out += std::string(key.str()) + "{";
      tell_tree(value, out);
      out += "}";
    }
    EXPECT_FALSE(error);
  } else {
    out = std::string(error->description());
  }
  return out;
}

// what was a text's line is a heading then, which nobody closes
TEST(TomlTree, a_text_that_ended_further_down_is_not_taken_for_one_table) {
  const std::string before = "a = 1\n[[box]]\nname = \"\"\"two\n[x]\nlines = \"\"\"\n";
  for (const char* line : {"\"two\"", "\"\"\"2\"\"\"", "2"}) {
    sim::TomlTree kept, fresh;
    tree_told(kept, before);
    const std::string after = std::string("a = 1\n[[box]]\nname = ") + line + "\n[x]\nlines = \"\"\"\n";
    EXPECT_EQ(tree_told(kept, after), tree_told(fresh, after)) << after;
  }
}

TEST(TomlTree, is_what_a_fresh_one_is_after_edits_of_all_kinds) {
  const std::string begin = R"(twinpuck = 1
[arena]
size = [2, 1]  # m
[[box]]
name = "one"
position = [0.1, 0.2]
[[box]]
name = """two
[[box]]
lines"""
size = [
[1, 2],
[[3]]
]
[[robot]]
name = "puck"
[robot.proximity]
noise = 1
[[robot.part]]
kind = "gauge"
[[box]]
name = "three"
[box.more]
depth = 1
[[lamp]]
intensity = 7
[robot.later]
a = 1
)";
  // whatever may be broken, closed and opened
  const std::vector<std::string> pieces = {"1",           "\"",      "\"\"\"", "[",       "]", "\n",   "#",
                                           "x",           " = ",     "0.5",    "[[box]]", "[", "name", ".",
                                           "\n[[box]]\n", "\ny = 2", "'",      ",",       "}", "{"};
  std::mt19937 random(7);
  sim::TomlTree kept;
  int alike = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = begin;
    // one edit or two, mostly within a line
    for (auto n = random() % 2 + 1; n > 0; --n) {
      const std::size_t at = random() % text.size(), gone = random() % 4;
      text.replace(at, gone, pieces[random() % pieces.size()]);
    }
    tree_told(kept, begin);
    sim::TomlTree fresh;
    const std::string expected = tree_told(fresh, text);
    ASSERT_EQ(tree_told(kept, text), expected) << text;
    alike += expected.front() == 'a' || expected.front() == 'b';
    // and back again
    if (i % 16 == 0) {
      ASSERT_EQ(tree_told(kept, begin), tree_told(fresh, begin)) << text;
    }
  }
  EXPECT_GT(alike, 2000) << "most texts were none at all";
}

TEST(Loader, spread_is_drawn_from_the_robots_seed) {
  const auto w = world_of(
      "twinpuck = 1\n[[robot]]\nvariation = { gain_spread = 0.1 }\n"
      "[[robot]]\nposition = [1, 0]\nvariation = { gain_spread = 0.1 }\n");
  const auto a = sim::resolve_variation(w, 0), b = sim::resolve_variation(w, 1);
  EXPECT_EQ(a.sensor_gain.size(), 8u);
  EXPECT_NE(a.sensor_gain[0], b.sensor_gain[0]);
  EXPECT_NE(a.sensor_gain[0], a.sensor_gain[1]);
  EXPECT_EQ(a.sensor_gain, sim::resolve_variation(w, 0).sensor_gain);
  EXPECT_NEAR(a.sensor_gain[0], 1, 0.5);
}

struct Broken {
  const char* text;      ///< after `twinpuck = 1`, from line 2 on
  const char* expected;  ///< the whole report
};

const char* const kUnknownBoxKeys =
    " (keys: size, name, def, position, z, heading, movable, mass, friction, material, colour, restitution, "
    "model, recognition_colours, node)";

TEST(Loader, every_kind_of_mistake_has_its_sentence) {
  const Broken cases[] = {
      {"[world]\nphysics_hz = 1000",
       "w.toml:3:14: world.physics_hz: got 1000 Hz, expected a divisor of 14745600 such as 96, 128, 256, "
       "512, 1024"},
      {"[world]\nphysics_hz = 8",
       "w.toml:3:14: world.physics_hz: got 8, expected whole number from 32 to 4096 Hz"},
      {"[world]\nphysics_hz = 96.0",
       "w.toml:3:14: world.physics_hz: got 96.0, expected whole number from 32 to 4096 Hz"},
      {"[world]\nengine = \"dynamics\"",
       "w.toml:3:10: world.engine: got \"dynamics\", expected one of dynamic, kinematic, planar; did you "
       "mean "
       "'dynamic'?"},
      {"[world]\nengine = 3", "w.toml:3:10: world.engine: got 3, expected one of dynamic, kinematic, planar"},
      {"[world]\ngravity = -9.81",
       "w.toml:3:11: world.gravity: got -9.81, expected number from 0.01 to 100 m/s2"},
      {"[world]\ngravity = nan",
       "w.toml:3:11: world.gravity: got nan, expected number from 0.01 to 100 m/s2"},
      {"[world]\ngravity = inf",
       "w.toml:3:11: world.gravity: got inf, expected number from 0.01 to 100 m/s2"},
      {"[world]\nseed = -1",
       "w.toml:3:8: world.seed: got -1, expected whole number from 0 to 9000000000000000000"},
      {"[world]\nambient = \"sun\"",
       "w.toml:3:11: world.ambient: got \"sun\", expected number from 0 to 10000 W/m2"},
      {"[world]\nphysicshz = 96",
       "w.toml:3:1: unknown key 'physicshz' in world; did you mean 'physics_hz'? (keys: physics_hz, engine, "
       "gravity, seed, ambient, wheel_noise, wheel_noise_law, slip)"},
      {"[world]\ninterrupts = \"spread\"",
       "w.toml:3:1: the key 'interrupts' is gone: there is one model of interrupts now; delete the line"},
      {"title = \"a\\u001b[31mb\"",
       "w.toml:2:9: title: got \"a\\u001b[31mb\", expected text in quotes without control characters"},
      {"title = 5", "w.toml:2:9: title: got 5, expected text in quotes"},
      {"world = 3", "w.toml:2:9: world: got 3, expected a table, written [world]"},
      {"[[arena]]\nsize = [1, 1]",
       "w.toml:2:1: arena: got several tables in [[ ]], expected a table, written [arena]"},
      {"[arena]", "w.toml:2:1: arena.size: missing, expected two numbers [x, y] from 0.01 to 1000 m"},
      {"[arena]\nsize = 1", "w.toml:3:8: arena.size: got 1, expected two numbers [x, y] from 0.01 to 1000 m"},
      {"[arena]\nsize = [1]",
       "w.toml:3:8: arena.size: got [1], expected two numbers [x, y] from 0.01 to 1000 m"},
      {"[arena]\nsize = [1, 0]",
       "w.toml:3:8: arena.size: got [1, 0], expected two numbers [x, y] from 0.01 to 1000 m"},
      {"[arena]\nsize = [1, \"2\"]",
       "w.toml:3:8: arena.size: got [1, \"2\"], expected two numbers [x, y] from 0.01 to 1000 m"},
      {"[arena]\nsize = [1, 1]\nwall_height = -0.1",
       "w.toml:4:15: arena.wall_height: got -0.1, expected number from 0 to 1000 m"},
      {"[arena]\nsize = [1, 1]\nmaterial = \"wood\"",
       "w.toml:4:12: arena.material: got \"wood\", expected the name of a [[material]] (there are none)"},
      {"[[material]]\nname = \"oak\"\n[arena]\nsize = [1, 1]\nmaterial = \"wood\"",
       "w.toml:6:12: arena.material: got \"wood\", expected the name of a [[material]] (oak)"},
      {"[[material]]\ncolour = [1, 1, 1]", "w.toml:2:1: material.name: missing, expected text in quotes"},
      {"[[material]]\nname = \"a\"\ncolour = [255, 0, 0]",
       "w.toml:4:10: material.colour: got [255, 0, 0], expected three numbers [red, green, blue] from 0 to "
       "1"},
      {"[[material]]\nname = \"a\"\nroughness = 2",
       "w.toml:4:13: material.roughness: got 2, expected number from 0 to 1"},
      {"[[material]]\nname = \"a\"\n[[material]]\nname = \"a\"",
       "w.toml:4:1: material.name: got \"a\" a second time, expected a name of its own"},
      {"[material]\nname = \"a\"",
       "w.toml:2:1: material: got a table, expected [[material]] with double brackets"},
      {"[floor]\nimage = \"no.png\"\n[arena]\nsize = [1, 1]",
       "w.toml:3:9: floor.image: got no.png (cannot be read: No such file or directory), expected a PNG "
       "file"},
      {"[[wall]]\nheight = 0.1",
       "w.toml:2:1: wall.points: missing, expected list of points [[x, y], ...] from -1000 to 1000 m"},
      {"[[wall]]\npoints = [[0, 0]]", "w.toml:3:10: wall.points: got 1 point(s), expected at least 2"},
      {"[[wall]]\npoints = [[0, 0], [0, 0]]",
       "w.toml:3:10: wall.points: got points 0 and 1 at the same place, expected at least 0.0005 m between "
       "them"},
      {"[[wall]]\npoints = [0, 1]",
       "w.toml:3:10: wall.points: got [0, 1], expected list of points [[x, y], ...] from -1000 to 1000 m"},
      {"[[wall]]\npoints = [[0, 0], [1, 0]]\nclosed = true",
       "w.toml:4:10: wall.closed: got true, expected three or more points, the last not on the first"},
      {"[[wall]]\npoints = [[0, 0], [1, 0]]\nheigth = 1",
       "w.toml:4:1: unknown key 'heigth' in wall; did you mean 'height'? (keys: points, closed, thickness, "
       "height, z, material, colour)"},
      {"[[wall]]\npoints = [[0, 0], [1, 0]]\nthickness = 0",
       "w.toml:4:13: wall.thickness: got 0, expected number from 0.0005 to 10 m"},
      {"[[box]]", "w.toml:2:1: box.position: missing, expected two numbers [x, y] from -1000 to 1000 m"},
      {"[[box]]\nposition = [0, 0]\nmoveable = true",
       "w.toml:4:1: unknown key 'moveable' in box; did you mean 'movable'?"},
      {"[[box]]\nposition = [0, 0]\nmovable = 1", "w.toml:4:11: box.movable: got 1, expected true or false"},
      {"[[box]]\nposition = [0, 0]\nmass = 0",
       "w.toml:4:8: box.mass: got 0, expected number from 0.0001 to 1000 kg"},
      {"[[box]]\nposition = [0, 0]\nxyzzy = true", "w.toml:4:1: unknown key 'xyzzy' in box"},
      {"[[cylinder]]\nposition = [0, 0]",
       "w.toml:2:1: cylinder.radius: missing, expected number from 0.0005 to 1000 m"},
      {"[world]\nwheel_noise_law = \"normal\"",
       "w.toml:3:19: world.wheel_noise_law: got \"normal\", expected one of uniform, gaussian"},
      {"[world]\nslip = 1.5", "w.toml:3:8: world.slip: got 1.5, expected number from 0 to 1"},
      {"[world]\nengine = \"flat\"",
       "w.toml:3:10: world.engine: got \"flat\", expected one of dynamic, kinematic, planar"},
      {"[[ball]]\nposition = [0, 0]\nradius = 1\nrolling_friction = -1",
       "w.toml:5:20: ball.rolling_friction: got -1, expected number from 0 to 10"},
      {"[[box]]\nposition = [0, 0]\nrolling_friction = 1",
       "w.toml:4:1: unknown key 'rolling_friction' in box"},
      {"[[ball]]\nposition = [0, 0]\nradius = -1",
       "w.toml:4:10: ball.radius: got -1, expected number from 0.0005 to 1000 m"},
      {"[[polygon]]\npoints = [[0, 0], [1, 0]]",
       "w.toml:3:10: polygon.points: got 2 points, expected 3 to 64"},
      {"[[polygon]]\npoints = [[0, 0], [2, 0], [1, 0.5], [0, 2]]",
       "w.toml:3:10: polygon.points: got a shape that is not convex, expected corners that all turn the same "
       "way; build other shapes of several polygons"},
      {"[[lamp]]\nintensity = 1",
       "w.toml:2:1: lamp.position: missing, expected three numbers [x, y, z] from -1000 to 1000 m"},
      {"[[lamp]]\nposition = [0, 0, 1]\nattenuation = [0, 0, 0]",
       "w.toml:4:15: lamp.attenuation: got [0, 0, 0], expected at least one number above 0"},
      {"[proximity]\nprofile = \"webots\"",
       "w.toml:3:11: proximity.profile: got \"webots\", expected one of inverse-square, webots-old, "
       "webots-new, enki, argos"},
      {"[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"d\"\nkind = \"distance\"\ntable = [[0.1, 1, "
       "0]]",
       "w.toml:7:9: robot.device.table: got 1 row(s), expected at least 2"},
      {"[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"d\"\nkind = \"distance\"\ntable = [[-0.1, "
       "1, 0], [1, 0, 0]]",
       "w.toml:7:9: robot.device.table: got a distance of -0.1 m, expected growing ones from 0 m on"},
      {"[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"d\"\nkind = \"distance\"\ntable = [[0, 1, "
       "0], [0.5, 1, 0], [0.5, 0, 0]]",
       "w.toml:7:9: robot.device.table: got a distance of 0.5 m, expected growing ones from 0 m on"},
      {"[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"d\"\nkind = \"distance\"\ntable = [[0, 1, "
       "0], [0.5, 1, 0], [0.2, 0, 0]]",
       "w.toml:7:9: robot.device.table: got a distance of 0.2 m, expected growing ones from 0 m on"},
      {"[proximity]\nrays = 0", "w.toml:3:8: proximity.rays: got 0, expected whole number from 1 to 100"},
      {"[proximity]\ntable = [[0, 1, 0]]", "w.toml:3:9: proximity.table: got 1 row(s), expected at least 2"},
      {"[proximity]\ntable = [[0.1, 1, 0], [0, 1, 0]]",
       "w.toml:3:9: proximity.table: got distance 0 after 0.1, expected growing distances in m"},
      {"[proximity]\ntable = [[0, 1, 0], [10.01, 0, 0]]",
       "w.toml:3:9: proximity.table: got a distance of 10.01 m, expected at most 10 m"},
      {"[proximity]\ntable = [[0, 1, 0], [0.1, 1, 0], [0.1, 0, 0]]",
       "w.toml:3:9: proximity.table: got distance 0.1 after 0.1, expected growing distances in m"},
      {"[proximity]\ntable = [[0, 1], [1, 0]]",
       "w.toml:3:9: proximity.table: got [[0, 1], [1, 0]], expected list of rows [[distance, value, noise], "
       "...] from 0 to 1000000 m, counts, fraction"},
      {"[proximity]\nnoise_law = \"normal\"",
       "w.toml:3:13: proximity.noise_law: got \"normal\", expected one of uniform, gaussian"},
      {"[[robot]]\nselector = 16", "w.toml:3:12: robot.selector: got 16, expected whole number from 0 to 15"},
      {"[[robot]]\nmodel = \"khepera\"",
       "w.toml:3:9: robot.model: got \"khepera\", expected one of the models: puck, one-eyed"},
      {"[[robot]]\nname = \"a,b\"",
       "w.toml:3:8: robot.name: got \"a,b\", expected a name without comma, quote, = or line break"},
      {"[[robot]]\nname = \"a\"\n[[robot]]\nname = \"a\"\nposition = [1, 0]",
       "w.toml:4:1: robot.name: got \"a\" a second time (first on line 2), expected a name of its own"},
      {"[[robot]]\nuart1 = \"tcp:70000\"",
       "w.toml:3:9: robot.uart1: got \"tcp:70000\", expected none, -, pty, pty:LINK, tcp:PORT with a port of "
       "0 to 65535, or file:PATH"},
      {"[[robot]]\nuart2 = \"usb\"",
       "w.toml:3:9: robot.uart2: got \"usb\", expected none, -, pty, pty:LINK, tcp:PORT with a port of 0 to "
       "65535, or file:PATH"},
      {"[[robot]]\n[[robot.key]]\ncode = 64\ntime = 1",
       "w.toml:4:8: robot.key.code: got 64, expected whole number from 0 to 63"},
      {"[[robot]]\n[[robot.key]]\ncode = 6",
       "w.toml:3:1: robot.key.time: missing, expected number from 0 to 10000000 s"},
      {"[[robot]]\nbattery_wh = 0",
       "w.toml:3:14: robot.battery_wh: got 0, expected number from 0.001 to 1000 Wh"},
      {"[[robot]]\nbattery = 12", "w.toml:3:11: robot.battery: got 12, expected number from 2.5 to 5 V"},
      {"[[robot]]\nx = 1", "w.toml:3:1: unknown key 'x' in robot"},
      {"[[robot]]\n[robot.variation]\nclock = 3", "w.toml:4:1: unknown key 'clock' in robot.variation"},
      {"[[robot]]\nvariation = { left_wheel = 0 }",
       "w.toml:3:28: robot.variation.left_wheel: got 0, expected number from 0.5 to 2"},
      {"[[robot]]\nvariation = { sensor_gain = [1, 1] }",
       "w.toml:3:29: robot.variation.sensor_gain: got 2 numbers, expected 8, one per sensor"},
      {"[[robot]]\n[[robot.sensor]]\nrays = 2",
       "w.toml:3:1: robot.sensor.index: missing, expected whole number from 0 to 63"},
      {"[[robot]]\n[[robot.sensor]]\nindex = 8", "w.toml:3:1: robot.sensor.index: got 8, expected 0 to 7"},
      {"[[robot]]\n[[robot.sensor]]\nindex = 1\n[[robot.sensor]]\nindex = 1",
       "w.toml:5:1: robot.sensor.index: got 1 a second time, expected each sensor once"},
      {"[robot]\nname = \"a\"", "w.toml:2:1: robot: got a table, expected [[robot]] with double brackets"},
      {"[[box]]\nposition = [0, 0]\n[[robot]]",
       "w.toml:4:1: robot 'robot0': got position [0, 0] m inside box 0 (line 2), expected free room"},
      {"[[robot]]\n[[robot]]\nposition = [0.05, 0]",
       "w.toml:2:1: robot 'robot0': got position [0, 0] m inside robot 'robot1' (line 3), expected free "
       "room"},
      {"[arena]\nsize = [1, 1]\n[[robot]]\nposition = [0.49, 0]",
       "w.toml:4:1: robot 'robot0': got position [0.49, 0] m inside east arena wall, expected free room"},
      {"[[box]]\nname = \"a\"\nposition = [0, 0]\n[[box]]\nname = \"b\"\nposition = [0.05, 0]\nmovable = "
       "true",
       "w.toml:5:1: box 'b': got position [0.05, 0] m inside box 'a' (line 2), expected free room"},
      {"[[wal]]\npoints = []", "w.toml:2:3: unknown key 'wal'; did you mean 'wall'?"},
      {"key = ", "w.toml:2:7: not TOML: "},
      {"title = \"\u00e9\" # \u00e9\n\u00e9 = 1",
       "w.toml:3:1: not TOML: got a character beyond ASCII, expected those in quotes or comments only"},
      {"[[#", "w.toml:2:3: not TOML: "},
      {"[world", "w.toml:2:7: not TOML: "},
      {"title = \"a\"\ntitle = \"b\"", "w.toml:3:9: not TOML: "},
  };
  int count = 0;
  for (const Broken& c : cases) {
    const std::string got = report_of(std::string("twinpuck = 1\n") + c.text + "\n");
    // sentences that go on with a list of keys or the parser's own words are compared up to there
    const std::string expected = c.expected;
    const bool open =
        expected.find("unknown key") != std::string::npos || expected.find("not TOML") != std::string::npos;
    EXPECT_EQ(open ? got.substr(0, expected.size()) : got, expected) << c.text;
    EXPECT_EQ(got.find('\n'), std::string::npos) << "one mistake, one line: " << got;
    ++count;
  }
  EXPECT_GE(count, 50);
  EXPECT_NE(report_of("twinpuck = 1\n[[box]]\nposition = [0, 0]\nsiz = 1\n").find(kUnknownBoxKeys),
            std::string::npos);
}

// letters were looked up in a table of white space that has no answer for them
TEST(Loader, letters_beyond_ascii_stand_anywhere_in_strings) {
  const auto loaded =
      sim::parse_world("twinpuck = 1\ntitle = \"\"\"\u013b \\\n  \u00f6\"\"\"\n", "w.toml", {}, {});
  ASSERT_TRUE(loaded.world.has_value()) << loaded.report("w.toml");
  EXPECT_EQ(loaded.world->title, "\u013b \u00f6");
  EXPECT_EQ(report_of("twinpuck = 1\ntitle = 0n'\u013b\n").substr(0, 20), "w.toml:2:10: not TOM");
}

TEST(Loader, the_version_is_asked_for) {
  EXPECT_EQ(report_of("title = \"x\"\n"), "w.toml:1:1: twinpuck: missing, expected whole number: 1");
  EXPECT_EQ(report_of("twinpuck = 2\n"), "w.toml:1:12: twinpuck: got 2, expected whole number: 1");
  EXPECT_EQ(report_of(""), "w.toml:1:1: twinpuck: missing, expected whole number: 1");
}

TEST(Loader, all_mistakes_are_reported_in_order) {
  const std::string report =
      report_of("twinpuck = 1\n[[robot]]\nselector = 99\nbatery = 4\n[world]\ngravity = 0\n");
  EXPECT_EQ(report.substr(0, report.find('(')),
            "w.toml:3:12: robot.selector: got 99, expected whole number from 0 to 15\n"
            "w.toml:4:1: unknown key 'batery' in robot; did you mean 'battery'? ");
  EXPECT_NE(report.find("\nw.toml:6:11: world.gravity: got 0, expected number from 0.01 to 100 m/s2"),
            std::string::npos);
}

// what the parser asserted on, in a program of several files that include it, or followed by recursion
TEST(Loader, half_typed_headers_and_very_deep_keys_are_mistakes_like_others) {
  const std::string deep = [] {
    std::string all = "a";
    for (int i = 0; i < 300000; ++i) all += ".a";
    return all;
  }();
  const std::string lists(300000, '[');
  for (const std::string& text :
       {std::string("["), std::string("[["), std::string("[=]"), std::string("[[=]]"), std::string("[[#"),
        std::string("[a.=]"), std::string("[\"a\"=]"), "[" + deep + "]", "[[" + deep + "]]", deep + " = 1",
        "x = " + lists, "x = {" + deep + " = 1}"})
    EXPECT_NE(report_of(text), "") << text.substr(0, 40);
  EXPECT_EQ(report_of("a.b.c.d.e.f.g.h.i = 1"),
            "w.toml:1:16: got a key of more than 8 parts, expected two at most");
  // dots of numbers are none of a key
  EXPECT_EQ(report_of("[sky]\na = [1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 0.5]").find("parts"),
            std::string::npos);
}

TEST(Loader, odd_files_are_named_and_nothing_waits_for_them) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "odd_files";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "empty.toml").close();
  std::filesystem::create_symlink("loop", folder / "loop");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const auto report = [](const std::string& file) { return sim::load_world(file, {puck()}).report("f"); };
  EXPECT_EQ(report("/dev/zero"), "f: got a device, expected a regular file");
  EXPECT_EQ(report(folder), "f: got a folder, expected a file");
  EXPECT_EQ(report(folder / "loop"), "f: cannot be read: Too many levels of symbolic links");
  EXPECT_EQ(report(folder / "empty.toml"), "f:1:1: twinpuck: missing, expected whole number: 1");
  EXPECT_EQ(report(folder / "pipe"), "f:1:1: twinpuck: missing, expected whole number: 1");
  std::filesystem::remove_all(folder);
}

TEST(Loader, a_missing_file_and_a_folder_are_said) {
  EXPECT_EQ(sim::load_world("/nonexistent.toml", {puck()}).report("x"),
            "x: cannot be read: No such file or directory");
  EXPECT_FALSE(sim::load_world("/tmp", {puck()}).world);
}

TEST(Loader, robots_have_a_limit) {
  std::string text = "twinpuck = 1\n";
  for (int i = 0; i < 25001; ++i) {
    text += "[[robot]]\nposition = [" + std::to_string(i % 100) + ", " + std::to_string(i / 100) + "]\n";
  }
  EXPECT_EQ(report_of(text), "w.toml: robot: got 25001 robots, expected at most 25000");
  text.resize(text.rfind("[[robot]]"));
  EXPECT_EQ(world_of(text).robots.size(), 25000u);
}

TEST(Loader, bodies_above_one_another_do_not_overlap) {
  world_of("twinpuck = 1\n[[box]]\nposition = [0, 0]\nz = 0.06\n[[robot]]\n");
  world_of(
      "twinpuck = 1\n[[box]]\nposition = [0, 0]\n[[ball]]\nposition = [0, 0]\nradius = 0.02\nz = "
      "0.1\nmovable = true\n");
}

TEST(Loader, worlds_of_the_repository_are_good) {
  for (const char* name : {"worlds/maze",
                           "worlds/arena",
                           "worlds/empty",
                           "worlds/corridor",
                           "worlds/wall",
                           "worlds/u_obstacle",
                           "worlds/u_obstacle_black",
                           "worlds/u_obstacle_white",
                           "worlds/myobstacle",
                           "worlds/obstacle",
                           "worlds/multi_obstacle",
                           "worlds/pillars",
                           "worlds/corners",
                           "worlds/lamp",
                           "worlds/push",
                           "worlds/swarm",
                           "bench/worlds/brait_1",
                           "bench/worlds/brait_5",
                           "bench/worlds/brait_10",
                           "bench/worlds/brait_100",
                           "bench/worlds/brait_1000"}) {
    const std::string file = std::string(TWINPUCK_SOURCE_DIR "/") + name + ".toml";
    EXPECT_EQ(sim::load_world(file, {puck()}).report(file), "");
  }
}

TEST(Loader, the_labs_worlds_of_three_engines_differ_in_the_engine_alone) {
  const auto read = [](const std::string& name) {
    std::ifstream in(TWINPUCK_SOURCE_DIR "/worlds/" + name + ".toml");
    std::string text, engine;
    for (std::string line; std::getline(in, line);) {
      if (line.rfind("engine = ", 0) == 0) engine = line.substr(9);
      const bool names_it =
          line.rfind("engine", 0) == 0 || line.rfind("title", 0) == 0 || line.rfind("#", 0) == 0;
      if (!names_it) text += line + "\n";
    }
    return std::make_pair(engine, text);
  };
  for (const char* number : {"", "_5", "_10"}) {
    const auto dynamic = read(std::string("epuck") + number);
    const auto kinematic = read(std::string("epuck_no_physics") + number);
    const auto planar = read(std::string("epuck_2d") + number);
    EXPECT_EQ(dynamic.first, "\"dynamic\"");
    EXPECT_EQ(kinematic.first, "\"kinematic\"");
    EXPECT_EQ(planar.first, "\"planar\"");
    EXPECT_EQ(dynamic.second, kinematic.second);
    EXPECT_EQ(dynamic.second, planar.second);
    for (const char* stem : {"epuck", "epuck_no_physics", "epuck_2d"}) {
      const std::string file = std::string(TWINPUCK_SOURCE_DIR "/worlds/") + stem + number + ".toml";
      EXPECT_EQ(sim::load_world(file, {puck()}).report(file), "");
    }
  }
}

TEST(Loader, defaults_in_the_table_are_the_defaults_of_the_structs) {
  // every default that is written out must load, and must change nothing
  const auto spelled = [](const char* path) {
    std::string out;
    for (const sim::KeySpec& k : sim::section(path).keys) {
      const std::string fallback = k.fallback;
      if (!fallback.empty() && fallback != "required" && fallback != "\"robotN\"" &&
          std::string(k.key) != "movable")
        out += std::string(k.key) + " = " + fallback + "\n";
    }
    return out;
  };
  const std::string with = "twinpuck = 1\ntitle = \"\"\n[world]\n" + spelled("world") + "[floor]\n" +
                           spelled("floor") + "[[robot]]\n" + spelled("robot") + "[robot.variation]\n" +
                           spelled("robot.variation");
  const auto a = world_of(with), b = world_of("twinpuck = 1\n[[robot]]\n");
  EXPECT_EQ(a.physics_hz, b.physics_hz);
  EXPECT_EQ(a.gravity_m_s2, b.gravity_m_s2);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.ambient_w_m2, b.ambient_w_m2);
  EXPECT_EQ(a.floor.colour.b, b.floor.colour.b);
  EXPECT_EQ(a.floor.friction, b.floor.friction);
  EXPECT_EQ(a.robots[0].uart1, b.robots[0].uart1);
  EXPECT_EQ(a.robots[0].wheels.slip, b.robots[0].wheels.slip);
  EXPECT_EQ(a.robots[0].variation.axle_ratio, b.robots[0].variation.axle_ratio);
  // what only movable ones have
  const std::string movable = "twinpuck = 1\n[[box]]\nposition = [0, 0]\nmovable = true\n";
  const auto box = world_of(movable + spelled("box"));
  const auto plain = world_of(movable);
  EXPECT_EQ(box.objects[0].mass_kg, plain.objects[0].mass_kg);
  EXPECT_EQ(box.objects[0].floor_friction, plain.objects[0].floor_friction);
  EXPECT_EQ(box.objects[0].size_m.z, plain.objects[0].size_m.z);
  const auto arena = world_of("twinpuck = 1\n[arena]\nsize = [1, 1]\n" + spelled("arena"));
  EXPECT_EQ(arena.arena->wall_height_m, sim::ArenaDesc().wall_height_m);
  EXPECT_EQ(arena.arena->wall_thickness_m, sim::ArenaDesc().wall_thickness_m);
  const auto wall = world_of("twinpuck = 1\n[[wall]]\npoints = [[0, 0], [1, 0]]\n" + spelled("wall"));
  EXPECT_EQ(wall.walls[0].height_m, sim::WallDesc().height_m);
}

TEST(Loader, a_model_has_keys_that_another_has_not) {
  sim::RobotModel plain = one_eyed();
  plain.keys.clear();
  const auto report = [&](const std::string& robot) {
    return sim::parse_world("twinpuck = 1\n[[robot]]\n" + robot, "w.toml", {puck(), plain}).report("w.toml");
  };
  EXPECT_EQ(report("selector = 3\n"), "");
  EXPECT_EQ(report("model = \"one-eyed\"\n"), "");
  EXPECT_EQ(report("model = \"one-eyed\"\nselector = 3\n"),
            "w.toml:4:1: unknown key 'selector' in robot (keys: variation, proximity, sensor, bluetooth, "
            "part, key, device, name, def, model, firmware, args, supervisor, custom_data, position, "
            "heading, seed, battery, battery_wh, colour, uart1, uart2, wheel_noise, wheel_noise_law, slip, "
            "recognition_colours, node)");
}

}  // namespace
