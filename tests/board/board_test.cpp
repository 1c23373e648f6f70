// SPDX-License-Identifier: MIT
// The board as a whole: pins, LEDs, selector, battery, resets, a thousand of them.
#include "hal_sim/board/board.h"

#include <gtest/gtest.h>

#include "tests/board/flat_scene.h"

namespace {

using board::Board;
using board::Cycle;
using board::Wheel;
using Register = board::Pins::Register;

constexpr Cycle kSecond = 14'745'600;
TEST(Pins, reset_leaves_inputs_and_no_light) {
  Board robot{board::Setup{}};
  EXPECT_EQ(robot.pins().read('D', Register::Tris, 0), 0xFFFF);
  EXPECT_EQ(robot.pins().read('A', Register::Tris, 0), 0xF6C0);
  EXPECT_EQ(robot.pins().read('C', Register::Tris, 0), 0xE01E);
  EXPECT_EQ(robot.pins().read('F', Register::Tris, 0), 0x01FF);
  EXPECT_EQ(robot.pins().read('G', Register::Tris, 0), 0xF3CF);
  robot.pins().write('A', Register::Lat, 0xFFFF, 0);
  EXPECT_EQ(robot.pins().leds(0), 0u);  // latches set, pins not driven
  EXPECT_EQ(robot.pins().read('E', Register::Port, 0), 0);
}

TEST(Pins, leds_sit_on_their_pins) {
  Board robot{board::Setup{}};
  robot.pins().init(0);
  const int bits[8] = {6, 7, 9, 12, 10, 13, 14, 15};
  for (int led = 0; led < 8; ++led) {
    robot.pins().write('A', Register::Lat, static_cast<std::uint16_t>(1u << bits[led]), 0);
    EXPECT_EQ(robot.pins().leds(0), 1u << led);
  }
  robot.pins().write('A', Register::Lat, 0, 0);
  robot.pins().write_bit('C', 2, true, 0);
  EXPECT_EQ(robot.pins().leds(0), 1u << 8);
  robot.pins().write_bit('C', 1, true, 0);
  EXPECT_EQ(robot.pins().leds(0), 3u << 8);
  EXPECT_EQ(robot.pins().read('C', Register::Lat, 0) & 6u, 6u);
  robot.pins().init(0);
  EXPECT_EQ(robot.pins().leds(0), 0u);
}

TEST(Pins, selector_battery_and_remote_are_inputs) {
  board::Setup setup;
  setup.selector = 11;
  setup.battery_v = 3.5;
  Board robot(setup);
  EXPECT_EQ(robot.pins().read('G', Register::Port, 0) >> 6 & 15, 11);
  EXPECT_EQ(robot.pins().read('F', Register::Port, 0) >> 1 & 1, 1);  // battery good
  EXPECT_EQ(robot.pins().read('F', Register::Port, 0) >> 6 & 1, 1);  // remote receiver idle
  robot.power().set_voltage(3.3, 0);
  robot.turn_selector(4);
  EXPECT_EQ(robot.pins().read('F', Register::Port, 0) >> 1 & 1, 0);
  EXPECT_EQ(robot.pins().read('G', Register::Port, 0) >> 6 & 15, 4);
}

TEST(Pins, battery_is_measured_on_revision_1_3_only) {
  board::Setup setup;
  setup.battery_v = 4.2;
  setup.motion_noise_scale = 0;
  EXPECT_EQ(Board(setup).convert(board::kBatteryChannel, 0), 2816);  // upwards: 2048 + 768
  setup.revision = board::Revision::Rev13;
  EXPECT_EQ(Board(setup).convert(board::kBatteryChannel, 0), 2560);
  setup.battery_v = 3.4;
  EXPECT_EQ(Board(setup).convert(board::kBatteryChannel, 0), 2070);
}

TEST(Pins, coils_written_directly_turn_the_wheels) {
  Board robot{board::Setup{}};
  robot.pins().write('D', Register::Tris, 0xFF00, 0);
  // right wheel phases 0 1 2 3 on bits 4 to 7, left wheel 0 3 2 1 on bits 0 to 3: both forward
  const unsigned pattern[4] = {0xA, 0x6, 0x5, 0x9};
  for (int n = 0; n <= 8; ++n)
    robot.pins().write('D', Register::Lat, static_cast<std::uint16_t>(pattern[n & 3] << 4 | pattern[-n & 3]),
                       n * 15000);
  EXPECT_EQ(robot.motors().left_steps(kSecond), 8);
  EXPECT_EQ(robot.motors().right_steps(kSecond), 8);
  EXPECT_EQ(robot.pins().read('D', Register::Lat, kSecond), 0xA0 | 0xA);
  EXPECT_DOUBLE_EQ(robot.motors().angle_rad(Wheel::Left, kSecond), 8 * 2 * 3.14159265358979323846 / 1000);
}

TEST(Converter, programs_may_flash_and_sample_themselves) {
  sim::Scene scene;
  scene.reflection = [](int, sim::Clicks) { return 1000.0; };
  Board robot{board::Setup{}};
  robot.look_at(&scene);
  robot.pins().init(0);
  EXPECT_EQ(robot.convert(8, 1000), 4095);
  robot.pins().write_bit('F', 7, true, 2000);  // emitter of sensors 0 and 4
  EXPECT_EQ(robot.convert(8, 2000 + 5000), 3095);
  EXPECT_EQ(robot.convert(12, 2000 + 5000), 3095);
  EXPECT_EQ(robot.convert(9, 2000 + 5000), 4095);
  robot.pins().write_bit('F', 7, false, 8000);
  EXPECT_EQ(robot.convert(8, 8001), 4095);
  EXPECT_EQ(robot.convert(16, 8001), 0);
}

TEST(Board, readings_without_a_driver_are_noise_free) {
  sim::Scene scene;
  scene.reflection = [](int sensor, sim::Clicks) { return 100.0 * sensor; };
  scene.relative_noise = 0.5;
  Board robot{board::Setup{}};
  EXPECT_EQ(robot.proximity_counts(3, 0), 0);
  robot.look_at(&scene);
  EXPECT_EQ(robot.proximity_counts(3, 0), 300);
}

}  // namespace
