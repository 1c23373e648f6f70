// SPDX-License-Identifier: MIT
// Each function of a supervisor, held by tables: fields of every type, what a node is asked and told, and what there is
// none of here.
#include <device/robot.h>
#include <device/supervisor.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <webots/robot.h>
#include <webots/supervisor.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "tests/controller/fake_simulator.h"
#include "tests/controller/supervised.h"
#include "tests/support/wording.h"

using fake::give;
using fake::give_field;
using fake::give_node;
using fake::Packet;
using fake::Record;
using fake::Simulator;
using fake::supervised;

namespace {

constexpr std::int64_t kStep = 32000000;  // ns
constexpr int kOne = 31, kMany = 32;      // fields: a single one, and a list of two

/// A world of one node whose fields "one" and "many" are of a type and have this value.
struct Answers {
  int type = WB_SF_BOOL;
  std::vector<double> numbers;
  std::string text;
};

/// Answers questions until the step, which is answered too; gives the commands.
std::vector<Record> commands(Simulator& sim, const Answers& with) {
  std::vector<Record> told;
  for (;;) {
    std::vector<Record> said = sim.next();
    if (said.empty()) return told;
    const Record last = said.back();
    said.pop_back();
    told.insert(told.end(), said.begin(), said.end());
    switch (last.number) {
      case LINK_STEP:
        sim.done(kStep);
        return told;
      case LINK_FIND_NODE:
        give_node(sim, 5);
        break;
      case LINK_FIND_FIELD:
        if (last.texts[0] == "many")
          give_field(sim, kMany, with.type | WB_MF, 2, "many");
        else
          give_field(sim, kOne, with.type, -1, "one");
        break;
      case LINK_ASK_NODE:
      case LINK_GET:
        give(sim, with.numbers, with.text.c_str(), last.number == LINK_GET && last.ints[0] == kMany ? 2 : -1);
        break;
      case LINK_IMPORT:
        told.push_back(last);
        give_field(sim, static_cast<int>(last.ints[0]), with.type, 3, "");
        break;
      default:
        ADD_FAILURE() << "record " << last.number << " ends a packet";
        return told;
    }
  }
}

WbNodeRef ball() { return wb_supervisor_node_get_from_id(5); }
WbFieldRef one() { return wb_supervisor_node_get_field(ball(), "one"); }
WbFieldRef many() { return wb_supervisor_node_get_field(ball(), "many"); }

void say(double value) { printf("%g,", value); }
void say(const char* text) { printf("%s,", text); }
template <int N>
void say(const double* values) {
  for (int i = 0; i < N; ++i) say(values[i]);
}

struct Type {
  const char* name;
  Answers answers;
  void (*program)();
};
constexpr double kPlace[] = {1, 2, 3}, kTurn[] = {0, 1, 0, 0.5}, kColour[] = {1, 0.5, 0};

#define SET_AND_GET(name, value, tell)                      \
  [] {                                                      \
    wb_supervisor_field_set_sf_##name(one(), value);        \
    tell(wb_supervisor_field_get_sf_##name(one()));         \
    wb_supervisor_field_set_mf_##name(many(), 1, value);    \
    wb_supervisor_field_insert_mf_##name(many(), 2, value); \
    tell(wb_supervisor_field_get_mf_##name(many(), 1));     \
    tell(wb_supervisor_field_get_mf_##name(many(), -2));    \
    wb_robot_step(32);                                      \
  }
const Type kTypes[] = {
    {"Bool", {WB_SF_BOOL, {1}, ""}, SET_AND_GET(bool, true, say)},
    {"Int32", {WB_SF_INT32, {-7}, ""}, SET_AND_GET(int32, -7, say)},
    {"Float", {WB_SF_FLOAT, {2.5}, ""}, SET_AND_GET(float, 2.5, say)},
    {"Vec2f", {WB_SF_VEC2F, {1, 2}, ""}, SET_AND_GET(vec2f, kPlace, say<2>)},
    {"Vec3f", {WB_SF_VEC3F, {1, 2, 3}, ""}, SET_AND_GET(vec3f, kPlace, say<3>)},
    {"Rotation", {WB_SF_ROTATION, {0, 1, 0, 0.5}, ""}, SET_AND_GET(rotation, kTurn, say<4>)},
    {"Color", {WB_SF_COLOR, {1, 0.5, 0}, ""}, SET_AND_GET(color, kColour, say<3>)},
    {"String", {WB_SF_STRING, {}, "text"}, SET_AND_GET(string, "text", say)},
};

/// What a program of the table tells: the value of the field, or its text, for each time it asks.
std::string three_times(const Answers& a) {
  std::string told;
  for (const double number : a.numbers) {
    char text[32];
    snprintf(text, sizeof text, "%g,", number);
    told += text;
  }
  if (a.numbers.empty()) told = a.text + ",";
  return told + told + told;
}

}  // namespace

TEST(WorldFunctions, fields_of_every_type_are_set_inserted_and_read) {
  for (const Type& type : kTypes) {
    SCOPED_TRACE(type.name);
    Simulator sim(type.program);
    sim.welcome(supervised());
    const auto told = commands(sim, type.answers);
    ASSERT_EQ(told.size(), 3u);
    const std::vector<std::vector<std::int64_t>> places = {{kOne, 0, 0}, {kMany, 1, 0}, {kMany, 2}};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(told[i].number, i < 2 ? LINK_SET : LINK_INSERT);
      EXPECT_EQ(told[i].ints, places[i]);
      EXPECT_EQ(told[i].lists[0], type.answers.numbers);
      EXPECT_EQ(told[i].texts[0], type.answers.text);
    }
    EXPECT_EQ(sim.wait(), 0);
    EXPECT_EQ(sim.output(), three_times(type.answers));
    EXPECT_EQ(sim.errors(), "");
  }
}

TEST(WorldFunctions, a_field_of_another_type_or_place_is_told_and_left_alone) {
  Simulator sim([] {
    wb_supervisor_field_set_mf_float(one(), 0, 1);
    wb_supervisor_field_insert_mf_float(many(), 4, 1);
    wb_supervisor_field_set_mf_float(many(), -3, 1);
    wb_supervisor_field_set_mf_float(many(), 0, INFINITY);
    wb_supervisor_field_set_sf_vec2f(one(), kPlace);
    printf("%g ", wb_supervisor_field_get_mf_float(many(), 2));
    printf("%d ", std::isnan(wb_supervisor_field_get_mf_vec3f(many(), 0)[0]));
    printf("%d ", wb_supervisor_field_get_mf_bool(many(), 0));
    wb_supervisor_field_enable_sf_tracking(one(), 32);
    wb_supervisor_field_disable_sf_tracking(one());
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  EXPECT_TRUE(commands(sim, {WB_SF_FLOAT, {2.5}, ""}).empty());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "0 1 0 ");
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      "Warning: wb_supervisor_field_set_mf_float(): got \"one\", a SFFloat, expected a MFFloat\n"
      "Warning: wb_supervisor_field_insert_mf_float(): got 4 for \"many\", expected 0 to 2\n"
      "Warning: wb_supervisor_field_set_mf_float(): got -3 for \"many\", expected 0 to 1\n"
      "Warning: wb_supervisor_field_set_mf_float(): got inf, expected a finite number\n"
      "Warning: wb_supervisor_field_set_sf_vec2f(): got \"one\", a SFFloat, expected a SFVec2f\n"
      "Warning: wb_supervisor_field_get_mf_float(): got 2 for \"many\", expected 0 to 1\n"
      "Warning: wb_supervisor_field_get_mf_vec3f(): got \"many\", a MFFloat, expected a MFVec3f\n"
      "Warning: wb_supervisor_field_get_mf_bool(): got \"many\", a MFFloat, expected a MFBool"));
}

TEST(WorldFunctions, nodes_are_imported_from_texts_and_files_and_removed) {
  char file[] = "/tmp/world_functionsXXXXXX";
  close(mkstemp(file));
  std::ofstream(file) << "Ball { }";
  Simulator sim([&] {
    wb_supervisor_field_import_sf_node_from_string(one(), "Box { }");
    wb_supervisor_field_import_sf_node(one(), file);
    wb_supervisor_field_import_mf_node(many(), 0, file);
    wb_supervisor_field_import_mf_node(many(), 0, "/nowhere/node.wbo");
    wb_supervisor_field_remove_sf(one());
    wb_supervisor_field_remove_mf_node(many(), 1);
    wb_supervisor_field_remove_mf_node(one(), 0);
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  const auto told = commands(sim, {WB_SF_NODE, {}, ""});
  ASSERT_EQ(told.size(), 5u);
  const std::vector<std::vector<std::int64_t>> places = {
      {kOne, 0}, {kOne, 0}, {kMany, 0}, {kOne, 0}, {kMany, 1}};
  const std::vector<std::string> texts = {"Box { }", "Ball { }", "Ball { }"};
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].number, i < 3 ? LINK_IMPORT : LINK_REMOVE);
    EXPECT_EQ(told[i].ints, places[i]);
    if (i < 3) {
      EXPECT_EQ(told[i].texts[0], texts[i]);
    }
  }
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      "Warning: wb_supervisor_field_import_mf_node(): cannot read '/nowhere/node.wbo': No such "
      "file or directory\n"
      "Warning: wb_supervisor_field_remove_mf(): got SFNode, expected a list"));
  std::remove(file);
}

TEST(WorldFunctions, a_node_tells_its_kind_and_how_many_fields_it_has) {
  Simulator sim([] {
    printf("%s %s %d ", wb_supervisor_node_get_type_name(ball()),
           wb_supervisor_node_get_base_type_name(ball()), wb_supervisor_node_is_proto(ball()));
    printf("%d %d %d ", wb_supervisor_node_get_number_of_fields(ball()),
           wb_supervisor_node_get_proto_number_of_fields(ball()),
           wb_supervisor_node_get_number_of_base_node_fields(ball()));
    printf("%d %d ", wb_supervisor_node_get_static_balance(ball()),
           wb_supervisor_node_get_number_of_fields(nullptr));
    const WbProtoRef proto = wb_supervisor_node_get_proto(ball());
    printf("%d[%s]%d%d%d ", proto == nullptr, wb_supervisor_proto_get_type_name(proto),
           wb_supervisor_proto_is_derived(proto), wb_supervisor_proto_get_parent(proto) == nullptr,
           wb_supervisor_proto_get_number_of_fields(proto));
    printf("[%s]", wb_supervisor_node_export_string(ball()));
    wb_supervisor_node_set_joint_position(ball(), 1, 1);
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  EXPECT_TRUE(commands(sim, {WB_SF_FLOAT, {1}, ""}).empty());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "Ball Solid 1 1 1 1 1 -1 1[]01-1 []");
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      "Warning: wb_supervisor_node_export_string(): nodes are not written as text\n"
      "Warning: wb_supervisor_node_set_joint_position(): joints cannot be set; use the wheels' motors"));
}

TEST(WorldFunctions, points_of_contact_are_asked_once_a_step) {
  Simulator sim([] {
    int size = -1;
    printf("%d %g ", wb_supervisor_node_get_number_of_contact_points(ball()),
           wb_supervisor_node_get_contact_point(ball(), 1)[2]);
    const WbContactPoint* const points = wb_supervisor_node_get_contact_points(ball(), true, &size);
    printf("%d %g %d ", size, points[0].point[1], points[1].node_id);
    printf("%d%d%d%d", wb_supervisor_node_get_contact_point(ball(), 2) == nullptr,
           wb_supervisor_node_get_contact_point(ball(), -1) == nullptr,
           wb_supervisor_node_get_contact_point_node(ball(), 1) == ball(),
           wb_supervisor_node_get_number_of_contact_points(nullptr));
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  commands(sim, {WB_SF_FLOAT, {1, 2, 3, 4, 5, 6}, ""});
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "2 6 2 2 5 111-1");
}

TEST(WorldFunctions, forces_turn_with_the_node_and_about_its_middle) {
  Simulator sim([] {
    const double force[3] = {1, 0, 0}, offset[3] = {0, 2, 0}, torque[3] = {0, 1, 0}, spoilt[3] = {NAN, 0, 0};
    wb_supervisor_node_add_torque(ball(), torque, false);
    wb_supervisor_node_add_torque(ball(), torque, true);
    wb_supervisor_node_add_force_with_offset(ball(), force, offset, false);
    wb_supervisor_node_add_force_with_offset(ball(), force, offset, true);
    wb_supervisor_node_add_torque(ball(), spoilt, false);
    wb_supervisor_node_add_force_with_offset(ball(), force, nullptr, false);
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  // it has turned by a right angle about z: x becomes y, y becomes -x
  const auto told = commands(sim, {WB_SF_FLOAT, {0, -1, 0, 1, 0, 0, 0, 0, 1}, ""});
  ASSERT_EQ(told.size(), 6u);
  constexpr int kForce = 4, kTorque = 5;  // as DO_NODE numbers them
  const std::vector<std::pair<int, std::vector<double>>> wanted = {
      {kTorque, {0, 1, 0}}, {kTorque, {-1, 0, 0}},
      {kForce, {1, 0, 0}},  {kTorque, {0, 0, 0}},    // 2 m along -x, in line with the force
      {kForce, {0, 1, 0}},  {kTorque, {0, 0, -2}}};  // (-2, 0) x (0, 1)
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].number, LINK_DO_NODE);
    EXPECT_EQ(told[i].ints, (std::vector<std::int64_t>{5, wanted[i].first})) << i;
    EXPECT_EQ(told[i].lists[0], wanted[i].second) << i;
  }
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      "Warning: wb_supervisor_node_add_torque(): got NaN or an infinite number, expected 3 numbers\n"
      "Warning: wb_supervisor_node_add_force_with_offset(): got NULL, expected 3 numbers"));
}

TEST(WorldFunctions, each_command_to_a_node_has_its_number) {
  Simulator sim([] {
    const double velocity[6] = {1, 2, 3, 4, 5, 6};
    wb_supervisor_node_set_velocity(ball(), velocity);
    wb_supervisor_node_reset_physics(ball());
    wb_supervisor_node_restart_controller(ball());
    wb_supervisor_node_remove(ball());
    wb_supervisor_node_save_state(ball(), "begin");
    wb_supervisor_node_load_state(ball(), "begin");
    wb_supervisor_node_remove(nullptr);
    wb_supervisor_node_move_viewpoint(ball());
    wb_supervisor_node_set_visibility(ball(), ball(), false);
    wb_supervisor_node_enable_pose_tracking(ball(), 32, nullptr);
    wb_supervisor_node_disable_pose_tracking(ball(), nullptr);
    wb_supervisor_node_enable_contact_points_tracking(ball(), 32, true);
    wb_supervisor_node_disable_contact_points_tracking(ball());
    wb_supervisor_node_enable_contact_point_tracking(ball(), 32, true);
    wb_supervisor_node_disable_contact_point_tracking(ball(), true);
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  const auto told = commands(sim, {});
  const std::vector<std::int64_t> numbers = {0, 1, 2, 3, 6, 7};
  ASSERT_EQ(told.size(), numbers.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].ints, (std::vector<std::int64_t>{5, numbers[i]}));
    EXPECT_EQ(told[i].texts[0], i < 4 ? "" : "begin");
  }
  EXPECT_EQ(told[0].lists[0], (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_TRUE(
      wording::reads(sim.errors(), "Warning: wb_supervisor_node_remove(): got NULL, expected a node"));
}

TEST(WorldFunctions, each_command_to_the_world_has_its_number) {
  Simulator sim([] {
    wb_robot_init();
    printf("%d ", wb_supervisor_simulation_get_mode() == WB_SUPERVISOR_SIMULATION_MODE_FAST);
    wb_supervisor_simulation_reset();
    supervisor_simulation_revert();  // of 2005: back to the beginning
    wb_supervisor_world_reload();
    wb_supervisor_simulation_revert();
    wb_supervisor_simulation_reset_physics();
    wb_supervisor_simulation_physics_reset();
    supervisor_simulation_physics_reset();
    wb_supervisor_simulation_set_mode(WB_SUPERVISOR_SIMULATION_MODE_PAUSE);
    printf("%d", wb_supervisor_simulation_get_mode() == WB_SUPERVISOR_SIMULATION_MODE_PAUSE);
    supervisor_export_image("/tmp/shot.png", 80);
    wb_supervisor_export_image("", 80);
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  const auto told = commands(sim, {});
  const std::vector<std::int64_t> numbers = {1, 1, 2, 2, 3, 3, 3, 6, 5};
  ASSERT_EQ(told.size(), numbers.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].number, LINK_DO_WORLD);
    EXPECT_EQ(told[i].ints[0], numbers[i]) << i;
  }
  EXPECT_EQ(told[7].lists[0], (std::vector<double>{WB_SUPERVISOR_SIMULATION_MODE_PAUSE}));
  EXPECT_EQ(told[8].lists[0], (std::vector<double>{80}));
  EXPECT_EQ(told[8].texts[0], "/tmp/shot.png");
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 1");
  EXPECT_TRUE(
      wording::reads(sim.errors(), "Warning: wb_supervisor_export_image(): got no name, expected a file"));
}

TEST(WorldFunctions, a_run_has_one_world_and_programs_make_no_movies) {
  Simulator sim([] {
    wb_robot_init();
    wb_supervisor_world_load("a.wbt");
    wb_supervisor_load_world("a.wbt");
    printf("%d", wb_supervisor_world_save("a.wbt"));
    printf("%d", wb_supervisor_save_world("a.wbt"));
    wb_supervisor_movie_start_recording("a.mp4", 1, 2, 3, 4, 5, true);
    wb_supervisor_start_movie("a.mp4", 1, 2, 3, 4, 5, true);
    printf("%d%d", wb_supervisor_animation_start_recording("a.html"),
           wb_supervisor_animation_stop_recording());
    wb_supervisor_movie_stop_recording();
    wb_supervisor_stop_movie();
    printf("%d%d%d%d", wb_supervisor_movie_is_ready(), wb_supervisor_movie_failed(),
           wb_supervisor_movie_get_status() == WB_SUPERVISOR_MOVIE_READY,
           wb_supervisor_get_movie_status() == WB_SUPERVISOR_MOVIE_READY);
    printf("%d%d%d", wb_supervisor_virtual_reality_headset_is_used(),
           wb_supervisor_virtual_reality_headset_get_position() == nullptr,
           wb_supervisor_virtual_reality_headset_get_orientation() == nullptr);
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  EXPECT_TRUE(commands(sim, {}).empty());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "00001011011");
  const std::string world = "(): a run has one world, which is neither changed for another nor written\n",
                    movie =
                        "(): programs make no movies; record the run (twinpuck run --record) and replay it\n";
  EXPECT_EQ(sim.errors(), "Warning: wb_supervisor_world_load" + world + "Warning: wb_supervisor_load_world" +
                              world + "Warning: wb_supervisor_world_save" + world +
                              "Warning: wb_supervisor_save_world" + world +
                              "Warning: wb_supervisor_movie_start_recording" + movie +
                              "Warning: wb_supervisor_start_movie" + movie +
                              "Warning: wb_supervisor_animation_start_recording" + movie);
}

TEST(WorldFunctions, a_robot_of_2005_may_be_given_another_controller) {
  Simulator sim([] {
    const NodeRef robot = supervisor_node_get_from_def("ROBOT");
    supervisor_robot_set_controller(robot, "text");  // it has that one: only started again
    supervisor_robot_set_controller(robot, "other");
    supervisor_robot_set_controller(nullptr, "other");
    robot_step(32);
  });
  sim.welcome(supervised());
  const auto told = commands(sim, {WB_SF_STRING, {}, "text"});
  ASSERT_EQ(told.size(), 3u);
  EXPECT_EQ(told[0].number, LINK_DO_NODE);
  EXPECT_EQ(told[0].ints, (std::vector<std::int64_t>{5, 2}));
  EXPECT_EQ(told[1].number, LINK_SET);
  EXPECT_EQ(told[1].texts[0], "other");
  EXPECT_EQ(told[2].ints, (std::vector<std::int64_t>{5, 2}));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_TRUE(wording::reads(sim.errors(),
                             "Warning: supervisor_robot_set_controller(): got NULL, expected a node that "
                             "supervisor_node_was_found()"));
}
