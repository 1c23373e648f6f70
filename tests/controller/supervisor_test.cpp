// SPDX-License-Identifier: MIT
// Supervisors: questions about nodes and fields, and commands to the world, in both interfaces.
#include <device/robot.h>
#include <device/supervisor.h>
#include <gtest/gtest.h>
#include <webots/robot.h>
#include <webots/supervisor.h>

#include <cmath>
#include <cstdio>

#include "tests/controller/fake_simulator.h"
#include "tests/controller/supervised.h"
#include "tests/support/wording.h"

using fake::asked;
using fake::give;
using fake::give_field;
using fake::give_node;
using fake::Packet;
using fake::Record;
using fake::Simulator;
using fake::supervised;
using fake::World;

TEST(ControllerSupervisor, a_robot_without_the_right_is_told) {
  Simulator sim([] {
    wb_robot_init();
    printf("%d %d", wb_supervisor_node_get_from_def("BALL") == nullptr,
           wb_supervisor_node_get_root() == nullptr);
    wb_supervisor_simulation_quit(0);
  });
  sim.welcome({});
  EXPECT_TRUE(sim.next().empty());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 1");
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      "Warning: wb_supervisor_node_get_root(): this robot is no supervisor; in the world it needs supervisor "
      "TRUE\nWarning: wb_supervisor_node_get_from_def(): this robot is no supervisor; in the world it needs "
      "supervisor TRUE\nWarning: wb_supervisor_simulation_quit(): this robot is no supervisor; in the world "
      "it needs supervisor TRUE"));
}

TEST(ControllerSupervisor, a_node_is_one_reference) {
  Simulator sim([] {
    WbNodeRef ball = wb_supervisor_node_get_from_def("BALL");
    printf("%d %s %s %d ", wb_supervisor_node_get_id(ball), wb_supervisor_node_get_def(ball),
           wb_supervisor_node_get_type_name(ball), wb_supervisor_node_get_type(ball) == WB_NODE_SOLID);
    printf("%d ", wb_supervisor_node_get_from_def("BALL") == ball);
    printf("%d", wb_supervisor_node_get_from_def("NOBODY") == nullptr);
  });
  sim.welcome(supervised());
  const Record question = asked(sim, LINK_FIND_NODE);
  EXPECT_EQ(question.ints[0], 2);
  EXPECT_EQ(question.texts[0], "BALL");
  give_node(sim, 12);
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 12);
  asked(sim, LINK_FIND_NODE);
  sim.send(Packet().add(LINK_NOTHING, ""));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "12 BALL Ball 1 1 1");
  EXPECT_EQ(sim.errors(), "") << "whether there is a node is a question";
}

TEST(ControllerSupervisor, what_is_asked_for_step_after_step_comes_with_the_steps) {
  Simulator sim([] {
    WbNodeRef ball = wb_supervisor_node_get_from_def("BALL");
    WbFieldRef place = wb_supervisor_node_get_field(ball, "translation");
    WbFieldRef level = wb_supervisor_node_get_field(ball, "variable:level");
    for (int step = 0; step < 4; ++step) {
      printf("%g ", wb_supervisor_field_get_sf_vec3f(place)[1]);
      printf("%g ", wb_supervisor_node_get_velocity(ball)[5]);
      wb_robot_step(32);
    }
    // what is written of firmware leaves places as they are, but not what is read of it
    printf("%g ", wb_supervisor_field_get_sf_float(level));
    wb_supervisor_field_set_sf_float(level, 7);
    wb_supervisor_set_label(0, "a", 0, 0, 0.1, 0, 0, "Arial");
    printf("%g ", wb_supervisor_field_get_sf_vec3f(place)[1]);
    printf("%g ", wb_supervisor_field_get_sf_float(level));
    // a place that is written does not
    const double to[3] = {1, 50, 3};
    wb_supervisor_field_set_sf_vec3f(place, to);
    printf("%g ", wb_supervisor_field_get_sf_vec3f(place)[1]);
    for (int step = 0; step < 5; ++step) wb_robot_step(32);
  });
  sim.welcome(supervised());
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 3);
  asked(sim, LINK_FIND_FIELD);
  give_field(sim, 8, WB_SF_VEC3F, -1, "translation");
  asked(sim, LINK_FIND_FIELD);
  give_field(sim, 9, WB_SF_FLOAT, -1, "variable:level");
  std::int64_t now = 0;
  const auto step = [&](double y, double spin, bool is_followed) {
    Packet samples;
    if (is_followed) {
      samples.add(LINK_FOLLOWED, 3, 8, 0, std::vector<double>{0, y, 0});
      samples.add(LINK_FOLLOWED, 3, 0, 2, std::vector<double>{0, 0, 0, 0, 0, spin});
    }
    sim.done(now += 32000000, samples);
  };
  // asked for once, and in the next step again
  for (int i = 0; i < 2; ++i) {
    for (const bool of_node : {false, true}) {
      const auto said = sim.next();
      ASSERT_EQ(said.size(), i == 0 ? 1u : 2u);
      EXPECT_EQ(said.back().number, of_node ? LINK_ASK_NODE : LINK_GET);
      if (i == 1) {
        EXPECT_EQ(said[0].number, LINK_FOLLOW);
        EXPECT_EQ(said[0].ints, (std::vector<std::int64_t>{3, of_node ? 0 : 8, of_node ? 2 : 0, 1}));
      }
      give(sim, of_node ? std::vector<double>{0, 0, 0, 0, 0, 20.0 + i} : std::vector<double>{0, 10.0 + i, 0});
    }
    EXPECT_TRUE(sim.until_step().empty());
    step(12 + i, 22 + i, i == 1);
  }
  EXPECT_TRUE(sim.until_step().empty()) << "nothing is asked for";
  step(14, 24, true);
  EXPECT_TRUE(sim.until_step().empty());
  step(15, 25, true);
  asked(sim, LINK_GET);
  give(sim, {1});
  const auto again = sim.next();
  ASSERT_EQ(again.size(), 3u);
  EXPECT_EQ(again[0].number, LINK_SET);
  EXPECT_EQ(again[1].number, LINK_DO_WORLD);
  EXPECT_EQ(again[2].number, LINK_GET);
  EXPECT_EQ(again[2].ints, (std::vector<std::int64_t>{9, 0}));
  give(sim, {7});
  const auto placed = sim.next();
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[1].ints, (std::vector<std::int64_t>{8, 0}));
  give(sim, {1, 50, 3});
  // nobody asks for them any more
  std::vector<Record> ends;
  for (int i = 0; i < 5; ++i) {
    for (const Record& r : sim.until_step()) ends.push_back(r);
    step(16, 26, ends.empty());
  }
  ASSERT_EQ(ends.size(), 2u);
  for (const Record& r : ends) {
    EXPECT_EQ(r.number, LINK_FOLLOW);
    EXPECT_EQ(r.ints[0], 3);
    EXPECT_EQ(r.ints[3], 0);
  }
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "10 20 11 21 13 23 14 24 1 15 7 50 ");
  EXPECT_EQ(sim.errors(), "");
}

TEST(ControllerSupervisor, a_position_is_asked_once_until_the_world_may_have_changed) {
  Simulator sim([] {
    WbNodeRef ball = wb_supervisor_node_get_self();
    printf("%g %g ", wb_supervisor_node_get_position(ball)[0], wb_supervisor_node_get_position(ball)[2]);
    wb_robot_step(32);
    const double* position = wb_supervisor_node_get_position(ball);
    printf("%g ", position[0]);
    wb_supervisor_node_reset_physics(ball);
    wb_supervisor_node_get_position(ball);
    printf("%g", position[0]);
  });
  sim.welcome(supervised());
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 3);
  asked(sim, LINK_ASK_NODE);
  give(sim, {1, 2, 3});
  sim.until_step();
  sim.done(32000000);
  asked(sim, LINK_ASK_NODE);
  give(sim, {4, 5, 6});
  const auto said = sim.next();
  ASSERT_EQ(said.size(), 2u) << "what was commanded before comes in the question's packet";
  EXPECT_EQ(said[0].number, LINK_DO_NODE);
  EXPECT_EQ(said[0].ints, (std::vector<std::int64_t>{3, 1}));
  give(sim, {7, 8, 9});
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 3 4 7");
}

TEST(ControllerSupervisor, a_pose_may_be_seen_from_another_node) {
  Simulator sim([] {
    WbNodeRef ball = wb_supervisor_node_get_from_id(5), goal = wb_supervisor_node_get_from_id(6);
    const double* pose = wb_supervisor_node_get_pose(ball, goal);
    for (int i = 0; i < 16; ++i) printf("%g ", pose[i] + 0.0);
  });
  sim.welcome(supervised());
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 5);
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 6);
  asked(sim, LINK_ASK_NODE);
  give(sim, {1, 0, 0, 2, 0, 1, 0, 3, 0, 0, 1, 0, 0, 0, 0, 1});
  asked(sim, LINK_ASK_NODE);
  // turned by 90 degrees about z, at (2, 1): the ball is 2 ahead of it, and turned by -90 degrees
  give(sim, {0, -1, 0, 2, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1});
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "0 1 0 2 -1 0 0 0 0 0 1 0 0 0 0 1 ");
}

TEST(ControllerSupervisor, fields_have_types) {
  Simulator sim([] {
    WbNodeRef ball = wb_supervisor_node_get_from_id(5);
    WbFieldRef t = wb_supervisor_node_get_field(ball, "translation");
    const double to[3] = {1, 2, 3}, spoilt[3] = {1, NAN, 3};
    printf("%s %s %d %d ", wb_supervisor_field_get_name(t), wb_supervisor_field_get_type_name(t),
           wb_supervisor_field_get_count(t), wb_supervisor_node_get_field(ball, "translation") == t);
    wb_supervisor_field_set_sf_vec3f(t, to);
    wb_supervisor_field_set_sf_vec3f(t, spoilt);
    wb_supervisor_field_set_sf_float(t, 4);
    wb_supervisor_field_set_sf_vec3f(nullptr, to);
    printf("%g %d ", wb_supervisor_field_get_sf_vec3f(t)[1],
           std::isnan(wb_supervisor_field_get_sf_rotation(t)[3]));
    WbFieldRef name = wb_supervisor_node_get_field(ball, "name");
    printf("%s ", wb_supervisor_field_get_sf_string(name));
    printf("%d", wb_supervisor_node_get_field(ball, "mass") == nullptr);
    wb_supervisor_field_set_sf_string(name, "new");
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 5);
  EXPECT_EQ(asked(sim, LINK_FIND_FIELD).texts[0], "translation");
  give_field(sim, 31, WB_SF_VEC3F, -1, "translation");
  const auto said = sim.next();
  ASSERT_EQ(said.size(), 2u) << "the good one, and the question";
  EXPECT_EQ(said[0].number, LINK_SET);
  EXPECT_EQ(said[0].lists[0], (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(said[1].number, LINK_GET);
  EXPECT_EQ(said[1].ints[0], 31);
  give(sim, {1, 2, 3});
  asked(sim, LINK_FIND_FIELD);
  give_field(sim, 32, WB_SF_STRING, -1, "name");
  asked(sim, LINK_GET);
  give(sim, {}, "ball");
  asked(sim, LINK_FIND_FIELD);
  sim.send(Packet().add(LINK_NOTHING, ""));
  const auto last = sim.until_step();
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].texts[0], "new");
  sim.done(32000000);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "translation SFVec3f -1 1 2 1 ball 1");
  EXPECT_TRUE(
      wording::reads(sim.errors(),
                     "Warning: wb_supervisor_field_set_sf_vec3f(): got nan, expected a finite "
                     "number\nWarning: wb_supervisor_field_set_sf_float(): got \"translation\", a SFVec3f, "
                     "expected a SFFloat\nWarning: wb_supervisor_field_set_sf_vec3f(): got NULL, expected a "
                     "field\nWarning: wb_supervisor_field_get_sf_rotation(): got \"translation\", a SFVec3f, "
                     "expected a SFRotation\nWarning: wb_supervisor_node_get_field(): got \"mass\", expected "
                     "a field that the node has"));
}

TEST(ControllerSupervisor, lists_grow_and_shrink) {
  Simulator sim([] {
    WbFieldRef children = wb_supervisor_node_get_field(wb_supervisor_node_get_from_id(1), "children");
    printf("%d ", wb_supervisor_field_get_count(children));
    wb_supervisor_field_import_mf_node_from_string(children, -1, "DEF B Ball { }");
    printf("%d ", wb_supervisor_field_get_count(children));
    printf("%d ", wb_supervisor_node_get_id(wb_supervisor_field_get_mf_node(children, -1)));
    printf("%d ", wb_supervisor_field_get_mf_node(children, 3) == nullptr);
    wb_supervisor_field_remove_mf(children, 0);
    wb_robot_step(32);
  });
  sim.welcome(supervised());
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 1, WB_NODE_GROUP);
  asked(sim, LINK_FIND_FIELD);
  give_field(sim, 9, WB_MF_NODE, 2, "children");
  const Record import = asked(sim, LINK_IMPORT);
  EXPECT_EQ(import.ints, (std::vector<std::int64_t>{9, -1}));
  EXPECT_EQ(import.texts[0], "DEF B Ball { }");
  give_field(sim, 9, WB_MF_NODE, 3, "children");
  EXPECT_EQ(asked(sim, LINK_GET).ints, (std::vector<std::int64_t>{9, 2}));
  give(sim, {}, "", 3, 77);
  const auto last = sim.until_step();
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].number, LINK_REMOVE);
  EXPECT_EQ(last[0].ints, (std::vector<std::int64_t>{9, 0}));
  sim.done(32000000);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "2 3 77 1 ");
}

TEST(ControllerSupervisor, the_world_is_commanded) {
  Simulator sim([] {
    wb_robot_init();
    wb_supervisor_set_label(2, "score", 0.1, 0.2, 0.05, 0xFF0000, 0.5, "Arial");
    wb_supervisor_set_label(3, "old", 0, 0, 0.1, 0xFF, 0);  // as programs before 2018 do
    wb_supervisor_simulation_reset();
    wb_supervisor_export_image("shot.png", 100);
    const double force[3] = {1, 0, 0};
    wb_supervisor_node_add_force(wb_supervisor_node_get_from_id(5), force, false);
    wb_supervisor_simulation_quit(3);
    wb_robot_cleanup();
  });
  sim.welcome(supervised());
  auto said = sim.next();
  ASSERT_EQ(said.size(), 5u);
  EXPECT_EQ(said[0].lists[0], (std::vector<double>{2, 0.1, 0.2, 0.05, 0xFF0000, 0.5}));
  EXPECT_EQ(said[0].texts[0], "score");
  EXPECT_EQ(said[1].texts[0], "old");
  EXPECT_EQ(said[2].ints[0], 1);
  EXPECT_EQ(said[3].texts[0].front(), '/') << "the simulator runs in another folder";
  give_node(sim, 5);
  said = sim.next();
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].number, LINK_DO_NODE);
  EXPECT_EQ(said[0].ints[1], 4);
  EXPECT_EQ(said[1].number, LINK_DO_WORLD);
  EXPECT_EQ(said[1].lists[0], (std::vector<double>{3}));
  EXPECT_EQ(sim.wait(), 0);
}

TEST(ControllerSupervisor, questions_are_answered_after_the_end) {
  Simulator sim([] {
    wb_robot_init();
    printf("%d ", wb_robot_step(32));
    printf("%g", wb_supervisor_node_get_position(wb_supervisor_node_get_self())[1]);
  });
  sim.welcome(supervised());
  sim.until_step();
  sim.send(Packet().add(LINK_END));
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 5);
  asked(sim, LINK_ASK_NODE);
  give(sim, {1, 2, 3});
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "-1 2");
}

TEST(ControllerSupervisor, questions_to_nobody_have_no_answer) {
  Simulator sim([] {
    wb_robot_init();
    wb_robot_step(32);
    WbNodeRef self = wb_supervisor_node_get_self();
    printf("%d %d", self == nullptr, std::isnan(wb_supervisor_node_get_position(self)[0]));
  });
  sim.welcome(supervised());
  sim.until_step();
  sim.close();
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 1");
}

namespace {
float pose[7];

void follow_ball() {
  robot_step(0);
  NodeRef ball = supervisor_node_get_from_def("BALL");
  printf("%d ", supervisor_node_was_found(ball));
  supervisor_field_get(ball, SUPERVISOR_FIELD_TRANSLATION_AND_ROTATION, pose, 64);
  printf("%g %g %g %g ", pose[0], pose[1], pose[2], pose[6]);
  robot_step(32);
  printf("%g ", pose[0]);
  robot_step(32);
  printf("%g", pose[0]);
  const float to[2] = {8, 9};
  supervisor_field_set(ball, SUPERVISOR_FIELD_TRANSLATION_X | SUPERVISOR_FIELD_TRANSLATION_Z, to);
  robot_step(32);
}

/// The ball at (1, 2, 3) of the world's axes, turned by 0.5 about its upward axis; then at x 5.
std::vector<double> follow(bool nue, std::string* said) {
  Simulator sim(follow_ball);
  sim.welcome(supervised(nue));
  sim.until_step();
  sim.done(0);
  asked(sim, LINK_FIND_NODE);
  give_node(sim, 5);
  asked(sim, LINK_FIND_FIELD);
  give_field(sim, 31, WB_SF_VEC3F, -1, "translation");
  asked(sim, LINK_FIND_FIELD);
  give_field(sim, 32, WB_SF_ROTATION, -1, "rotation");
  asked(sim, LINK_GET);
  give(sim, {1, 2, 3});
  asked(sim, LINK_GET);
  give(sim, nue ? std::vector<double>{0, 1, 0, 0.5} : std::vector<double>{0, 0, 1, 0.5});
  sim.until_step();
  sim.done(32000000);
  sim.until_step();
  sim.done(64000000);
  // the buffer fills itself; nothing changes until a part is set, so that the rest is not asked for again
  asked(sim, LINK_GET);
  give(sim, {5, 2, 3});
  asked(sim, LINK_GET);
  give(sim, nue ? std::vector<double>{0, 1, 0, 0.5} : std::vector<double>{0, 0, 1, 0.5});
  const auto last = sim.until_step();
  sim.done(96000000);
  EXPECT_EQ(sim.wait(), 0);
  *said = sim.output();
  return last.size() == 1 ? last[0].lists[0] : std::vector<double>{};
}
}  // namespace

TEST(ControllerSupervisor, the_interface_of_2005_fills_buffers) {
  std::string said;
  EXPECT_EQ(follow(true, &said), (std::vector<double>{8, 2, 9}));
  EXPECT_EQ(said, "1 1 2 3 0.5 1 5");
}

TEST(ControllerSupervisor, the_interface_of_2005_has_y_up_in_every_world) {
  std::string said;
  // there x is 8 and z is 9, which is y = -9 with z up
  EXPECT_EQ(follow(false, &said), (std::vector<double>{8, -9, 3}));
  EXPECT_EQ(said, "1 1 3 -2 0.5 1 5");
}
