// SPDX-License-Identifier: MIT
// Nodes of worlds of Webots: what the file says, what comes and goes while the world runs.
#include "tests/programs/nodes_fixture.h"

using namespace nodes_test;

namespace {

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
DEF ROB E-puck { translation 0 -0.3 0 rotation 0 0 1 1 name "r" controller "void" controllerArgs [ "one" "two" ] turretSlot [ DEF POS GPS { } ] }
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
  EXPECT_NEAR(world().objects[0].name == "post" ? world().objects[0].pose.x_m : world().objects[1].pose.x_m,
              -0.5, 1e-6);
  // what hangs on a robot goes with it
  expect(position(def("POS")), {0, -0.3, 0}, 1e-3);
  set(def("ROB"), "translation", {0.2, -0.3, 0});
  expect(position(def("POS")), {0.2, -0.3, 0}, 1e-3);
  EXPECT_NEAR(simulation().pose(0).heading_rad, 1, 1e-4) << "where it looks stays";
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{def("ROB"), -1}, {}, "controllerArgs"}).ints[2], 2);
  EXPECT_EQ(get(inner(def("BOSS"), "children"), "channel").numbers.at(0), 5);
  EXPECT_EQ(get(inner(def("BOSS"), "children"), "name").texts.at(0), "emitter") << "its usual name";
  nodes_->attach(3, 0);
  const Reply device = ask(LINK_FIND_NODE, {{4, 1}, {}, ""}, 3, -1);
  ASSERT_EQ(device.number, LINK_NODE) << device.texts.at(0);
  EXPECT_EQ(device.texts.at(1), "Emitter");
  EXPECT_EQ(ask(LINK_FIND_NODE, {{2, 0}, {}, "BALL"}).texts.at(1), "Solid");
  // root: WorldInfo, Viewpoint, arena, mark, group, ball, robot, supervisor
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{root(), -1}, {}, "children"}).ints[2], 8);
  EXPECT_EQ(inner(root(), "children", -1), def("BOSS"));
}

TEST_F(NodesTest, old_worlds_have_their_axes) {
  open_wbt(
      kOldHead +
      R"(DEF FLOOR Solid { children [ DEF F Shape { geometry Box { size 2 0.02 2 } } ] boundingObject USE F translation 0 -0.01 0 }
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

// programs of that time counted robots and did not mean supervisors
TEST_F(NodesTest, supervisors_of_old_worlds_are_a_kind_of_their_own) {
  open_wbt(
      "#VRML_SIM R2018a utf8\nWorldInfo { }\nRectangleArena { }\nDEF S Supervisor { name \"s\" controller "
      "\"<extern>\" }\nDEF R E-puck { controller \"void\" }\n");
  EXPECT_EQ(ask(LINK_FIND_NODE, {{2, 0}, {}, "R"}).ints[2], 34);
  EXPECT_EQ(ask(LINK_FIND_NODE, {{2, 0}, {}, "S"}).ints[2], 88) << "WB_NODE_SUPERVISOR";
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
  const Reply made = ask(
      LINK_IMPORT,
      {{children, -1},
       {},
       R"(DEF NEW Solid { translation 0.4 0.2 0.05 name "new" children [ USE PIECE ] boundingObject USE PIECE })"});
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
  const Reply ball =
      ask(LINK_IMPORT, {{children, -1},
                        {},
                        "DEF FALL Solid { translation 0 0.5 0.4 boundingObject Sphere { radius 0.03 } "
                        "children [ Shape { geometry Sphere { radius 0.03 } } ] physics Physics { } } DEF "
                        "WOOD WoodenBox { translation 0.7 -0.7 0.05 size 0.1 0.1 0.1 }"});
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
  for (const auto& [text, said] :
       {std::pair("", "got no node, expected one such as Solid { }"),
        std::pair("Solid {", "line 1: got the end of the file, expected the name of a field, or '}'"),
        std::pair("Solid { translation }}", "line 1: got '}', expected a value"),
        std::pair("E-puck { }", "got a robot, E-puck: robots come and go only when a run begins"),
        std::pair("Robot { controller \"x\" }",
                  "got a robot, Robot: robots come and go only when a run begins"),
        std::pair("}{", "line 1: got '}', expected a node such as `Solid {`"),
        std::pair("DEF", "line 1: got the end of the file, expected a name behind DEF")}) {
    const Reply r = ask(LINK_IMPORT, {{children, -1}, {}, text});
    EXPECT_EQ(r.number, LINK_NOTHING) << text;
    EXPECT_EQ(r.texts.at(0), std::string("Group.children: ") + said) << text;
  }
  EXPECT_EQ(ask(LINK_IMPORT, {{children, 99}, {}, "Solid { }"}).number, LINK_NOTHING);
  EXPECT_EQ(ask(LINK_IMPORT, {{field(def("E-puck"), "translation"), -1}, {}, "Solid { }"}).number,
            LINK_NOTHING);
  EXPECT_EQ(simulation().digest(), digest);
  EXPECT_EQ(ask(LINK_FIND_FIELD, {{root(), -1}, {}, "children"}).ints[2], 3);
}

TEST_F(NodesTest, the_same_commands_give_the_same_digest) {
  std::uint64_t digests[2] = {};
  for (std::uint64_t& digest : digests) {
    open_wbt(kHead +
             "RectangleArena { floorSize 2 2 }\nDEF R E-puck { translation 0 -0.5 0 controller \"void\" }\n"
             "DEF B SoccerBall { translation 0.5 0.5 0.05 radius 0.05 mass 0.1 }\n");
    run(0.25);
    set(def("R"), "translation", {0.1, 0.1, 0});
    command(LINK_DO_NODE, {{def("B"), 0}, {-0.5, -0.5, 0, 0, 0, 0}, ""});
    ask(LINK_IMPORT, {{field(root(), "children"), -1},
                      {},
                      "Solid { translation 0.5 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } }"});
    run(0.5);
    digest = simulation().digest();
  }
  EXPECT_EQ(digests[0], digests[1]);
}

// what the team does when a program resets the simulation
TEST_F(NodesTest, numbers_of_nodes_and_fields_outlive_a_reset) {
  open_wbt(
      kHead +
      "RectangleArena { }\nDEF B Solid { translation 0.2 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } }\n"
      "DEF R E-puck { translation -0.2 0 0 controller \"void\" customData \"first\" }\n");
  const sim::WorldDesc first = world();
  const int b = def("B"), r = def("R"), place = field(b, "translation"), children = field(root(), "children");
  set(b, "translation", {0.4, 0.4, 0.05});
  set(r, "customData", {}, "second");
  ASSERT_EQ(
      ask(LINK_IMPORT, {{children, -1},
                        {},
                        "DEF N Solid { translation 0 0.3 0.05 boundingObject Box { size 0.1 0.1 0.1 } }"})
          .number,
      LINK_FIELD);
  host_.its_twin->simulation().refurnish(first, {});
  nodes_->begin_again();
  EXPECT_EQ(def("B"), b);
  EXPECT_EQ(def("N"), 0);
  expect(ask(LINK_GET, {{place, -1}, {}, ""}).numbers, {0.2, 0, 0.05}, 1e-6);
  EXPECT_EQ(get(r, "customData").texts.at(0), "first");
  command(LINK_SET, {{place, 0, 0}, {0.3, 0, 0.05}, ""});
  EXPECT_NEAR(world().objects[0].pose.x_m, 0.3, 1e-6);
}

// a program that imports and removes for hours
TEST_F(NodesTest, removed_nodes_make_room) {
  open_wbt(kHead + "RectangleArena { }\nE-puck { translation -0.2 0 0 controller \"void\" }\n");
  const int children = field(root(), "children");
  for (int i = 0; i < 300; ++i) {
    const Reply made = ask(
        LINK_IMPORT, {{children, -1},
                      {},
                      "DEF M Solid { translation 0.3 0.3 0.05 boundingObject Box { size 0.1 0.1 0.1 } }"});
    ASSERT_EQ(made.number, LINK_FIELD) << made.texts.at(0);
    ASSERT_EQ(made.ints[2], 4);
    command(LINK_DO_NODE, {{def("M"), 3}, {}, ""});
  }
  EXPECT_TRUE(world().objects.empty());
  // but not without end in one another
  int inner_most = root();
  int made = 0;
  for (; made < 1000; ++made) {
    if (ask(LINK_IMPORT, {{field(inner_most, "children"), 0}, {}, "Group { children [ ] }"}).number !=
        LINK_FIELD)
      break;
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
  const char* names[] = {"translation",       "rotation", "children",       "size",           "name",
                         "recognitionColors", "geometry", "boundingObject", "physics",        "mass",
                         "location",          "on",       "selector",       "controllerArgs", "traps",
                         "proximity"};
  const char* texts[] = {"",
                         "B",
                         "R.S",
                         "Solid { translation 1 1 1 }",
                         "Shape { geometry Sphere { radius 0.02 } }",
                         "__init__",
                         "Physics { }",
                         "USE S",
                         "\xff{"};
  const double values[] = {0, 1, -1, 0.05, 1e300, -1e300, NAN, INFINITY, 0.3, 2e9};
  const int rows[] = {LINK_FIND_NODE, LINK_FIND_FIELD, LINK_GET,    LINK_IMPORT,  LINK_ASK_NODE,
                      LINK_SET,       LINK_INSERT,     LINK_REMOVE, LINK_DO_NODE, LINK_DO_WORLD};
  for (int i = 0; i < 20000; ++i) {
    const int row = rows[draw(10)];
    Words words;
    for (int k = 0; k < 3; ++k) words.ints.push_back(static_cast<std::int64_t>(draw(40)) - 3);
    if (draw(50) == 0) words.ints[draw(3)] = draw(2) ? INT64_MAX : INT64_MIN;
    const std::size_t count = draw(8);
    for (std::size_t k = 0; k < count; ++k) words.list.push_back(values[draw(10)]);
    words.text = row == LINK_FIND_FIELD ? names[draw(16)] : texts[draw(9)];
    if (row == LINK_FIND_FIELD && draw(4)) words.ints[1] = -1;
    if (row == LINK_FIND_NODE || row == LINK_FIND_FIELD || row == LINK_GET || row == LINK_IMPORT ||
        row == LINK_ASK_NODE)
      ask(row, words, static_cast<int>(draw(3)), static_cast<int>(draw(2)) - 1);
    else
      command(row, words);
    if (i % 1000 == 0) run(0.01);
  }
  for (const sim::ObjectDesc& o : world().objects) EXPECT_LE(std::abs(o.pose.x_m), 1000);
  run(0.05);
}

TEST_F(NodesTest, lists_of_values_grow_and_shrink) {
  open_wbt(kHead +
           "RectangleArena { }\nDEF B Solid { translation 0.2 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } "
           "recognitionColors [ 1 0 0 ] }\nE-puck { translation -0.2 0 0 controller \"void\" }\n");
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
