// SPDX-License-Identifier: MIT
// E-pucks of all kinds, supervisors, and worlds that are broken or hostile.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"
#include "import/import.h"
#include "sim_core/load/world_loader.h"

namespace {

namespace fs = std::filesystem;

wbt::Imported raw(const std::string& text, const std::string& folder = "") {
  wbt::Options options;
  options.file = "test.wbt";
  options.folder = folder;
  options.out_folder = folder;
  options.model = board::epuck_model();
  return wbt::import_world(text, options);
}

sim::WorldDesc world_of(const wbt::Imported& made) {
  const auto loaded =
      sim::parse_world(made.toml, "/nonexistent/test.toml", {board::epuck_model()}, board::part_kinds());
  EXPECT_TRUE(loaded.world.has_value()) << loaded.report("test.toml") << "\n" << made.toml;
  return loaded.world ? *loaded.world : sim::WorldDesc{};
}

bool reports(const wbt::Imported& made, int line, const std::string& words) {
  for (const wbt::Remark& r : made.report) {
    if ((line == 0 || r.line == line) && r.text.find(words) != std::string::npos) return true;
  }
  return false;
}

const std::string kOld = "#VRML_SIM V6.0 utf8\n";
const std::string kNew = "#VRML_SIM R2023b utf8\n";

TEST(ImportRobots, slots_and_channels_become_parts_and_devices) {
  const auto made = raw(kNew + R"(E-puck {
  name "left"
  emitter_channel 3
  groundSensorsSlot [ E-puckGroundSensors { } ]
  turretSlot [
    GPS { }
    Pose { children [ Compass { name "north" } ] }
    Emitter { name "loud" channel 7 range 0.5 type "infra-red" }
    Lidar { }
  ]
  customData "blue"
  camera_width 64
})");
  const auto world = world_of(made);
  ASSERT_EQ(world.robots.size(), 1u);
  ASSERT_EQ(world.robots[0].parts.size(), 1u);
  EXPECT_EQ(world.robots[0].parts[0].kind, "ground-sensors");
  const auto& toml = made.toml;
  EXPECT_NE(toml.find("name = \"emitter\"\nkind = \"emitter\"\nchannel = 3\n"), std::string::npos) << toml;
  EXPECT_NE(toml.find("name = \"gps\"\nkind = \"gps\"\n"), std::string::npos);
  EXPECT_NE(toml.find("name = \"north\"\nkind = \"compass\"\n"), std::string::npos);
  EXPECT_NE(toml.find("name = \"loud\"\nkind = \"emitter\"\nchannel = 7\nrange = 0.5\ninfra_red = true\n"),
            std::string::npos);
  EXPECT_NE(
      toml.find("name = \"lidar\"\nkind = \"lidar\"\nwidth = 512\nheight = 4\nat = [-0.0095, 0.0, 0.0486]\n"),
      std::string::npos)
      << toml;
  EXPECT_EQ(world.robots[0].custom_data, "blue");
  EXPECT_TRUE(reports(made, 13, "camera_width"));
}

TEST(ImportRobots, plain_nodes_that_are_an_e_puck_bring_their_sensors) {
  std::string sensors;
  for (int i = 0; i < 8; ++i)
    sensors += "DistanceSensor { name \"ps" + std::to_string(i) +
               "\" lookupTable [ 0 4095 0.005 0.07 34 0.7 ] type \"infra-red\" numberOfRays 4 aperture " +
               (i == 5 ? "0.6" : "0.3") + " gaussianWidth 1 }\n";
  const auto made =
      raw(kOld + "DEF ONE DifferentialWheels {\n translation 0.1 0 0.2\n children [\n" + sensors +
          " GPS { }\n ]\n name \"one\"\n controller \"obstacle\"\n axleLength 0.052\n wheelRadius 0.0205\n "
          "speedUnit 0.1\n slipNoise 0.2\n}\n");
  const auto world = world_of(made);
  ASSERT_EQ(world.robots.size(), 1u);
  const sim::RobotDesc& r = world.robots[0];
  EXPECT_EQ(r.name, "one");
  EXPECT_EQ(r.def, "ONE");
  EXPECT_NEAR(r.pose.x_m, 0.1, 1e-6);
  EXPECT_NEAR(r.pose.y_m, -0.2, 1e-6);
  EXPECT_NEAR(r.pose.heading_rad, sim::kPi / 2, 1e-4);  // along -z, away from the reader
  EXPECT_EQ(world.engine, sim::Engine::Kinematic);      // it has no Physics
  EXPECT_NEAR(world.webots.speed_unit_rad_s, 0.1, 1e-9);
  ASSERT_TRUE(r.wheels.noise);
  EXPECT_NEAR(*r.wheels.noise, 0.2, 1e-9);
  ASSERT_EQ(r.sensors.size(), 8u);  // one of them differs
  EXPECT_NEAR(*r.sensors[5].proximity.aperture_rad, 0.6, 1e-6);
  EXPECT_NEAR(*r.sensors[4].proximity.aperture_rad, 0.3, 1e-6);
  ASSERT_TRUE(r.sensors[0].proximity.table);
  EXPECT_EQ(r.sensors[0].proximity.table->size(), 2u);
  EXPECT_NEAR(r.sensors[0].proximity.table->at(1).relative_noise, 0.7, 1e-9);
  EXPECT_EQ(*r.sensors[0].proximity.rays, 4);
}

TEST(ImportRobots, a_world_has_one_unit_of_speed) {
  const std::string wheels = "DifferentialWheels { axleLength 0.052 wheelRadius 0.0205 ";
  const auto made = raw(kNew + wheels + "speedUnit 0.1 name \"a\" }\n" + wheels +
                        "translation 1 0 0 speedUnit 0.2 name \"b\" }\n");
  EXPECT_EQ(world_of(made).webots.speed_unit_rad_s, 0.1);
  EXPECT_TRUE(reports(made, 3, "a second speedUnit"));
}

TEST(ImportRobots, other_robots_stand_there_and_supervisors_run) {
  const auto made = raw(kNew + R"(RectangleArena { floorSize 3 3 }
Robot { translation 1 0 0.05 name "feeder" controller "food" boundingObject Box { size 0.1 0.1 0.1 } }
DEF REF Robot { name "referee" controller "soccer_supervisor" supervisor TRUE }
E-puck { controller "a" }
E-puck { translation 0.5 0.5 0 controller "a" }
)");
  const auto world = world_of(made);
  EXPECT_EQ(world.robots.size(), 2u);
  EXPECT_EQ(world.robots[1].name, "e-puck(1)");
  EXPECT_TRUE(reports(made, 6, "\"e-puck\" a second time"));
  ASSERT_EQ(world.objects.size(), 1u);
  EXPECT_EQ(world.objects[0].name, "feeder");
  EXPECT_TRUE(reports(made, 3, "its program runs, its body stands there"));
  ASSERT_EQ(world.supervisors.size(), 2u);
  EXPECT_EQ(world.supervisors[0].name, "feeder");
  EXPECT_EQ(world.supervisors[0].program, "food");
  EXPECT_EQ(world.supervisors[1].name, "referee");
  EXPECT_EQ(world.supervisors[1].def, "REF");
  EXPECT_EQ(world.supervisors[1].program, "soccer_supervisor");
}

TEST(ImportRobots, a_robot_inside_a_wall_steps_aside_and_says_so) {
  const auto made = raw(kNew + R"(RectangleArena { floorSize 2 2 }
Solid { translation 0 0 0.05 boundingObject Box { size 0.1 0.1 0.1 } }
E-puck { translation 0.04 0 0 }
)");
  const auto world = world_of(made);
  ASSERT_EQ(world.robots.size(), 1u);
  EXPECT_GE(std::hypot(world.robots[0].pose.x_m, world.robots[0].pose.y_m), 0.087 - 1e-3);
  EXPECT_TRUE(reports(made, 0, "inside something"));
}

TEST(ImportRobots, sources_beside_the_world_are_named_by_their_folder) {
  const fs::path top = fs::path(::testing::TempDir()) / ("twinpuck-import-" + std::to_string(getpid()));
  fs::create_directories(top / "worlds");
  fs::create_directories(top / "controllers" / "mine");
  fs::create_directories(top / "controllers" / "snake");
  fs::create_directories(top / "protos");
  std::ofstream(top / "controllers" / "mine" / "mine.c") << "int main() { return 0; }\n";
  std::ofstream(top / "controllers" / "snake" / "snake.py") << "pass\n";
  std::ofstream(top / "protos" / "Block.proto") << kNew + R"(PROTO Block [
  field SFVec3f translation 0 0 0
  field SFFloat{0.1, 0.2} length 0.1
  field MFNode more [ ]
] {
  Solid { translation IS translation boundingObject Box { size %{= fields.length.value }% 0.02 0.1 } }
})";
  const auto made = raw(kNew + R"(EXTERNPROTO "../protos/Block.proto"
PROTO Post [ field SFVec3f translation 0 0 0 ] { Solid { translation IS translation boundingObject Cylinder { radius 0.01 height 0.1 } } }
E-puck { controller "mine" }
E-puck { name "b" translation 0 1 0 controller "snake" }
E-puck { name "c" translation 0 -1 0 controller "gone" }
Block { translation 1 0 0.05 length 0.3 }
Post { translation -1 0 0.05 }
Strange { translation 2 0 0 }
)",
                        (top / "worlds").string());
  const auto world = world_of(made);
  fs::remove_all(top);
  ASSERT_EQ(world.robots.size(), 3u);
  EXPECT_EQ(world.robots[0].firmware, "../controllers/mine");
  EXPECT_EQ(world.robots[1].firmware, "../controllers/snake");
  EXPECT_FALSE(reports(made, 5, "controller"));
  EXPECT_TRUE(reports(made, 6, "\"gone\", whose sources are not beside the world"));
  ASSERT_EQ(world.objects.size(), 2u) << made.toml;
  EXPECT_NEAR(world.objects[0].size_m.x, 0.3, 1e-6);
  EXPECT_NEAR(world.objects[0].pose.x_m, 1, 1e-6);
  EXPECT_EQ(world.objects[1].kind, sim::ObjectKind::Cylinder);
  EXPECT_TRUE(reports(made, 9, "Strange: not carried: a node that is not known here"));
}

// as people keep them who never had Webots' folders
TEST(ImportRobots, programs_may_lie_beside_the_world) {
  const fs::path top = fs::path(::testing::TempDir()) / ("twinpuck-beside-" + std::to_string(getpid()));
  fs::create_directories(top / "controllers" / "one");
  fs::create_directories(top / "two");
  std::ofstream(top / "controllers" / "one" / "one.py") << "pass\n";
  std::ofstream(top / "two" / "two.c") << "int main() { return 0; }\n";
  std::ofstream(top / "three.py") << "pass\n";
  const auto made = raw(kNew + R"(E-puck { controller "one" }
E-puck { name "b" translation 0 1 0 controller "two" }
E-puck { name "c" translation 0 -1 0 controller "three" }
Robot { name "s" supervisor TRUE controller "three" }
)",
                        top.string());
  fs::remove_all(top);
  const auto world = world_of(made);
  ASSERT_EQ(world.robots.size(), 3u);
  EXPECT_EQ(world.robots[0].firmware, "controllers/one");
  EXPECT_EQ(world.robots[1].firmware, "two");
  EXPECT_EQ(world.robots[2].firmware, "three.py");
  ASSERT_EQ(world.supervisors.size(), 1u);
  EXPECT_EQ(world.supervisors[0].program, "three.py");
}

// braitenberg, obstacle and e-puck are names of ours too
TEST(ImportRobots, a_program_of_ours_never_drives_in_silence) {
  const fs::path top = fs::path(::testing::TempDir()) / ("twinpuck-names-" + std::to_string(getpid()));
  const auto write = [&](const std::string& name, const std::string& file) {
    fs::create_directories(top / "controllers" / name);
    std::ofstream(top / "controllers" / name / file) << "text\n";
  };
  fs::create_directories(top / "worlds");
  write("braitenberg", "braitenberg.py");
  write("obstacle", "obstacle.bsg");
  write("line", "line.cpp");
  write("own", "own.c");
  write("referee", "referee.cpp");
  wbt::Options options;
  options.folder = options.out_folder = (top / "worlds").string();
  options.model = board::epuck_model();
  options.has_firmware = [](const std::string& name) {
    return name == "braitenberg" || name == "obstacle" || name == "e-puck" || name == "own";
  };
  options.has_program = [](const std::string& name) { return name == "rules"; };
  const auto made = wbt::import_world(kNew + R"(E-puck { controller "braitenberg" }
E-puck { name "b" translation 0 1 0 controller "obstacle" }
E-puck { name "c" translation 0 2 0 controller "e-puck" }
E-puck { name "d" translation 0 3 0 controller "line" }
E-puck { name "e" translation 0 4 0 controller "own" }
Robot { name "s" supervisor TRUE controller "referee" }
Robot { name "t" supervisor TRUE controller "rules" controllerArgs [ "fast" ] }
)",
                                      options);
  fs::remove_all(top);
  const auto world = world_of(made);
  ASSERT_EQ(world.robots.size(), 5u);
  EXPECT_EQ(world.robots[0].firmware, "../controllers/braitenberg");
  EXPECT_EQ(world.robots[1].firmware, "");
  EXPECT_TRUE(reports(made, 3, "a BotStudio program; no firmware; firmware/obstacle is another program"));
  EXPECT_EQ(world.robots[2].firmware, "e-puck");
  EXPECT_TRUE(reports(made, 4, "firmware/e-puck has its name and runs in its place"));
  EXPECT_EQ(world.robots[3].firmware, "../controllers/line") << "C++ is run";
  EXPECT_FALSE(reports(made, 5, ""));
  EXPECT_EQ(world.robots[4].firmware, "../controllers/own");
  EXPECT_FALSE(reports(made, 6, ""));
  // supervisors are the PC's programs: C++ is all right, ours have another place
  ASSERT_EQ(world.supervisors.size(), 2u);
  EXPECT_EQ(world.supervisors[0].program, "../controllers/referee");
  EXPECT_TRUE(reports(made, 8, "programs/supervisors/rules has its name and runs in its place"));
  EXPECT_EQ(world.supervisors[1].args, "fast");
}

TEST(ImportRobots, every_slot_is_looked_into) {
  const auto made = raw(kNew + R"(E-puck {
  groundSensorsSlot [
    GPS { name "floor" }
    Group { children [ DistanceSensor { name "gs0" } DistanceSensor { name "gs1" } ] }
    Camera { name "below" }
  ]
  bodySlot [ Lidar { } ]
  newSlot [ Radar { } ]
  children [ Compass { } ]
}
E-puck { name "b" translation 1 0 0 groundSensorsSlot [ Emitter { name "e" } ] }
E-puck { name "c" translation 0 1 0 turretSlot [ DistanceSensor { name "fs0" } RotationalMotor { name "grip motor" } ] }
)");
  const auto world = world_of(made);
  ASSERT_EQ(world.robots.size(), 3u);
  EXPECT_EQ(world.robots[2].parts.size(), 1u) << "floor sensors by their old name";
  ASSERT_EQ(world.robots[2].devices.size(), 1u);
  EXPECT_EQ(world.robots[2].devices[0].kind, sim::DeviceKind::Motor);
  ASSERT_EQ(world.robots[0].parts.size(), 1u);
  EXPECT_EQ(world.robots[0].parts[0].kind, "ground-sensors");
  ASSERT_EQ(world.robots[0].devices.size(), 4u);
  EXPECT_EQ(world.robots[0].devices[0].name, "floor");
  EXPECT_EQ(world.robots[0].devices[1].name, "below");
  EXPECT_EQ(world.robots[0].devices[1].kind, sim::DeviceKind::Camera);
  EXPECT_EQ(world.robots[0].devices[2].name, "lidar");
  EXPECT_EQ(world.robots[0].devices[3].name, "compass");
  EXPECT_TRUE(reports(made, 6, "Camera: not carried"));
  EXPECT_TRUE(reports(made, 9, "Radar: not carried"));
  EXPECT_TRUE(world.robots[1].parts.empty());
  EXPECT_EQ(world.robots[1].devices.size(), 1u);
}

TEST(ImportRobots, what_measures_distances_keeps_its_place_and_way) {
  // half a turn about the upward axis, and a tenth of a metre further
  const auto now = raw(kNew + R"(E-puck { turretSlot [
  Pose { translation 0.01 0 0.02 rotation 0 0 1 1.5708 children [
    DistanceSensor { name "left" translation 0.03 0 0 rotation 0 0 1 1.5708
      lookupTable [ 0 10 0 0.4 2 0.1 ] numberOfRays 3 aperture 0.5 } ] }
  RangeFinder { width 32 height 8 fieldOfView 1 minRange 0.05 maxRange 2 }
  RobotisLds01 { translation 0 0 0.02 }
  SharpGP2D120 { name "front" }
] })");
  const auto world = world_of(now);
  ASSERT_EQ(world.robots.size(), 1u);
  const auto& d = world.robots[0].devices;
  ASSERT_EQ(d.size(), 6u) << now.toml;
  EXPECT_EQ(d[0].kind, sim::DeviceKind::Distance);
  EXPECT_NEAR(d[0].at_m.x, -0.0095 + 0.01, 1e-4);
  EXPECT_NEAR(d[0].at_m.y, 0.03, 1e-4);
  EXPECT_NEAR(d[0].at_m.z, 0.0486 + 0.02, 1e-4);
  EXPECT_NEAR(std::abs(d[0].heading_rad), sim::kPi, 1e-3);
  ASSERT_EQ(d[0].table.size(), 2u);
  EXPECT_EQ(d[0].table[1].value, 2);
  EXPECT_EQ(d[0].rays, 3);
  EXPECT_NEAR(d[0].aperture_rad, 0.5, 1e-6);
  EXPECT_EQ(d[1].kind, sim::DeviceKind::RangeFinder);
  EXPECT_EQ(d[1].width * 100 + d[1].height, 3208);
  EXPECT_NEAR(d[1].near_m, 0.05, 1e-9);
  EXPECT_NEAR(d[1].far_m, 2, 1e-9);
  EXPECT_EQ(d[2].name, "LDS-01");
  EXPECT_EQ(d[2].width * 100 + d[2].height, 36001);
  EXPECT_NEAR(d[2].far_m, 3.5, 1e-9);
  EXPECT_EQ(d[3].name, "LDS-01_main_motor");
  EXPECT_EQ(d[5].name, "front");
  EXPECT_EQ(d[5].table.size(), 18u);

  // before R2022 a beam goes along x, to the right, and a lidar looks along -z, ahead
  const auto old = raw("#VRML_SIM R2020a utf8\n" + std::string(R"(E-puck { turretSlot [
  DistanceSensor { translation 0.01 0.02 -0.03 }
  Lidar { }
] })"));
  const auto before = world_of(old);
  ASSERT_EQ(before.robots.size(), 1u);
  const auto& o = before.robots[0].devices;
  ASSERT_EQ(o.size(), 2u) << old.toml;
  EXPECT_NEAR(o[0].heading_rad, -sim::kPi / 2, 1e-3);
  EXPECT_NEAR(o[0].at_m.x, 0.03 - 0.0095, 1e-4);
  EXPECT_NEAR(o[0].at_m.y, -0.01, 1e-4);
  EXPECT_NEAR(o[0].at_m.z, 0.0486 + 0.02, 1e-4);
  EXPECT_NEAR(o[1].heading_rad, 0, 1e-3);
}

TEST(ImportRobots, a_proto_of_the_project_brings_its_controller_and_sensors) {
  const auto made = raw(kNew + R"(PROTO EPuckMine [
  field SFVec3f translation 0 0 0
  field SFString controller "from_proto"
  field MFNode turretSlot [ ]
] { Robot {
  translation IS translation
  controller IS controller
  controllerArgs [ "a" ]
  children [
    DistanceSensor { name "ps3" lookupTable [ 0 100 0 0.1 50 0 ] }
    LightSensor { name "ls0" lookupTable [ 0 4095 0 1 0 0 ] }
    LightSensor { name "ls1" lookupTable [ 0 4095 0 1 0 0 ] }
    Gyro { }
    Group { children IS turretSlot }
  ]
} }
EPuckMine { turretSlot [ GPS { } ] }
EPuckMine { translation 1 0 0 controller "own" }
PROTO EPuckScript [ field SFString controller "scripted" ] { %{ local x = 1 }% Robot { controller IS controller } }
EPuckScript { }
)");
  const auto world = world_of(made);
  ASSERT_EQ(world.robots.size(), 3u) << made.toml;
  EXPECT_EQ(world.robots[0].firmware, "from_proto");
  EXPECT_EQ(world.robots[1].firmware, "own");
  EXPECT_EQ(world.robots[2].firmware, "scripted");
  ASSERT_EQ(world.robots[0].sensors.size(), 1u);
  EXPECT_EQ(world.robots[0].sensors[0].index, 3);
  ASSERT_EQ(world.robots[0].devices.size(), 2u);
  EXPECT_EQ(world.robots[0].devices[0].name, "gps");
  EXPECT_EQ(world.robots[0].devices[1].name, "gyro");
  EXPECT_TRUE(reports(made, 0, "LightSensor.lookupTable: not carried: tables of light sensors"));
  EXPECT_EQ(world.robots[0].args, "a");
  EXPECT_TRUE(reports(made, 0, "the script of its PROTO"));
}

TEST(ImportRobots, devices_of_a_proto_with_a_script_stand_in_its_text) {
  const auto made = raw(
      kNew +
      R"(PROTO MyLight [ field SFInt32 id 1 ] { LightSensor { name %{= "\"ls" .. fields.id.value .. "\"" }% } }
PROTO EPuckTwo [
  field SFString version "1"
  field MFNode turretSlot [ ]
] {
%<
  const v2 = fields.version.value == '2';
>%
Robot {
  supervisor TRUE
  children [
    RotationalMotor {
      name "left wheel motor"
      %< if (v2) { >%
        maxVelocity 7
      %< } else { >%
        maxVelocity 6
      %< } >%
    }
    %< if (v2) { >%
    GPS { name "mine" translation 0 %<= 2 * height >% 0 }
    Gyro { name "gyro" }
    %< } >%
    LightSensor { name "ls0" }
    MyLight { id 8 }
    TouchSensor { name %<= '"v' + fields.version.value + '_bump"' >% }
    Group { children IS turretSlot }
  ]
} }
PROTO EPuckOnTop [ field MFNode turretSlot [ ] ] {
  %{ io.stderr:write("old") }%
  EPuckTwo { turretSlot [ Compass { } Group { children IS turretSlot } ] }
}
EPuckTwo { }
EPuckOnTop { translation 1 0 0 }
)");
  const auto world = world_of(made);
  ASSERT_EQ(world.robots.size(), 2u) << made.toml;
  EXPECT_TRUE(world.robots[0].supervisor);
  const auto names = [&](int robot) {
    std::string all;
    for (const sim::DeviceDesc& d : world.robots[static_cast<std::size_t>(robot)].devices)
      all += d.name + ";";
    return all;
  };
  EXPECT_EQ(names(0), "mine;ls8;v1_bump;") << "each e-puck has a gyroscope and eight light sensors";
  EXPECT_EQ(names(1), "compass;mine;ls8;v1_bump;");
}

TEST(ImportRobots, supervisors_keep_their_devices_and_words) {
  const auto made = raw(kNew + R"(RectangleArena { floorSize 3 3 }
DEF BOSS Robot {
  name "boss"
  controller "<extern>"
  supervisor TRUE
  customData "round 1"
  controllerArgs [ "fast" "two words" "it's" "" ]
  children [
    Emitter { channel 5 range 2 }
    Receiver { name "ears" channel -1 }
    Group { children [ Display { name "score" width 200 height 100 } ] }
    HingeJoint { device [ RotationalMotor { name "wheel motor" } PositionSensor { name "angle" } ] }
    Camera { width 320 height 240 }
  ]
}
E-puck { supervisor TRUE controller "a" controllerArgs [ "one" ] customData "me" recognitionColors [ 1 0 0, 0 0 1 ] }
Robot { name "plain" }
)");
  const auto world = world_of(made);
  ASSERT_EQ(world.supervisors.size(), 1u) << made.toml;
  const sim::SupervisorDesc& s = world.supervisors[0];
  EXPECT_EQ(s.program, "<extern>");
  EXPECT_EQ(s.def, "BOSS");
  EXPECT_EQ(s.custom_data, "round 1");
  EXPECT_EQ(sim::argument_words(s.args), (std::vector<std::string>{"fast", "two words", "it's", ""}));
  ASSERT_EQ(s.devices.size(), 6u);
  EXPECT_EQ(s.devices[0].name, "emitter");
  EXPECT_EQ(s.devices[0].kind, sim::DeviceKind::Emitter);
  EXPECT_EQ(s.devices[0].channel, 5);
  EXPECT_EQ(s.devices[0].range_m, 2);
  EXPECT_EQ(s.devices[1].name, "ears");
  EXPECT_EQ(s.devices[1].channel, -1);
  EXPECT_EQ(s.devices[2].kind, sim::DeviceKind::Display);
  EXPECT_EQ(s.devices[2].width, 200);
  EXPECT_EQ(s.devices[2].height, 100);
  EXPECT_EQ(s.devices[3].kind, sim::DeviceKind::Motor);
  EXPECT_EQ(s.devices[4].kind, sim::DeviceKind::Position);
  EXPECT_EQ(s.devices[5].kind, sim::DeviceKind::Camera);
  EXPECT_TRUE(reports(made, 3, "its motors move"));
  EXPECT_TRUE(reports(made, 14, "what this sensor measures"));
  ASSERT_EQ(world.robots.size(), 1u);
  EXPECT_TRUE(world.robots[0].supervisor);
  EXPECT_EQ(world.robots[0].args, "one");
  EXPECT_EQ(world.robots[0].custom_data, "me");
  ASSERT_EQ(world.robots[0].recognition_colours.size(), 2u);
  EXPECT_EQ(world.robots[0].recognition_colours[1].b, 1);
}

// until R2020a a world had one text, which became several words
TEST(ImportRobots, old_arguments_are_a_line_of_words) {
  const auto made = raw("#VRML_SIM R2019a utf8\nE-puck { controller \"a\" controllerArgs \"fast 3\" }\n");
  EXPECT_EQ(sim::argument_words(world_of(made).robots[0].args), (std::vector<std::string>{"fast", "3"}));
  const auto now = raw(kNew + "E-puck { controller \"a\" controllerArgs \"fast 3\" }\n");
  EXPECT_EQ(sim::argument_words(world_of(now).robots[0].args), (std::vector<std::string>{"fast 3"}));
}

// supervisors find nodes by the file's own lines
TEST(ImportRobots, what_stands_there_knows_its_node) {
  const fs::path top = fs::path(::testing::TempDir()) / ("twinpuck-node-" + std::to_string(getpid()));
  fs::create_directories(top);
  wbt::Options options;
  options.file = "w.wbt";
  options.folder = options.out_folder = top.string();
  options.model = board::epuck_model();
  const auto made =
      wbt::import_world(kNew + R"(Solid { translation 0 0 0.1 boundingObject Box { size 2 2 0.2 } }
E-puck { translation 0 0 0.2 }
Solid {
  translation 0.5 0 0.25 boundingObject Box { size 0.1 0.1 0.1 } recognitionColors [ 0 1 0 ] model "gate" }
PointLight { location 0 0 2 }
Robot { controller "x" supervisor TRUE }
)",
                        options);
  fs::remove_all(top);
  const auto world = world_of(made);
  EXPECT_EQ(world.webots.world, "w.wbt");
  EXPECT_NEAR(world.webots.floor_m, 0.2, 1e-9);
  ASSERT_EQ(world.robots.size(), 1u);
  EXPECT_EQ(world.robots[0].node, 3);
  ASSERT_EQ(world.objects.size(), 1u);
  EXPECT_EQ(world.objects[0].node, 4);
  EXPECT_EQ(world.objects[0].model, "gate");
  ASSERT_EQ(world.objects[0].recognition_colours.size(), 1u);
  ASSERT_EQ(world.lamps.size(), 1u);
  EXPECT_EQ(world.lamps[0].node, 6);
  ASSERT_EQ(world.supervisors.size(), 1u);
  EXPECT_EQ(world.supervisors[0].node, 7);
}

TEST(ImportRobots, hundreds_on_one_spot_find_room_or_go) {
  std::string text = kNew + "RectangleArena { floorSize 2 2 }\n";
  for (int i = 0; i < 300; ++i) text += "E-puck { name \"r" + std::to_string(i) + "\" }\n";
  EXPECT_EQ(world_of(raw(text)).robots.size(), 41u);  // kMostRepairs, and the one that stays
}

TEST(ImportRobots, without_firmware_no_controller_is_named) {
  wbt::Options options;
  options.without_firmware = true;
  options.model = board::epuck_model();
  const auto made = wbt::import_world(kNew + "E-puck { controller \"mine\" }\n", options);
  EXPECT_NE(made.toml.find("firmware = \"\""), std::string::npos);
}

TEST(ImportErrors, name_their_place) {
  const struct {
    std::string text;
    int line, column;
    const char* says;
  } kBad[] = {
      {"<!doctype html>", 1, 1,
       "got another first line, expected `#VRML_SIM`, a version such as V6.0 or R2023b, and `utf8`"},
      {"", 1, 1,
       "got another first line, expected `#VRML_SIM`, a version such as V6.0 or R2023b, and `utf8`"},
      {kNew + "Solid {\n  translation 0 0\n", 4, 1,
       "got the end of the file, expected the name of a field, or '}'"},
      {kNew + "Solid {\n  name \"open\n}", 3, 8,
       "got the end of the file, expected a text that ends in a quote"},
      {kNew + "Solid {\n  size ]\n}", 3, 8, "got ']', expected a value"},
      {kNew + "{ }", 2, 1, "got '{', expected a node such as `Solid {`"},
      {kNew + "Solid 3", 2, 7, "got '3', expected '{' behind the type of a node"},
  };
  for (const auto& b : kBad) {
    const auto made = raw(b.text);
    ASSERT_EQ(made.errors.size(), 1u) << b.text;
    EXPECT_EQ(made.errors[0].line, b.line) << b.text;
    EXPECT_EQ(made.errors[0].column, b.column) << b.text;
    EXPECT_EQ(made.errors[0].text, b.says) << b.text;
    EXPECT_TRUE(made.toml.empty());
  }
}

TEST(ImportErrors, hostile_worlds_end_soon) {
  // nodes without end
  std::string deep = kNew;
  for (int i = 0; i < 100000; ++i) deep += "Group { children [ ";
  EXPECT_EQ(raw(deep).errors.size(), 1u);
  // forty doublings by USE: a million million shapes
  std::string laughs = kNew + "DEF A0 Shape { geometry Box { size 0.1 0.1 0.1 } }\n";
  for (int i = 1; i <= 40; ++i) {
    const std::string before = "USE A" + std::to_string(i - 1);
    laughs += "DEF A" + std::to_string(i) + " Group { children [ " + before + " " + before + " ] }\n";
  }
  EXPECT_TRUE(raw(laughs).errors.empty());
  // a PROTO that is made of itself twice
  EXPECT_TRUE(raw(kNew + "PROTO P [ ] { Group { children [ P { } P { } ] } }\nP { }\n").errors.empty());
  // numbers that are none
  world_of(raw(kNew + "Solid { translation 1e300 -1e300 1e9 boundingObject Box { size 1e300 0 -1 } }\nE-puck "
                      "{ translation 1e99 0 0 }\n"
                      "PointLight { location 1e30 0 0 }\nRectangleArena { floorSize -1 1e20 }\n"));
}

}  // namespace
