// SPDX-License-Identifier: MIT
// The board under the library's drivers: pins that they move, wheels that turn, what they draw.
#include <gtest/gtest.h>

#include "tests/board/flat_scene.h"
#include "tests/drivers/driven_board.h"
#include "tests/drivers/scan_times.h"

namespace {

using board::Board;
using board::Cycle;
using board::Wheel;
using Register = board::Pins::Register;

constexpr Cycle kSecond = board::kFcyHz;
constexpr double kIdleA = 0.050 + 0.060 + 0.020;  // processor, Bluetooth, board: battery_params.h
char left_motor, right_motor;

void drive(DrivenBoard& robot, int left, int right, Cycle at) {
  robot.pins().init(at);
  robot.agendas().name_motor(Wheel::Left, &left_motor);
  robot.agendas().name_motor(Wheel::Right, &right_motor);
  robot.agendas().activate(&left_motor, 0, at);
  robot.agendas().activate(&right_motor, 0, at);
  robot.agendas().start(at);
  robot.agendas().set_speed(Wheel::Left, left, at);
  robot.agendas().set_speed(Wheel::Right, right, at);
}

TEST(Pins, a_pulse_of_the_scan_is_seen_but_not_latched) {
  DrivenBoard robot{board::Setup{}};
  robot.pins().init(0);
  robot.scan().start(false, false, 0);
  const auto calls = scan_times::calls(0, 70);
  const Cycle on = calls[63] + scan_times::kLight, off = calls[68] + scan_times::kLight;  // pair 1: RF8
  EXPECT_EQ(robot.pins().read('F', Register::Lat, on - 1) & 0x180, 0);
  EXPECT_EQ(robot.pins().read('F', Register::Lat, on) & 0x180, 0x100);
  EXPECT_EQ(robot.pins().horizon('F', on), off);
  // somebody switches the codec on meanwhile
  robot.pins().write_bit('F', 0, true, on + 10);
  EXPECT_EQ(robot.pins().read('F', Register::Lat, off) & 0x181, 0x001);
}

TEST(Pins, selector_10_flashes_body_and_front_led) {
  DrivenBoard robot{board::Setup{}};
  robot.pins().init(0);
  robot.scan().start(false, true, 0);
  bool seen = false;
  for (Cycle at = 0; at < 600 * 900; at += 900) seen = seen || robot.pins().leds(at) == 3u << 8;
  EXPECT_TRUE(seen);
}

TEST(Board, a_reset_stops_everything_and_keeps_the_wheels) {
  DrivenBoard robot{board::Setup{}};
  drive(robot, 700, -700, 0);
  robot.pins().write_bit('A', 6, true, 0);
  robot.scan().start(false, false, 0);
  std::string sent;
  robot.uart(1).listen(&sent);
  robot.uart(1).put_on_wire('x', kSecond - 10, kSecond + 1270);
  const std::int64_t left = robot.motors().left_steps(kSecond), right = robot.motors().right_steps(kSecond);
  robot.processor_reset(kSecond);
  EXPECT_EQ(robot.pins().leds(kSecond), 0u);
  EXPECT_EQ(robot.motors().left_steps(5 * kSecond), left);
  EXPECT_EQ(robot.motors().right_steps(5 * kSecond), right);
  EXPECT_EQ(robot.motors().coils(Wheel::Left, 5 * kSecond), 0u);
  EXPECT_EQ(robot.scan().clock().interrupts(5 * kSecond), 0);
  robot.uart(1).exchange(5 * kSecond);
  EXPECT_EQ(sent, "");  // cut off
  EXPECT_EQ(robot.agendas().ticks().next_interrupt(), board::kNever);
  // and it can be driven again; the driver's counter starts from 0
  drive(robot, 1000, 1000, 6 * kSecond);
  EXPECT_NEAR(static_cast<double>(robot.motors().left_steps(7 * kSecond) - left), 999, 3);
  EXPECT_NEAR(static_cast<double>(robot.agendas().motors().commanded_steps(Wheel::Left, 7 * kSecond)), 999,
              1);
}

TEST(Board, samples_are_taken_at_world_time) {
  sim::Scene scene;
  board::Setup setup;
  setup.boot_delay_s = 0.5;
  setup.clock_ppm = 1000;
  DrivenBoard robot(setup);
  robot.look_at(&scene);
  robot.scan().start(false, false, 0);
  robot.scan().lit(0, kSecond);
  ASSERT_FALSE(scene.asked.empty());
  // the sample is at most 16 ms old; the robot's second ends 1 ms early
  EXPECT_NEAR(sim::to_seconds(scene.asked.back().at), 0.5 + 0.99, 0.01);
}

TEST(Power, coils_count_with_the_share_of_the_power_save_rhythm) {
  static const char left = 0, right = 0;
  DrivenBoard robot{board::Setup{}};
  robot.pins().init(0);
  robot.agendas().name_motor(Wheel::Left, &left);
  robot.agendas().name_motor(Wheel::Right, &right);
  robot.agendas().activate(&left, 0, 0);
  robot.agendas().activate(&right, 0, 0);
  robot.agendas().start(0);
  robot.agendas().set_speed(Wheel::Left, 300, 0);
  robot.pins().follow(0);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA + 2 * 0.060 * 15 / 33, 1e-12);
  robot.agendas().set_speed(Wheel::Right, -700, 100);
  robot.pins().follow(100);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA + 2 * 0.060 * 15 / 33 + 2 * 0.060, 1e-12);
  robot.agendas().set_speed(Wheel::Left, 0, 200);
  robot.agendas().set_speed(Wheel::Right, 0, 200);
  robot.pins().follow(200);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA, 1e-12);
}

TEST(Power, infrared_flashes_count_with_their_mean) {
  DrivenBoard robot{board::Setup{}};
  robot.pins().init(0);
  robot.scan().start(false, false, 0);
  robot.pins().follow(0);
  EXPECT_NEAR(robot.power().battery().amps(), kIdleA + 4 * 2 * 0.050 * 5 / 260, 1e-12);
}

TEST(Pins, port_d_shows_the_coils_of_the_running_driver) {
  DrivenBoard robot{board::Setup{}};
  drive(robot, 100, 800, 0);
  bool off = false, on = false;
  for (Cycle at = 0; at < kSecond / 5; at += 700) {
    const unsigned word = robot.pins().read('D', Register::Port, at);
    EXPECT_EQ(word & 15u, robot.motors().coils(Wheel::Left, at));
    EXPECT_EQ(word >> 4 & 15u, robot.motors().coils(Wheel::Right, at));
    if (at > 120 * 1475) (word & 15u) == 0 ? off = true : on = true;
    const Cycle horizon = robot.pins().horizon('D', at);
    EXPECT_GT(horizon, at);
    EXPECT_EQ(robot.pins().read('D', Register::Port, horizon - 1), word);
  }
  EXPECT_TRUE(off && on);
}

TEST(Board, wheel_ratio_scales_the_angle_and_nothing_else) {
  board::Setup setup;
  setup.wheel_ratio = {1.02, 1.0};
  DrivenBoard robot(setup);
  drive(robot, 1000, 1000, 0);
  EXPECT_EQ(robot.motors().left_steps(kSecond), robot.motors().right_steps(kSecond));
  const double cycle_rad = 2 * 3.14159265358979323846 / kSecond;  // at 1000 steps/s
  EXPECT_NEAR(robot.motors().angle_rad(Wheel::Left, kSecond),
              1.02 * robot.motors().angle_rad(Wheel::Right, kSecond), 200 * cycle_rad);
}

TEST(Board, equal_programs_give_equal_hashes_and_different_ones_do_not) {
  auto run = [](int speed, bool look) {
    DrivenBoard robot{board::Setup{}};
    drive(robot, speed, 300, 0);
    robot.uart(1).put_on_wire('x', 5, 1285);
    if (look)
      for (Cycle at = 0; at < kSecond; at += 12345) {
        robot.motors().angle_rad(Wheel::Left, at);
        robot.motors().coils(Wheel::Right, at);
        robot.state_hash(at);
      }
    return robot.state_hash(kSecond);
  };
  EXPECT_EQ(run(500, false), run(500, true));
  EXPECT_NE(run(500, false), run(510, false));
}

}  // namespace
