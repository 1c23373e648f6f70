// SPDX-License-Identifier: MIT
// Nodes and fields of a twin that runs no programs: records in, records out. Worlds are .wbt texts, imported as
// `twinpuck import` does, or world files of ours.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "hal_sim/board/epuck_model.h"
#include "hal_sim/twin/world_file.h"
#include "import/import.h"
#include "programs/world/nodes.h"

namespace {

namespace fs = std::filesystem;

// as WbFieldType numbers them
constexpr int kInt = 2, kColour = 7, kNode = 9;
constexpr int kList = 16;

struct FakeHost final : programs::SupervisorHost {
  std::unique_ptr<twin::Twin> its_twin;
  std::vector<std::string> said;
  std::vector<sim::PictureLabel> labels;

  twin::Twin& twin() override { return *its_twin; }
  void end_run(int status, const std::string& why) override { said.push_back("end " + std::to_string(status) + " " + why); }
  void reset(bool reload) override { said.push_back(reload ? "reload" : "reset"); }
  void restart_program(int robot) override { said.push_back("restart " + std::to_string(robot)); }
  void set_label(int, const sim::PictureLabel& label) override { labels.push_back(label); }
  void picture(const std::string& file) override { said.push_back("picture " + file); }
  void warn(int program, const std::string& text) override {
    said.push_back("warn " + std::to_string(program) + " " + text);
  }
  void note_custom_data(int robot, const std::string& text) override {
    said.push_back("custom " + std::to_string(robot) + " " + text);
  }
  void note_moved(int robot) override { said.push_back("moved " + std::to_string(robot)); }
  bool has(const std::string& part) const {
    for (const std::string& s : said)
      if (s.find(part) != std::string::npos) return true;
    return false;
  }
};

/// One record that came back.
struct Reply {
  int number = 0;
  std::vector<std::int64_t> ints;
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

class NodesTest : public ::testing::Test {
 protected:
  /// A world file of ours.
  void open(const std::string& toml, const std::string& file = "t.toml") {
    const auto loaded = twin::parse_world(toml, file);
    ASSERT_TRUE(loaded.world) << loaded.report(file) << "\n" << toml;
    std::vector<std::string> problems;
    host_.its_twin = twin::Twin::open(*loaded.world, {}, problems);
    ASSERT_TRUE(host_.its_twin) << problems.front();
    nodes_ = std::make_unique<programs::Nodes>(host_);
  }

  /// A world of Webots, which lies beside what the import makes of it.
  void open_wbt(const std::string& wbt) {
    folder_ = fs::path(::testing::TempDir()) / ("twinpuck-nodes-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    std::ofstream(folder_ / "w.wbt") << wbt;
    wbt::Options options;
    options.file = "w.wbt";
    options.folder = options.out_folder = folder_.string();
    options.without_firmware = true;
    options.model = board::epuck_model();
    const wbt::Imported made = wbt::import_world(wbt, options);
    ASSERT_TRUE(made.errors.empty()) << made.errors.front().text;
    open(made.toml, (folder_ / "w.toml").string());
  }

  void TearDown() override {
    nodes_.reset();
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  // --- records

  struct Words {
    std::vector<std::int64_t> ints;
    std::vector<double> list;
    std::string text;
  };

  /// Writes a record as a program does and reads it as the simulator does.
  template <typename Do>
  void speak(int number, const Words& words, Do act) {
    link_packet packet{};
    link_begin(&packet, number);
    std::size_t ints = 0;
    for (const char* m = link_row_of(number)->members; *m; ++m) {
      if (*m == 'i') link_int(&packet, words.ints.at(ints++));
      if (*m == 's') link_bytes(&packet, words.text.data(), words.text.size());
      if (*m == 'F') link_numbers(&packet, words.list.data(), words.list.size());
    }
    link_end(&packet);
    link_reader reader;
    link_record record;
    link_read(&reader, packet.bytes, packet.size);
    ASSERT_EQ(link_next(&reader, &record), 1) << reader.error;
    act(record);
    link_free(&packet);
  }

  Reply ask(int number, const Words& words, int program = 0, int robot = -1) {
    Reply reply;
    speak(number, words, [&](const link_record& question) {
      link_packet out{};
      nodes_->answer(question, program, robot, out);
      link_reader reader;
      link_record r;
      link_read(&reader, out.bytes, out.size);
      EXPECT_EQ(link_next(&reader, &r), 1);
      reply.number = r.number;
      int ints = 0, texts = 0;
      for (const char* m = link_row_of(r.number)->members; *m; ++m) {
        if (*m == 'i') reply.ints.push_back(r.ints[ints++]);
        if (*m == 's') reply.texts.emplace_back(r.texts[texts].bytes, r.texts[texts].size), ++texts;
        if (*m == 'F') reply.numbers.assign(r.lists[0].values, r.lists[0].values + r.lists[0].count);
      }
      EXPECT_EQ(link_next(&reader, &r), 0) << "one record";
      link_free(&out);
    });
    return reply;
  }

  void command(int number, const Words& words, int program = 0) {
    speak(number, words, [&](const link_record& r) { nodes_->carry_out(r, program, -1); });
  }

  // --- what programs do with them

  /// The number of a node; 0: NOTHING.
  int def(const std::string& name) {
    const Reply r = ask(LINK_FIND_NODE, {{2, 0}, {}, name});
    return r.number == LINK_NODE ? static_cast<int>(r.ints[0]) : 0;
  }
  int root() { return static_cast<int>(ask(LINK_FIND_NODE, {{0, 0}, {}, ""}).ints[0]); }
  int field(int node, const std::string& name, int type = 0) {
    const Reply r = ask(LINK_FIND_FIELD, {{node, -1}, {}, name});
    if (r.number != LINK_FIELD) return 0;
    EXPECT_EQ(r.ints[1], type ? type : r.ints[1]) << name;
    return static_cast<int>(r.ints[0]);
  }
  Reply get(int node, const std::string& name, int index = -1) {
    return ask(LINK_GET, {{field(node, name), index}, {}, ""});
  }
  int inner(int node, const std::string& name, int index = 0) {
    const Reply r = get(node, name, index);
    return r.number == LINK_VALUE ? static_cast<int>(r.ints[1]) : 0;
  }
  void set(int node, const std::string& name, const std::vector<double>& numbers, const std::string& text = "") {
    command(LINK_SET, {{field(node, name), 0, 0}, numbers, text});
  }
  std::vector<double> position(int node) { return ask(LINK_ASK_NODE, {{node, 0}, {}, ""}).numbers; }

  void expect(const std::vector<double>& got, const std::vector<double>& wanted, double by = 1e-6) {
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], by) << i;
  }

  const sim::Simulation& simulation() { return host_.its_twin->simulation(); }
  const sim::WorldDesc& world() { return host_.its_twin->world(); }
  void run(double seconds) {
    host_.its_twin->simulation().run_until(host_.its_twin->simulation().now() + sim::from_seconds(seconds));
  }

  FakeHost host_;
  std::unique_ptr<programs::Nodes> nodes_;
  fs::path folder_;
};

const std::string kHead = "#VRML_SIM R2023b utf8\nWorldInfo { title \"t\" basicTimeStep 16 }\n";
const std::string kOldHead = "#VRML_SIM V6.0 utf8\nWorldInfo { }\n";

// --- a world file of ours, without a file of Webots

constexpr const char* kOurs = R"(twinpuck = 1
[arena]
size = [2, 1]
[[robot]]
name = "alice"
def = "A"
position = [0.5, 0.25]
heading = 90
custom_data = "red"
[[box]]
name = "crate"
def = "C"
position = [-0.4, 0.1]
size = [0.1, 0.2, 0.06]
movable = true
mass = 0.2
colour = [1, 0.5, 0]
[[box]]
name = "post"
position = [-0.8, 0.3]
size = [0.1, 0.1, 0.1]
[[lamp]]
name = "sun"
position = [0.1, 0.2, 1.5]
intensity = 2
[[supervisor]]
name = "boss"
program = "x.c"
custom_data = "hello"
)";

TEST_F(NodesTest, robots_objects_and_lamps_of_our_worlds_are_nodes) {
  open(kOurs);
  const Reply robot = ask(LINK_FIND_NODE, {{2, 0}, {}, "A"});
  ASSERT_EQ(robot.number, LINK_NODE);
  EXPECT_EQ(robot.ints[1], root());
  EXPECT_EQ(robot.ints[2], 34) << "WB_NODE_ROBOT";
  EXPECT_EQ(robot.texts, (std::vector<std::string>{"A", "E-puck", "Robot"}));
  const int a = def("A"), c = def("C");
  EXPECT_EQ(def("alice"), a) << "our worlds often have names only";
  expect(get(a, "translation").numbers, {0.5, 0.25, 0}, 1e-3);
  expect(get(a, "rotation").numbers, {0, 0, 1, sim::kPi / 2}, 1e-6);
  EXPECT_EQ(get(a, "name").texts.at(0), "alice");
  EXPECT_EQ(get(a, "customData").texts.at(0), "red");
  // the middle of an object
  expect(get(c, "translation").numbers, {-0.4, 0.1, 0.03}, 1e-3);
  // the appearance and geometry, as programs go there
  const int shape = inner(c, "children");
  expect(get(inner(shape, "geometry"), "size").numbers, {0.1, 0.2, 0.06});
  expect(get(inner(shape, "appearance"), "baseColor").numbers, {1, 0.5, 0});
  expect(get(inner(c, "physics"), "mass").numbers, {0.2});
  expect(get(def("sun"), "location").numbers, {0.1, 0.2, 1.5});
  expect(get(def("sun"), "intensity").numbers, {2});
  EXPECT_EQ(get(def("sun"), "on").numbers.at(0), 1);
  EXPECT_EQ(get(def("boss"), "customData").texts.at(0), "hello");
  // root: WorldInfo, Viewpoint, arena, lamp, two objects, robot, supervisor
  const Reply children = ask(LINK_FIND_FIELD, {{root(), -1}, {}, "children"});
  EXPECT_EQ(children.ints[1], kNode + kList);
  EXPECT_EQ(children.ints[2], 8);
}

TEST_F(NodesTest, what_is_not_there_is_nothing_with_a_reason) {
  open(kOurs);
  const Reply none = ask(LINK_FIND_NODE, {{2, 0}, {}, "Z"});
  EXPECT_EQ(none.number, LINK_NOTHING);
  EXPECT_NE(none.texts.at(0).find("'Z'"), std::string::npos);
  EXPECT_EQ(ask(LINK_FIND_NODE, {{3, 999}, {}, ""}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_FIND_NODE, {{1, 0}, {}, ""}).number, LINK_NOTHING) << "nobody said whose program it is";
  EXPECT_EQ(ask(LINK_FIND_NODE, {{77, 0}, {}, ""}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{def("A"), -1}, {}, "wings"}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{def("A"), 9999}, {}, ""}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{-5, -1}, {}, "name"}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_GET, {{4711, 0}, {}, ""}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_GET, {{field(root(), "children"), 8}, {}, ""}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_ASK_NODE, {{4711, 0}, {}, ""}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_ASK_NODE, {{1, 42}, {}, ""}).number, LINK_NOTHING);
  // commands only warn
  command(LINK_SET, {{4711, 0, 0}, {1}, ""});
  command(LINK_REMOVE, {{4711, 0}, {}, ""});
  command(LINK_DO_NODE, {{4711, 0}, {}, ""});
  command(LINK_DO_WORLD, {{99}, {}, ""});
  set(def("A"), "translation", {1, 2});
  set(def("A"), "translation", {NAN, 0, 0});
  set(def("A"), "translation", {5000, 0, 0});
  set(def("A"), "controller", {}, "other");
  EXPECT_EQ(host_.said.size(), 7u) << "SET and REMOVE say the same";
  EXPECT_TRUE(host_.has("got 2 numbers, expected 3"));
  EXPECT_TRUE(host_.has("beyond 1000 m"));
  EXPECT_TRUE(host_.has("A.controller: stays"));
  expect(get(def("A"), "translation").numbers, {0.5, 0.25, 0}, 1e-3);
}

TEST_F(NodesTest, a_robot_is_put_where_its_translation_says) {
  open(kOurs);
  const int a = def("A");
  const auto before = simulation().digest();
  set(a, "translation", {-0.2, -0.3, 0});
  set(a, "rotation", {0, 0, 1, -1.5});
  EXPECT_NEAR(simulation().pose(0).x_m, -0.2, 1e-9);
  EXPECT_NEAR(simulation().pose(0).y_m, -0.3, 1e-9);
  EXPECT_NEAR(simulation().pose(0).heading_rad, -1.5, 1e-9);
  EXPECT_TRUE(host_.has("moved 0"));
  EXPECT_NE(simulation().digest(), before);
  expect(get(a, "rotation").numbers, {0, 0, 1, -1.5});
  // its matrix: x ahead, row by row
  const std::vector<double> m = ask(LINK_ASK_NODE, {{a, 1}, {}, ""}).numbers;
  expect(m, {std::cos(1.5), std::sin(1.5), 0, -std::sin(1.5), std::cos(1.5), 0, 0, 0, 1});
  const std::vector<double> pose = ask(LINK_ASK_NODE, {{a, 5}, {}, ""}).numbers;
  ASSERT_EQ(pose.size(), 16u);
  EXPECT_NEAR(pose[3], -0.2, 1e-6);
  EXPECT_NEAR(pose[7], -0.3, 1e-6);
  EXPECT_EQ(pose[15], 1);
}

TEST_F(NodesTest, objects_move_fixed_ones_too_and_get_speeds) {
  open(kOurs);
  const int c = def("C"), post = def("post");
  set(c, "translation", {0.1, -0.2, 0.03});
  expect(position(c), {0.1, -0.2, 0.03}, 1e-6);
  set(post, "translation", {0.7, -0.3, 0.05});
  expect(position(post), {0.7, -0.3, 0.05}, 1e-6);
  EXPECT_NEAR(world().objects[1].pose.x_m, 0.7, 1e-9) << "it stands there for rays and wheels";
  EXPECT_NEAR(simulation().state(1).pose.x_m, 0.1, 1e-9) << "the other stays";
  command(LINK_DO_NODE, {{c, 0}, {0.3, 0.1, 0, 0, 0, 2}, ""});
  const std::vector<double> v = ask(LINK_ASK_NODE, {{c, 2}, {}, ""}).numbers;
  ASSERT_EQ(v.size(), 6u);
  EXPECT_NEAR(v[0], 0.3, 1e-9);
  EXPECT_NEAR(v[1], 0.1, 1e-9);
  EXPECT_NEAR(v[5], 2, 1e-9);
  command(LINK_DO_NODE, {{c, 1}, {}, ""});
  expect(ask(LINK_ASK_NODE, {{c, 2}, {}, ""}).numbers, {0, 0, 0, 0, 0, 0});
  command(LINK_DO_NODE, {{post, 0}, {1, 0, 0, 0, 0, 0}, ""});
  EXPECT_TRUE(host_.has("stands fast"));
  // a state is kept and taken back
  command(LINK_DO_NODE, {{c, 6}, {}, "here"});
  set(c, "translation", {0.3, 0.3, 0.03});
  command(LINK_DO_NODE, {{c, 7}, {}, "here"});
  expect(position(c), {0.1, -0.2, 0.03}, 1e-6);
  command(LINK_DO_NODE, {{c, 7}, {}, "__init__"});
  expect(position(c), {-0.4, 0.1, 0.03}, 1e-6);
  command(LINK_DO_NODE, {{c, 7}, {}, "nowhere"});
  EXPECT_TRUE(host_.has("no state 'nowhere'"));
}

TEST_F(NodesTest, sizes_colours_and_lamps_change_what_stands_there) {
  open(kOurs);
  const int c = def("C"), shape = inner(c, "children");
  set(inner(c, "boundingObject"), "size", {0.3, 0.2, 0.06});
  EXPECT_NEAR(world().objects.back().size_m.x, 0.3, 1e-9);
  expect(position(c), {-0.4, 0.1, 0.03}, 1e-3);
  set(inner(shape, "appearance"), "baseColor", {0, 0, 1});
  ASSERT_EQ(world().objects.size(), 2u);
  EXPECT_NEAR(world().objects.back().material.colour.b, 1, 1e-9);
  EXPECT_NEAR(world().objects.back().material.colour.r, 0, 1e-9);
  EXPECT_TRUE(world().objects.back().movable);
  // a colour of the thing itself, as worlds of ours had it
  set(c, "diffuseColor", {0.2, 0.3, 0.4});
  expect(get(c, "diffuseColor").numbers, {0.2, 0.3, 0.4});
  set(def("sun"), "intensity", {5});
  set(def("sun"), "location", {1, 2, 3});
  EXPECT_EQ(world().lamps[0].intensity_w_m2, 5);
  EXPECT_EQ(world().lamps[0].position_m.z, 3);
  set(def("sun"), "on", {0});
  EXPECT_FALSE(world().lamps[0].on);
}

TEST_F(NodesTest, a_robot_tells_more_than_in_webots) {
  open(kOurs);
  const int a = def("A");
  EXPECT_EQ(field(a, "collisions", kInt) > 0, true);
  EXPECT_EQ(get(a, "collisions").numbers.at(0), 0);
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{a, -1}, {}, "proximity"}).ints[2], 8);
  set(a, "selector", {9});
  EXPECT_EQ(get(a, "selector").numbers.at(0), 9);
  set(a, "selector", {16});
  EXPECT_TRUE(host_.has("A.selector: selector: got 16, expected 0 to 15"));
  set(a, "batteryVoltage", {3.7});
  EXPECT_NEAR(get(a, "batteryVoltage").numbers.at(0), 3.7, 0.05);
  set(a, "sensor:ball", {0.25});
  EXPECT_EQ(get(a, "sensor:ball").numbers.at(0), 0.25);
  const auto digest = simulation().digest();
  set(a, "wheelNoise", {0.1});
  EXPECT_NE(simulation().digest(), digest);
  set(a, "leds", {3});
  EXPECT_TRUE(host_.has("it can only be read"));
  const Reply variable = get(a, "variable:count");
  EXPECT_EQ(variable.number, LINK_NOTHING);
  EXPECT_NE(variable.texts.at(0).find("no firmware"), std::string::npos);
  EXPECT_EQ(field(a, "sensor:"), 0);
  EXPECT_EQ(field(def("C"), "collisions"), 0) << "of robots only";
}

TEST_F(NodesTest, custom_data_goes_to_the_robot_and_comes_from_it) {
  open(kOurs);
  set(def("A"), "customData", {}, "blue");
  EXPECT_TRUE(host_.has("custom 0 blue"));
  nodes_->set_custom_data(0, "green");
  EXPECT_EQ(get(def("A"), "customData").texts.at(0), "green");
  EXPECT_EQ(get(def("A"), "data").texts.at(0), "green") << "as it was called";
}

TEST_F(NodesTest, programs_have_nodes_of_their_own) {
  open(kOurs);
  const Reply body = ask(LINK_FIND_NODE, {{1, 0}, {}, ""}, 0, 0);
  EXPECT_EQ(body.ints.at(0), def("A"));
  nodes_->attach(1, 0);
  const Reply boss = ask(LINK_FIND_NODE, {{1, 0}, {}, ""}, 1, -1);
  ASSERT_EQ(boss.number, LINK_NODE);
  EXPECT_EQ(boss.ints[0], def("boss"));
  EXPECT_EQ(boss.texts[2], "Robot");
}

TEST_F(NodesTest, the_world_is_commanded_through_the_host) {
  open(kOurs);
  command(LINK_DO_WORLD, {{0}, {3}, ""});
  command(LINK_DO_WORLD, {{1}, {}, ""});
  command(LINK_DO_WORLD, {{2}, {}, ""});
  command(LINK_DO_WORLD, {{4}, {2, 0.1, 0.2, 0.05, 255, 0}, "goal"});
  command(LINK_DO_WORLD, {{5}, {}, "shot.jpg"});
  command(LINK_DO_NODE, {{def("A"), 2}, {}, ""});
  EXPECT_TRUE(host_.has("end 3 simulation_quit(3)"));
  EXPECT_TRUE(host_.has("reset"));
  EXPECT_TRUE(host_.has("reload"));
  EXPECT_TRUE(host_.has("picture shot.jpg.png"));
  EXPECT_TRUE(host_.has("restart 0"));
  ASSERT_EQ(host_.labels.size(), 1u);
  EXPECT_EQ(host_.labels[0].text, "goal");
  EXPECT_EQ(host_.labels[0].rgb, 255u);
}

// --- worlds of Webots

TEST_F(NodesTest, every_node_of_the_file_is_found_also_what_is_nothing_here) {
  open_wbt(kHead + R"(Viewpoint { position 1 2 3 }
DEF ARENA RectangleArena { floorSize 2 1.5 }
DEF MARK Solid { translation 0.3 0.4 0.01 children [ DEF LOOK Shape { appearance PBRAppearance { baseColor 1 0 0 } geometry Cylinder { radius 0.05 height 0.01 } } ] name "mark" }
DEF GROUP Transform {
  translation 0.5 0 0
  rotation 0 0 1 1.5707963
  children [
    DEF POST Solid { translation 0.1 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } name "post" }
  ]
}
DEF BALL Solid { translation -0.5 0.2 0.03 children [ DEF S Shape { geometry Sphere { radius 0.03 } } ] boundingObject USE S physics Physics { mass 0.1 density -1 } name "ball" }
DEF ROB E-puck { translation 0 -0.3 0 rotation 0 0 1 1 name "r" controller "void" turretSlot [ DEF POS GPS { } ] }
DEF BOSS Robot { name "boss" controller "<extern>" supervisor TRUE children [ Emitter { channel 5 } ] }
)");
  expect(get(def("ARENA"), "floorSize").numbers, {2, 1.5});
  EXPECT_EQ(get(def("ARENA"), "wallHeight").numbers.at(0), 0.1) << "by default";
  expect(position(def("MARK")), {0.3, 0.4, 0.01});
  set(def("MARK"), "translation", {-0.3, 0, 0.01});
  expect(position(def("MARK")), {-0.3, 0, 0.01});
  // inside a group that is turned by 90 degrees
  expect(position(def("POST")), {0.5, 0.1, 0.05});
  expect(get(def("POST"), "translation").numbers, {0.1, 0, 0.05});
  EXPECT_EQ(ask(LINK_FIND_NODE, {{2, 0}, {}, "GROUP.POST"}).ints.at(0), def("POST"));
  set(def("GROUP"), "translation", {-0.5, 0, 0});
  expect(position(def("POST")), {-0.5, 0.1, 0.05});
  EXPECT_NEAR(world().objects[0].name == "post" ? world().objects[0].pose.x_m : world().objects[1].pose.x_m, -0.5, 1e-6);
  // what hangs on a robot goes with it
  expect(position(def("POS")), {0, -0.3, 0}, 1e-3);
  set(def("ROB"), "translation", {0.2, -0.3, 0});
  expect(position(def("POS")), {0.2, -0.3, 0}, 1e-3);
  EXPECT_NEAR(simulation().pose(0).heading_rad, 1, 1e-4) << "where it looks stays";
  EXPECT_EQ(get(inner(def("BOSS"), "children"), "channel").numbers.at(0), 5);
  EXPECT_EQ(ask(LINK_FIND_NODE, {{2, 0}, {}, "BALL"}).texts.at(1), "Solid");
  // root: WorldInfo, Viewpoint, arena, mark, group, ball, robot, supervisor
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{root(), -1}, {}, "children"}).ints[2], 8);
  EXPECT_EQ(inner(root(), "children", -1), def("BOSS"));
}

TEST_F(NodesTest, old_worlds_have_their_axes) {
  open_wbt(kOldHead + R"(DEF FLOOR Solid { children [ DEF F Shape { geometry Box { size 2 0.02 2 } } ] boundingObject USE F translation 0 -0.01 0 }
DEF ROB DifferentialWheels { translation 0.3 0 -0.2 rotation 0 1 0 0.5 controller "void" axleLength 0.052 wheelRadius 0.0205 boundingObject Cylinder { radius 0.037 height 0.05 } physics Physics { } }
DEF BOX Solid { translation -0.3 0.05 0.4 children [ DEF B Shape { geometry Box { size 0.1 0.1 0.2 } } ] boundingObject USE B }
)");
  // theirs (x, y up, z) is ours (x, -z, y)
  EXPECT_NEAR(simulation().pose(0).y_m, 0.2, 1e-4);
  expect(get(def("ROB"), "translation").numbers, {0.3, 0, -0.2}, 1e-3);
  expect(get(def("ROB"), "rotation").numbers, {0, 1, 0, 0.5}, 1e-3);
  set(def("ROB"), "translation", {0.1, 0, 0.6});
  EXPECT_NEAR(simulation().pose(0).x_m, 0.1, 1e-9);
  EXPECT_NEAR(simulation().pose(0).y_m, -0.6, 1e-9);
  set(def("ROB"), "rotation", {0, 1, 0, -1.5707963267948966});
  // at angle 0 it looks along -z, our +y; turned by -90 degrees about y along +x
  EXPECT_NEAR(std::remainder(simulation().pose(0).heading_rad, 2 * sim::kPi), 0, 1e-9);
  expect(get(def("ROB"), "rotation").numbers, {0, 1, 0, -1.5707963267948966}, 1e-9);
  set(def("BOX"), "translation", {0.5, 0.05, 0.5});
  EXPECT_NEAR(world().objects[0].pose.x_m, 0.5, 1e-6);
  EXPECT_NEAR(world().objects[0].pose.y_m, -0.5, 1e-6);
  expect(position(def("BOX")), {0.5, 0.05, 0.5}, 1e-6);
}

TEST_F(NodesTest, nodes_are_imported_while_the_world_runs_and_go_again) {
  open_wbt(kHead + R"(RectangleArena { floorSize 2 2 }
DEF PIECE Shape { appearance PBRAppearance { baseColor 0 1 0 } geometry Box { size 0.1 0.1 0.1 } }
E-puck { translation 0 -0.5 0 controller "void" }
)");
  run(0.5);
  const int children = field(root(), "children", kNode + kList);
  const std::size_t before = world().objects.size();
  const auto digest = simulation().digest();
  const Reply made = ask(LINK_IMPORT, {{children, -1}, {}, R"(DEF NEW Solid { translation 0.4 0.2 0.05 name "new" children [ USE PIECE ] boundingObject USE PIECE })"});
  ASSERT_EQ(made.number, LINK_FIELD) << made.texts.at(0);
  EXPECT_EQ(made.ints[2], 5);
  ASSERT_EQ(world().objects.size(), before + 1);
  const sim::ObjectDesc o = world().objects.back();
  EXPECT_EQ(o.name, "new");
  EXPECT_NEAR(o.pose.x_m, 0.4, 1e-6);
  EXPECT_NEAR(o.size_m.z, 0.1, 1e-6);
  EXPECT_NEAR(o.material.colour.g, 1, 1e-6);
  EXPECT_NE(simulation().digest(), digest);
  // a movable one falls, and a PROTO that comes with Webots
  const Reply ball = ask(LINK_IMPORT, {{children, -1}, {}, "DEF FALL Solid { translation 0 0.5 0.4 boundingObject Sphere { radius 0.03 } children [ Shape { geometry Sphere { radius 0.03 } } ] physics Physics { } } DEF WOOD WoodenBox { translation 0.7 -0.7 0.05 size 0.1 0.1 0.1 }"});
  ASSERT_EQ(ball.number, LINK_FIELD) << ball.texts.at(0);
  expect(position(def("FALL")), {0, 0.5, 0.4}, 1e-6);
  run(1);
  EXPECT_NEAR(position(def("FALL"))[2], 0.03, 0.005);
  expect(position(def("WOOD")), {0.7, -0.7, 0.05}, 1e-6);
  EXPECT_EQ(world().objects.size(), before + 3);
  // away
  const int wood = def("WOOD");
  command(LINK_DO_NODE, {{wood, 3}, {}, ""});
  EXPECT_EQ(def("WOOD"), 0);
  EXPECT_EQ(ask(LINK_FIND_NODE, {{3, wood}, {}, ""}).number, LINK_NOTHING);
  EXPECT_EQ(world().objects.size(), before + 2);
  command(LINK_REMOVE, {{children, -2}, {}, ""});
  EXPECT_EQ(def("NEW"), 0);
  EXPECT_EQ(world().objects.size(), before + 1);
  expect(position(def("FALL")), {0, 0.5, 0.03}, 0.01);
  run(0.2);
}

TEST_F(NodesTest, wrong_imports_change_nothing) {
  open_wbt(kHead + "RectangleArena { floorSize 2 2 }\nE-puck { translation 0 -0.5 0 controller \"void\" }\n");
  const int children = field(root(), "children");
  const auto digest = simulation().digest();
  for (const char* text : {"", "Solid {", "Solid { translation }}", "E-puck { }", "Robot { controller \"x\" }", "}{", "DEF"}) {
    const Reply r = ask(LINK_IMPORT, {{children, -1}, {}, text});
    EXPECT_EQ(r.number, LINK_NOTHING) << text;
    EXPECT_NE(r.texts.at(0).find("Group.children: "), std::string::npos) << r.texts.at(0);
  }
  EXPECT_EQ(ask(LINK_IMPORT, {{children, 99}, {}, "Solid { }"}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_IMPORT, {{field(def("E-puck"), "translation"), -1}, {}, "Solid { }"}).number, LINK_NOTHING);
  EXPECT_EQ(simulation().digest(), digest);
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{root(), -1}, {}, "children"}).ints[2], 3);
}

TEST_F(NodesTest, the_same_commands_give_the_same_digest) {
  std::uint64_t digests[2] = {};
  for (std::uint64_t& digest : digests) {
    open_wbt(kHead + "RectangleArena { floorSize 2 2 }\nDEF R E-puck { translation 0 -0.5 0 controller \"void\" }\n"
                     "DEF B SoccerBall { translation 0.5 0.5 0.05 radius 0.05 mass 0.1 }\n");
    run(0.25);
    set(def("R"), "translation", {0.1, 0.1, 0});
    command(LINK_DO_NODE, {{def("B"), 0}, {-0.5, -0.5, 0, 0, 0, 0}, ""});
    ask(LINK_IMPORT, {{field(root(), "children"), -1}, {}, "Solid { translation 0.5 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } }"});
    run(0.5);
    digest = simulation().digest();
  }
  EXPECT_EQ(digests[0], digests[1]);
}

// what the team does when a program resets the simulation
TEST_F(NodesTest, numbers_of_nodes_and_fields_outlive_a_reset) {
  open_wbt(kHead + "RectangleArena { }\nDEF B Solid { translation 0.2 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } }\n"
                   "DEF R E-puck { translation -0.2 0 0 controller \"void\" customData \"first\" }\n");
  const sim::WorldDesc first = world();
  const int b = def("B"), r = def("R"), place = field(b, "translation"), children = field(root(), "children");
  set(b, "translation", {0.4, 0.4, 0.05});
  set(r, "customData", {}, "second");
  ASSERT_EQ(ask(LINK_IMPORT, {{children, -1}, {}, "DEF N Solid { translation 0 0.3 0.05 boundingObject Box { size 0.1 0.1 0.1 } }"}).number, LINK_FIELD);
  host_.its_twin->simulation().refurnish(first, {});
  nodes_->begin_again();
  EXPECT_EQ(def("B"), b);
  EXPECT_EQ(def("N"), 0);
  expect(ask(LINK_GET, {{place, -1}, {}, ""}).numbers, {0.2, 0, 0.05}, 1e-6);
  EXPECT_EQ(get(r, "customData").texts.at(0), "first");
  command(LINK_SET, {{place, 0, 0}, {0.3, 0, 0.05}, ""});
  EXPECT_NEAR(world().objects[0].pose.x_m, 0.3, 1e-6);
}

TEST_F(NodesTest, noise_that_was_set_stays_when_something_comes) {
  open(kOurs);
  set(def("A"), "wheelNoise", {0.25});
  set(def("A"), "proximityNoise", {3});
  ask(LINK_IMPORT, {{field(root(), "children"), -1}, {}, "Solid { translation 0 0.3 0.05 boundingObject Box { size 0.1 0.1 0.1 } }"});
  EXPECT_EQ(get(def("A"), "wheelNoise").numbers.at(0), 0.25);
  EXPECT_EQ(get(def("A"), "proximityNoise").numbers.at(0), 3);
}

// a program that imports and removes for hours
TEST_F(NodesTest, removed_nodes_make_room) {
  open_wbt(kHead + "RectangleArena { }\nE-puck { translation -0.2 0 0 controller \"void\" }\n");
  const int children = field(root(), "children");
  for (int i = 0; i < 300; ++i) {
    const Reply made = ask(LINK_IMPORT, {{children, -1}, {}, "DEF M Solid { translation 0.3 0.3 0.05 boundingObject Box { size 0.1 0.1 0.1 } }"});
    ASSERT_EQ(made.number, LINK_FIELD) << made.texts.at(0);
    ASSERT_EQ(made.ints[2], 4);
    command(LINK_DO_NODE, {{def("M"), 3}, {}, ""});
  }
  EXPECT_TRUE(world().objects.empty());
  // but not without end in one another
  int inner_most = root();
  int made = 0;
  for (; made < 1000; ++made) {
    if (ask(LINK_IMPORT, {{field(inner_most, "children"), 0}, {}, "Group { children [ ] }"}).number != LINK_FIELD) break;
    inner_most = inner(inner_most, "children");
  }
  EXPECT_GT(made, 50);
  EXPECT_LT(made, 300);
}

// whatever a program sends, the world stays whole
TEST_F(NodesTest, no_record_of_chance_breaks_the_world) {
  open_wbt(kHead + R"(RectangleArena { floorSize 2 2 }
DEF B Solid { translation 0.2 0 0.05 children [ DEF S Shape { geometry Box { size 0.1 0.1 0.1 } } ] boundingObject USE S physics Physics { } recognitionColors [ 1 0 0 ] }
DEF R E-puck { translation -0.2 0 0 controller "void" }
PointLight { location 0 0 1 }
)");
  std::uint64_t state = 7;
  const auto draw = [&](std::uint64_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % below;
  };
  const char* names[] = {"translation", "rotation", "children", "size",   "name",     "recognitionColors", "geometry", "boundingObject",
                         "physics",     "mass",     "location", "on",     "selector", "controllerArgs",    "traps",    "proximity"};
  const char* texts[] = {"", "B", "R.S", "Solid { translation 1 1 1 }", "Shape { geometry Sphere { radius 0.02 } }", "__init__", "Physics { }", "USE S", "\xff{"};
  const double values[] = {0, 1, -1, 0.05, 1e300, -1e300, NAN, INFINITY, 0.3, 2e9};
  const int rows[] = {LINK_FIND_NODE, LINK_FIND_FIELD, LINK_GET, LINK_IMPORT, LINK_ASK_NODE, LINK_SET, LINK_INSERT, LINK_REMOVE, LINK_DO_NODE, LINK_DO_WORLD};
  for (int i = 0; i < 20000; ++i) {
    const int row = rows[draw(10)];
    Words words;
    for (int k = 0; k < 3; ++k) words.ints.push_back(static_cast<std::int64_t>(draw(40)) - 3);
    if (draw(50) == 0) words.ints[draw(3)] = draw(2) ? INT64_MAX : INT64_MIN;
    const std::size_t count = draw(8);
    for (std::size_t k = 0; k < count; ++k) words.list.push_back(values[draw(10)]);
    words.text = row == LINK_FIND_FIELD ? names[draw(16)] : texts[draw(9)];
    if (row == LINK_FIND_FIELD && draw(4)) words.ints[1] = -1;
    if (row == LINK_FIND_NODE || row == LINK_FIND_FIELD || row == LINK_GET || row == LINK_IMPORT || row == LINK_ASK_NODE)
      ask(row, words, static_cast<int>(draw(3)), static_cast<int>(draw(2)) - 1);
    else
      command(row, words);
    if (i % 1000 == 0) run(0.01);
  }
  for (const sim::ObjectDesc& o : world().objects) EXPECT_LE(std::abs(o.pose.x_m), 1000);
  run(0.05);
}

TEST_F(NodesTest, lists_of_values_grow_and_shrink) {
  open_wbt(kHead + "RectangleArena { }\nDEF B Solid { translation 0.2 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } recognitionColors [ 1 0 0 ] }\nE-puck { translation -0.2 0 0 controller \"void\" }\n");
  const int colours = field(def("B"), "recognitionColors", kColour + kList);
  ASSERT_EQ(world().objects.size(), 1u);
  EXPECT_EQ(world().objects[0].recognition_colours.size(), 1u);
  command(LINK_INSERT, {{colours, -1}, {0, 1, 0}, ""});
  ASSERT_EQ(world().objects[0].recognition_colours.size(), 2u);
  EXPECT_EQ(world().objects[0].recognition_colours[1].g, 1);
  command(LINK_SET, {{colours, 0, 0}, {0, 0, 1}, ""});
  expect(ask(LINK_GET, {{colours, 0}, {}, ""}).numbers, {0, 0, 1});
  command(LINK_REMOVE, {{colours, 0}, {}, ""});
  ASSERT_EQ(world().objects[0].recognition_colours.size(), 1u);
  EXPECT_EQ(world().objects[0].recognition_colours[0].g, 1);
}

}  // namespace
