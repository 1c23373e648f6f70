// SPDX-License-Identifier: MIT
// [webots] and [[robot.device]]: values, defaults, and what is wrong with the rest.
#include <gtest/gtest.h>

#include "tests/sim_core/fixture.h"

namespace {

sim::LoadedWorld parse(const std::string& text) {
  return sim::parse_world("twinpuck = 1\n" + text, "w.toml", {sim_test::puck()}, {});
}

TEST(WebotsKeys, without_them_a_world_has_the_usual_settings) {
  const auto loaded = parse("[[robot]]\nposition = [0, 0]\n");
  ASSERT_TRUE(loaded.world) << loaded.report("w.toml");
  const sim::WebotsDesc& webots = loaded.world->webots;
  EXPECT_DOUBLE_EQ(webots.time_step_s, 0.032);
  EXPECT_LT(webots.speed_unit_rad_s, 0);
  EXPECT_NE(webots.sensor_order, "lab");
  EXPECT_EQ(webots.axes, sim::Axes::Enu);
  EXPECT_TRUE(loaded.world->robots[0].devices.empty());
}

TEST(WebotsKeys, every_key_arrives) {
  const auto loaded = parse(
      "[webots]\ntime_step = 0.016\nspeed_unit = 0.1\nsensor_order = \"lab\"\naxes = \"nue\"\n"
      "[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"gps\"\nkind = \"gps\"\n"
      "[[robot.device]]\nname = \"ir\"\nkind = \"emitter\"\nchannel = 3\nrange = 0.5\nbaud_rate = "
      "9600\ninfra_red = "
      "true\n");
  ASSERT_TRUE(loaded.world) << loaded.report("w.toml");
  EXPECT_DOUBLE_EQ(loaded.world->webots.time_step_s, 0.016);
  EXPECT_DOUBLE_EQ(loaded.world->webots.speed_unit_rad_s, 0.1);
  EXPECT_EQ(loaded.world->webots.sensor_order, "lab");
  EXPECT_EQ(loaded.world->webots.axes, sim::Axes::Nue);
  const auto& devices = loaded.world->robots[0].devices;
  ASSERT_EQ(devices.size(), 2u);
  EXPECT_EQ(devices[0].kind, sim::DeviceKind::Gps);
  EXPECT_EQ(devices[1].kind, sim::DeviceKind::Emitter);
  EXPECT_EQ(devices[1].channel, 3);
  EXPECT_DOUBLE_EQ(devices[1].range_m, 0.5);
  EXPECT_DOUBLE_EQ(devices[1].baud_rate_bit_s, 9600);
  EXPECT_TRUE(devices[1].infra_red);
}

TEST(WebotsKeys, supervisors_have_devices_and_robots_may_supervise) {
  const auto loaded = parse(
      "[webots]\nworld = \"a.wbt\"\nfloor = 0.3\n"
      "[[box]]\nposition = [1, 1]\nmodel = \"gate\"\nrecognition_colours = [[1, 0, 0], [0, 0.5, 1]]\nnode = "
      "12\n"
      "[[lamp]]\nposition = [0, 0, 1]\nnode = 3\n"
      "[[robot]]\nposition = [0, 0]\nargs = \"fast 'two words'\"\nsupervisor = true\ncustom_data = \"me\"\n"
      "recognition_colours = [[0, 1, 0]]\nnode = 9\n"
      "[[supervisor]]\nprogram = \"<extern>\"\ndef = \"BOSS\"\ncustom_data = \"hi\"\nnode = 4\n"
      "[[supervisor.device]]\nname = \"e\"\nkind = \"emitter\"\nchannel = 2\nrange = 1.5\n"
      "[[supervisor.device]]\nname = \"m\"\nkind = \"motor\"\n");
  ASSERT_TRUE(loaded.world) << loaded.report("w.toml");
  const sim::WorldDesc& w = *loaded.world;
  EXPECT_EQ(w.webots.world, "a.wbt");
  EXPECT_DOUBLE_EQ(w.webots.floor_m, 0.3);
  EXPECT_EQ(w.objects[0].model, "gate");
  ASSERT_EQ(w.objects[0].recognition_colours.size(), 2u);
  EXPECT_DOUBLE_EQ(w.objects[0].recognition_colours[1].g, 0.5);
  EXPECT_EQ(w.objects[0].node, 12);
  EXPECT_EQ(w.lamps[0].node, 3);
  EXPECT_TRUE(w.robots[0].supervisor);
  EXPECT_EQ(sim::argument_words(w.robots[0].args), (std::vector<std::string>{"fast", "two words"}));
  EXPECT_EQ(w.robots[0].custom_data, "me");
  EXPECT_EQ(w.robots[0].recognition_colours.size(), 1u);
  EXPECT_EQ(w.robots[0].node, 9);
  const sim::SupervisorDesc& s = w.supervisors[0];
  EXPECT_EQ(s.def, "BOSS");
  EXPECT_EQ(s.custom_data, "hi");
  EXPECT_EQ(s.node, 4);
  ASSERT_EQ(s.devices.size(), 2u);
  EXPECT_EQ(s.devices[0].channel, 2);
  EXPECT_DOUBLE_EQ(s.devices[0].range_m, 1.5);
  EXPECT_EQ(s.devices[1].kind, sim::DeviceKind::Motor);
}

TEST(WebotsKeys, a_lidar_is_a_row_and_a_range_finder_a_picture) {
  const auto loaded = parse(
      "[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"l\"\nkind = \"lidar\"\nwidth = 4096\n"
      "[[robot.device]]\nname = \"m\"\nkind = \"lidar\"\nwidth = 3000\nheight = 4\n"
      "[[robot.device]]\nname = \"r\"\nkind = \"range-finder\"\n");
  ASSERT_TRUE(loaded.world) << loaded.report("w.toml");
  const auto& devices = loaded.world->robots[0].devices;
  EXPECT_EQ(devices[0].height, 1);
  EXPECT_EQ(devices[1].height, 4);
  EXPECT_EQ(devices[2].width, 128);
  EXPECT_EQ(devices[2].height, 64);
}

TEST(WebotsKeys, words_stand_between_blanks_or_in_quotes) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(sim::argument_words(""), Words{});
  EXPECT_EQ(sim::argument_words("  a  b\t"), (Words{"a", "b"}));
  EXPECT_EQ(sim::argument_words("'' \"it's\" x'y z'"), (Words{"", "it's", "xy z"}));
  EXPECT_EQ(sim::argument_words("'open"), Words{"open"});
}

struct Mistake {
  std::string text;
  std::string expected;  // all that is said, behind the file's name
};

class WrongWebotsKeys : public ::testing::TestWithParam<Mistake> {};

TEST_P(WrongWebotsKeys, are_named_with_their_line) {
  const auto loaded = parse(GetParam().text);
  EXPECT_FALSE(loaded.world);
  EXPECT_EQ(loaded.report("w.toml"), "w.toml:" + GetParam().expected);
}

constexpr const char* kKinds =
    "gps, compass, inertial, gyro, emitter, receiver, distance, display, motor, camera, touch, light, led, "
    "speaker, pen, "
    "lidar, range-finder, position";
constexpr const char* kColours = "list of colours [[red, green, blue], ...] from 0 to 1";
const std::string kDevice = "[[robot]]\nposition = [0, 0]\n[[robot.device]]\n";
const std::string kOfSupervisor = "[[supervisor]]\nprogram = \"p\"\n[[supervisor.device]]\nname = \"a\"\n";
const std::string kBox = "[[box]]\nposition = [0, 0]\n";

INSTANTIATE_TEST_SUITE_P(
    Mistakes, WrongWebotsKeys,
    ::testing::Values(
        Mistake{"[webots]\nsensor_order = \"labs\"\n",
                "3:16: webots.sensor_order: got \"labs\", expected one of product, lab; did you mean 'lab'?"},
        Mistake{"[webots]\ntime_step = 32\n",
                "3:13: webots.time_step: got 32, expected number from 0.001 to 10 s"},
        Mistake{"[webots]\nspeedunit = 0.1\n",
                "3:1: unknown key 'speedunit' in webots; did you mean 'speed_unit'? (keys: time_step, "
                "speed_unit, "
                "sensor_order, axes, world, floor)"},
        Mistake{kDevice + "kind = \"gps\"\n", "4:1: robot.device.name: missing, expected text in quotes"},
        Mistake{kDevice + "name = \"a\"\nkind = \"radar\"\n",
                std::string("6:8: robot.device.kind: got \"radar\", expected one of ") + kKinds},
        Mistake{kDevice + "name = \"a\"\nkind = \"emitter\"\nrange = -0.5\n",
                "7:9: robot.device.range: got -0.5 m, expected -1 (unlimited), or 0 and above"},
        Mistake{
            kDevice + "name = \"a\"\nkind = \"gps\"\n[[robot.device]]\nname = \"a\"\nkind = \"compass\"\n",
            "7:1: robot.device.name: got \"a\" a second time, expected each device once"},
        Mistake{
            kDevice + "name = \"a\"\nkind = \"lidar\"\nwidth = 512\nheight = 64\n",
            "7:9: robot.device.width: got 512 columns and 64 rows, 32768 distances, expected at most 12000"},
        Mistake{
            kDevice + "name = \"a\"\nkind = \"range-finder\"\nheight = 94\n",
            "7:10: robot.device.width: got 128 columns and 94 rows, 12032 distances, expected at most 12000"},
        Mistake{kOfSupervisor + "kind = \"wing\"\n",
                std::string("6:8: supervisor.device.kind: got \"wing\", expected one of ") + kKinds},
        Mistake{kOfSupervisor + "kind = \"gps\"\n[[supervisor.device]]\nname = \"a\"\nkind = \"gps\"\n",
                "7:1: supervisor.device.name: got \"a\" a second time, expected each device once"},
        Mistake{kBox + "recognition_colours = [1, 0, 0]\n",
                std::string("4:23: box.recognition_colours: got [1, 0, 0], expected ") + kColours},
        Mistake{kBox + "recognition_colours = [[1, 0, 2]]\n",
                std::string("4:23: box.recognition_colours: got [[1, 0, 2]], expected ") + kColours}));

}  // namespace
