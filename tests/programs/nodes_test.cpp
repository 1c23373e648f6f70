// SPDX-License-Identifier: MIT
// Nodes of worlds of ours, which no file of Webots stands behind.
#include "programs/world/catalogue.h"
#include "tests/programs/nodes_fixture.h"
#include "tests/support/wording.h"

using namespace nodes_test;

namespace {

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
  EXPECT_TRUE(wording::reads(none.texts.at(0), "got 'Z', expected the DEF of a node"));
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

TEST_F(NodesTest, what_a_program_follows_is_told_as_it_is_now) {
  open(kOurs);
  const int a = def("A"), place = field(a, "translation");
  const auto followed = [&](int program) {
    std::vector<std::vector<double>> all;
    link_packet out{};
    nodes_->tell_followed(program, out);
    link_reader reader;
    link_record r;
    link_read(&reader, out.bytes, out.size);
    while (link_next(&reader, &r)) {
      EXPECT_EQ(r.number, LINK_FOLLOWED);
      all.push_back(
          {static_cast<double>(r.ints[0]), static_cast<double>(r.ints[1]), static_cast<double>(r.ints[2])});
      all.back().insert(all.back().end(), r.lists[0].values, r.lists[0].values + r.lists[0].count);
    }
    link_free(&out);
    return all;
  };
  EXPECT_TRUE(followed(0).empty());
  for (const int what : {0, 2}) command(LINK_FOLLOW, {{a, 0, what, 1}, {}, ""});
  for (int i = 0; i < 2; ++i) command(LINK_FOLLOW, {{a, place, 0, 1}, {}, ""});  // once is enough
  set(a, "translation", {-0.2, -0.3, 0});
  const auto all = followed(0);
  ASSERT_EQ(all.size(), 3u);
  const auto numbers_of = [&](std::size_t i) {
    return std::vector<double>(all[i].begin() + 3, all[i].end());
  };
  EXPECT_EQ(numbers_of(0), position(a));
  EXPECT_EQ(numbers_of(1), ask(LINK_ASK_NODE, {{a, 2}, {}, ""}).numbers);
  EXPECT_EQ(numbers_of(2), get(a, "translation").numbers);
  EXPECT_EQ(all[2][1], place);
  EXPECT_TRUE(followed(1).empty()) << "another program";
  command(LINK_FOLLOW, {{a, 0, 2, 0}, {}, ""});
  EXPECT_EQ(followed(0).size(), 2u);
  nodes_->forget_followed(0);
  EXPECT_TRUE(followed(0).empty());
  // numbers of a robot of firmware and of other nodes; texts and lists are asked for
  for (const char* name : {"distance", "selector", "customData", "proximity"})
    command(LINK_FOLLOW, {{a, field(a, name), 0, 1}, {}, ""}, 2);
  command(LINK_FOLLOW, {{def("sun"), field(def("sun"), "intensity"), 0, 1}, {}, ""}, 2);
  std::vector<double> last;
  for (const std::vector<double>& one : followed(2)) last.push_back(one.back());
  expect(last, {0, 0, 2});
  // a question that has no such numbers, what is not there
  const std::size_t said = host_.said.size();
  for (const std::vector<std::int64_t>& wrong : std::vector<std::vector<std::int64_t>>{
           {a, 0, 4, 1}, {a, 0, 6, 1}, {a, 0, -1, 1}, {a, 4711, 0, 1}, {4711, 0, 0, 1}})
    command(LINK_FOLLOW, {wrong, {}, ""});
  EXPECT_EQ(host_.said.size(), said + 5);
  EXPECT_TRUE(wording::reads(
      host_.said.back(),
      "warn 0 got FOLLOW of node 4711, field 0, what 0, expected a field or a question about a place"));
  EXPECT_TRUE(followed(0).empty());
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
  // 15 mm above the floor under it; a crate's is its middle
  expect(ask(LINK_ASK_NODE, {{a, 3}, {}, ""}).numbers, {-0.2, -0.3, 0.015}, 1e-6);
  expect(ask(LINK_ASK_NODE, {{def("C"), 3}, {}, ""}).numbers, {-0.4, 0.1, 0.03}, 1e-3);
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
  EXPECT_TRUE(wording::reads(variable.texts.at(0),
                             "A.variable:count: got a robot that runs no firmware, expected one that does"));
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
  EXPECT_TRUE(host_.has("end 3 its program ended the run with status 3"));
  EXPECT_TRUE(host_.has("reset"));
  EXPECT_TRUE(host_.has("reload"));
  EXPECT_TRUE(host_.has("picture shot.jpg.png"));
  EXPECT_TRUE(
      host_.has("warn 0 wb_supervisor_export_image(): got 'shot.jpg', expected a name that ends in .png or "
                ".svg; the picture is shot.jpg.png"));
  EXPECT_TRUE(host_.has("restart 0"));
  ASSERT_EQ(host_.labels.size(), 1u);
  EXPECT_EQ(host_.labels[0].text, "goal");
  EXPECT_EQ(host_.labels[0].rgb, 255u);
}

TEST_F(NodesTest, noise_that_was_set_stays_when_something_comes) {
  open(kOurs);
  set(def("A"), "wheelNoise", {0.25});
  set(def("A"), "proximityNoise", {3});
  ask(LINK_IMPORT, {{field(root(), "children"), -1},
                    {},
                    "Solid { translation 0 0.3 0.05 boundingObject Box { size 0.1 0.1 0.1 } }"});
  EXPECT_EQ(get(def("A"), "wheelNoise").numbers.at(0), 0.25);
  EXPECT_EQ(get(def("A"), "proximityNoise").numbers.at(0), 3);
}

TEST(FieldTypes, have_the_names_of_vrml) {
  const struct {
    int type;
    const char* name;
  } cases[] = {{programs::kNoField, ""},
               {programs::kBool, "SFBool"},
               {programs::kInt, "SFInt32"},
               {programs::kTurn, "SFRotation"},
               {programs::kNode, "SFNode"},
               {programs::kNode + 1, ""},
               {-1, ""},
               {programs::kList, ""},
               {programs::kList + programs::kVec3, "MFVec3f"},
               {programs::kList + programs::kNode, "MFNode"},
               {programs::kList + programs::kNode + 1, ""}};
  for (const auto& c : cases) EXPECT_EQ(programs::field_type_name(c.type), c.name) << c.type;
}

}  // namespace
