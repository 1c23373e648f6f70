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

struct Mistake {
  const char* text;
  const char* expected;
};

class WrongWebotsKeys : public ::testing::TestWithParam<Mistake> {};

TEST_P(WrongWebotsKeys, are_named_with_their_line) {
  const auto loaded = parse(GetParam().text);
  EXPECT_FALSE(loaded.world);
  EXPECT_NE(loaded.report("w.toml").find(GetParam().expected), std::string::npos) << loaded.report("w.toml");
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, WrongWebotsKeys,
    ::testing::Values(
        Mistake{"[webots]\nsensor_order = \"labs\"\n", "w.toml:3:16: webots.sensor_order: got \"labs\""},
        Mistake{"[webots]\ntime_step = 32\n", "webots.time_step: got 32"},
        Mistake{"[webots]\nspeedunit = 0.1\n",
                "unknown key 'speedunit' in webots; did you mean 'speed_unit'?"},
        Mistake{"[[robot]]\nposition = [0, 0]\n[[robot.device]]\nkind = \"gps\"\n",
                "robot.device.name: missing"},
        Mistake{"[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"a\"\nkind = \"radar\"\n",
                "robot.device.kind: got \"radar\""},
        Mistake{"[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"a\"\nkind = \"emitter\"\nrange = "
                "-0.5\n",
                "got -0.5 m"},
        Mistake{"[[robot]]\nposition = [0, 0]\n[[robot.device]]\nname = \"a\"\nkind = "
                "\"gps\"\n[[robot.device]]\nname = "
                "\"a\"\nkind = \"compass\"\n",
                "got \"a\" a second time"}));

}  // namespace
