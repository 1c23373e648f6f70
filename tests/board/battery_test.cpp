// SPDX-License-Identifier: MIT
// Battery: discharge curve, sag, energy, the low-battery detector, what the robot draws.
#include "hal_sim/board/battery.h"

#include <gtest/gtest.h>

#include "hal_sim/board/board.h"

namespace {

using board::Battery;
using board::Board;
using board::Cycle;
using board::Wheel;
using Register = board::Pins::Register;

constexpr Cycle kSecond = board::kFcyHz;
constexpr double kIdleA = 0.050 + 0.060 + 0.020;  // processor, Bluetooth, board: battery_params.h

TEST(Battery, curve_is_linear_between_its_points_both_ways) {
  EXPECT_DOUBLE_EQ(Battery::rest_v(1), 4.2);
  EXPECT_DOUBLE_EQ(Battery::rest_v(0), 3.0);
  EXPECT_DOUBLE_EQ(Battery::rest_v(0.5), 3.82);
  EXPECT_NEAR(Battery::rest_v(0.95), 4.13, 1e-12);    // half-way from 4.06 to 4.20
  EXPECT_NEAR(Battery::rest_v(0.025), 3.225, 1e-12);  // half-way from 3.00 to 3.45
  EXPECT_NEAR(Battery::charge_at(4.13), 0.95, 1e-12);
  EXPECT_NEAR(Battery::charge_at(3.4), 0.05 * 0.4 / 0.45, 1e-12);
  for (double charge = -0.02; charge < 1.05; charge += 0.01)
    EXPECT_NEAR(Battery::charge_at(Battery::rest_v(charge)), charge, 1e-9);
}

// 0.2 ohm: 0.5 A more is 0.1 V less, at once
TEST(Battery, sags_under_load) {
  Battery battery(5, 4.0, 0.1);
  EXPECT_NEAR(battery.voltage(0), 4.0, 1e-12);
  battery.draw(0.6, 10);
  EXPECT_NEAR(battery.voltage(10), 3.9, 1e-5);
  battery.draw(0.1, 20);
  EXPECT_NEAR(battery.voltage(20), 4.0, 1e-5);
}

// a battery without load from 4.2 V to 3.0 V: all of its 5 Wh, less what the inner resistance turns to heat
TEST(Battery, gives_its_energy_once) {
  const double amps = 0.1;
  Battery battery(5, 4.2 - amps * 0.2, amps);
  EXPECT_NEAR(battery.charge(0), 1, 1e-12);
  // the curve's mean is 3.8285 V (trapezoids), so 5 Wh are 1.30600 Ah
  const Cycle empty = static_cast<Cycle>(1.30600 / amps * 3600 * kSecond);
  EXPECT_NEAR(battery.charge(empty), 0, 1e-4);
  for (int i = 1; i <= 1000; ++i) battery.draw(i % 2 ? amps * 1.0001 : amps, empty / 1000 * i);
  EXPECT_NEAR(battery.used_wh(empty), 5 - 1.306 * amps * 0.2, 0.005);
  EXPECT_NEAR(battery.minutes_left(empty / 2), 0.5 * 1.306 / amps * 60, 0.5);
}

TEST(Battery, what_was_used_does_not_depend_on_how_often_it_was_asked) {
  Battery asked(5, 4.0, 0.3), silent(5, 4.0, 0.3);
  for (Cycle at = 0; at < 100 * kSecond; at += kSecond) (void)asked.used_wh(at);
  EXPECT_EQ(asked.used_wh(100 * kSecond), silent.used_wh(100 * kSecond));
  // 100 s of 0.3 A at 4.0 V: 120 J, and some microvolts' fall
  EXPECT_NEAR(silent.used_wh(100 * kSecond) * 3600, 120, 0.1);
}

TEST(Battery, tells_the_cycle_at_which_it_falls_below_a_voltage) {
  Battery battery(0.01, 3.5, 0.2);
  const Cycle low = battery.below(3.4, 0);
  ASSERT_LT(low, board::kNever);
  EXPECT_GE(battery.voltage(low - 1), 3.4);
  EXPECT_LT(battery.voltage(low), 3.4);
  // rest voltages 3.54 and 3.44 V: charges 0.05 + 0.05 * 0.09 / 0.23 and 0.05 * 0.44 / 0.45
  const double charge = 0.05 + 0.05 * 0.09 / 0.23 - 0.05 * 0.44 / 0.45;
  const double seconds = charge * 0.01 / 3.8285 * 3600 / 0.2;
  EXPECT_NEAR(static_cast<double>(low) / kSecond, seconds, seconds * 1e-3);
  EXPECT_EQ(battery.below(3.6, 0), board::kNever);  // is already
}

// to the cycle, from anywhere and however near
TEST(Battery, falls_below_a_voltage_in_that_cycle_and_not_before) {
  std::uint64_t state = 1;
  const auto draw = [&state](double least, double most) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return least + (most - least) * static_cast<double>(state >> 40) / (1 << 24);
  };
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    Battery battery(draw(0.001, 5), draw(3.2, 4.1), draw(0.01, 2));
    const auto from = static_cast<Cycle>(draw(0, 20 * kSecond));
    const double now = battery.voltage(from), volts = i % 2 ? draw(3.1, 4.0) : now - draw(0, 1e-9);
    if (now < 3.1 || now < volts) continue;  // it is empty, or is below already
    const Cycle low = battery.below(volts, from);
    ++found;
    ASSERT_GT(low, from) << i;
    EXPECT_LT(battery.voltage(low), volts) << i;
    EXPECT_GE(battery.voltage(low - 1), volts) << i;
  }
  EXPECT_GT(found, 1000);
  // empty it has nothing, and no less
  Battery empty(0.001, 3.5, 2);
  EXPECT_LT(empty.below(0.01, 0), board::kNever);
  EXPECT_EQ(empty.below(0, 0), board::kNever);
  EXPECT_EQ(empty.below(-1, 3600 * kSecond), board::kNever);
}

// --- what draws

TEST(Power, starts_with_the_electronics_and_the_voltage_that_was_asked_for) {
  board::Setup setup;
  setup.battery_v = 3.7;
  Board robot(setup);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA, 1e-12);
  EXPECT_NEAR(robot.power().battery().voltage(0), 3.7, 1e-12);
  robot.power().switch_off();
  EXPECT_EQ(robot.power().battery().amps(), 0);
}

TEST(Power, leds_camera_and_codec_count_while_they_are_on) {
  Board robot{board::Setup{}};
  robot.pins().init(0);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA, 1e-12);
  robot.pins().write_bit('A', 6, true, 10);
  robot.pins().write_bit('A', 7, true, 10);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA + 2 * 0.005, 1e-12);
  robot.pins().write_bit('C', 2, true, 20);
  robot.pins().write_bit('C', 1, true, 20);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA + 2 * 0.005 + 0.020 + 0.015, 1e-12);
  robot.pins().write_bit('C', 13, true, 30);  // camera out of reset
  robot.pins().write_bit('F', 0, true, 30);   // codec on
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA + 2 * 0.005 + 0.035 + 0.030 + 0.020, 1e-12);
  robot.pins().write_bit('F', 7, true, 35);  // the first line of infra-red emitters
  EXPECT_GT(robot.power().battery().amps(), kIdleA + 2 * 0.005 + 0.035 + 0.030 + 0.020 + 0.01);
  robot.processor_reset(40);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA, 1e-12);
}

// 300 steps/s: 15 of 33 ticks with two coils; 700 steps/s: always; 0: never

TEST(Power, coils_that_a_program_holds_count_one_by_one) {
  Board robot{board::Setup{}};
  robot.pins().init(0);
  robot.pins().write('D', Register::Lat, 0x05, 10);  // two of the left motor
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA + 2 * 0.060, 1e-12);
  robot.pins().write('D', Register::Lat, 0x10, 20);  // one of the right motor
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA + 0.060, 1e-12);
}

// the scan lights each of four lines of two emitters for 5 of 260 interrupts

// driving with everything that usual programs use empties 5 Wh in about the published three hours
TEST(Power, driving_lasts_as_long_as_published) {
  const double amps = kIdleA + 0.030 + 4 * 0.060 + 4 * 2 * 0.050 * 5 / 260;
  Battery battery(5, 4.2 - amps * 0.2, amps);
  EXPECT_NEAR(battery.minutes_left(kSecond) / 60, 3.0, 0.3);
}

TEST(Power, low_battery_pin_falls_by_itself_and_says_when) {
  board::Setup setup;
  setup.battery_v = 3.41;
  setup.battery_wh = 0.001;
  Board robot(setup);
  robot.pins().init(0);
  EXPECT_EQ(robot.pins().read('F', Register::Port, 0) >> 1 & 1, 1);
  const Cycle falls = robot.pins().horizon('F', 0);
  ASSERT_LT(falls, board::kNever);
  EXPECT_EQ(robot.pins().read('F', Register::Port, falls - 1) >> 1 & 1, 1);
  EXPECT_EQ(robot.pins().read('F', Register::Port, falls) >> 1 & 1, 0);
}

// 3.0 V at rest are 0; below, the curve falls by 9 V for a full charge. 0.001 Wh of 3.7 V are 1 As: 8 s
TEST(Power, an_empty_battery_ends_at_0_v_and_is_told) {
  board::Setup setup;
  setup.battery_wh = 0.001;
  setup.battery_v = 4.2 - 0.2 * kIdleA;
  Board robot(setup);
  robot.pins().init(0);
  const Battery& battery = robot.power().battery();
  EXPECT_TRUE(robot.diagnoses(7 * kSecond).empty());
  double before_wh = 0;
  for (Cycle s = 1; s < 60; ++s) {
    EXPECT_GE(battery.voltage(s * kSecond), 0) << s;
    EXPECT_GE(battery.charge(s * kSecond), -1 / 3.0 - 1e-9) << s;
    EXPECT_GE(battery.used_wh(s * kSecond), before_wh - 1e-6)
        << s;  // its own resistance takes the last of it
    before_wh = battery.used_wh(s * kSecond);
    if (s == 30) robot.pins().write_bit('C', 13, true, s * kSecond);  // another current
  }
  EXPECT_EQ(battery.voltage(60 * kSecond), 0);
  ASSERT_EQ(robot.diagnoses(60 * kSecond).size(), 1u);
  const board::Diagnosis told = robot.diagnoses(60 * kSecond)[0];
  EXPECT_EQ(told.cause, "battery empty");
  // as long as its charge lasts at one current
  const double mean_v = 0.001 * 3600 / (kIdleA * static_cast<double>(told.first) / kSecond);
  EXPECT_NEAR(mean_v, 3.8, 0.1);
}

TEST(Power, revision_1_3_measures_the_sag) {
  board::Setup setup;
  setup.revision = board::Revision::Rev13;
  setup.battery_v = 4.0;
  Board robot(setup);
  robot.pins().init(0);
  // 4.0 V: 2070 + 0.6 * 490 / 0.8 = 2437.5
  EXPECT_NEAR(robot.convert(board::kBatteryChannel, 0), 2437.5, 0.51);
  robot.pins().write('D', Register::Lat, 0x55, 10);  // four coils, 0.24 A: 48 mV less, 29.4 counts
  EXPECT_NEAR(robot.convert(board::kBatteryChannel, 10), 2437.5 - 29.4, 0.51);
}

}  // namespace
