// SPDX-License-Identifier: MIT
// The board as a whole: pins, LEDs, selector, battery, resets, a thousand of them.
#include "hal_sim/board/board.h"

#include <gtest/gtest.h>

#include <ctime>
#include <memory>
#include <random>

#include "tests/board/flat_scene.h"
#include "tests/board/scan_times.h"

namespace {

using board::Board;
using board::Cycle;
using board::Wheel;
using Register = board::Board::Register;

constexpr Cycle kSecond = 14'745'600;
char left_motor, right_motor;

void drive(Board& robot, int left, int right, Cycle at) {
  robot.init_ports(at);
  robot.agendas().name_motor(Wheel::Left, &left_motor);
  robot.agendas().name_motor(Wheel::Right, &right_motor);
  robot.agendas().activate(&left_motor, 0, at);
  robot.agendas().activate(&right_motor, 0, at);
  robot.agendas().start(at);
  robot.agendas().set_speed(Wheel::Left, left, at);
  robot.agendas().set_speed(Wheel::Right, right, at);
}

TEST(Pins, reset_leaves_inputs_and_no_light) {
  Board robot{board::Setup{}};
  EXPECT_EQ(robot.port_read('D', Register::Tris, 0), 0xFFFF);
  EXPECT_EQ(robot.port_read('A', Register::Tris, 0), 0xF6C0);
  EXPECT_EQ(robot.port_read('C', Register::Tris, 0), 0xE01E);
  EXPECT_EQ(robot.port_read('F', Register::Tris, 0), 0x01FF);
  EXPECT_EQ(robot.port_read('G', Register::Tris, 0), 0xF3CF);
  robot.port_write('A', Register::Lat, 0xFFFF, 0);
  EXPECT_EQ(robot.leds(0), 0u);  // latches set, pins not driven
  EXPECT_EQ(robot.port_read('E', Register::Port, 0), 0);
}

TEST(Pins, leds_sit_on_their_pins) {
  Board robot{board::Setup{}};
  robot.init_ports(0);
  const int bits[8] = {6, 7, 9, 12, 10, 13, 14, 15};
  for (int led = 0; led < 8; ++led) {
    robot.port_write('A', Register::Lat, static_cast<std::uint16_t>(1u << bits[led]), 0);
    EXPECT_EQ(robot.leds(0), 1u << led);
  }
  robot.port_write('A', Register::Lat, 0, 0);
  robot.latch_bit('C', 2, true, 0);
  EXPECT_EQ(robot.leds(0), 1u << 8);
  robot.latch_bit('C', 1, true, 0);
  EXPECT_EQ(robot.leds(0), 3u << 8);
  EXPECT_TRUE(robot.latch_bit('C', 1, 0));
  robot.init_ports(0);
  EXPECT_EQ(robot.leds(0), 0u);
}

TEST(Pins, selector_battery_and_remote_are_inputs) {
  board::Setup setup;
  setup.selector = 11;
  setup.battery_v = 3.5;
  Board robot(setup);
  EXPECT_EQ(robot.port_read('G', Register::Port, 0) >> 6 & 15, 11);
  EXPECT_EQ(robot.port_read('F', Register::Port, 0) >> 1 & 1, 1);  // battery good
  EXPECT_EQ(robot.port_read('F', Register::Port, 0) >> 6 & 1, 1);  // remote receiver idle
  robot.set_battery(3.3, 0);
  robot.turn_selector(4);
  EXPECT_EQ(robot.port_read('F', Register::Port, 0) >> 1 & 1, 0);
  EXPECT_EQ(robot.port_read('G', Register::Port, 0) >> 6 & 15, 4);
}

TEST(Pins, battery_is_measured_on_revision_1_3_only) {
  board::Setup setup;
  setup.battery_v = 4.2;
  EXPECT_EQ(Board(setup).battery_counts(0), 0);
  setup.revision = board::Revision::Rev13;
  EXPECT_EQ(Board(setup).battery_counts(0), 2560);
  setup.battery_v = 3.4;
  EXPECT_EQ(Board(setup).battery_counts(0), 2070);
}

TEST(Pins, coils_written_directly_turn_the_wheels) {
  Board robot{board::Setup{}};
  robot.port_write('D', Register::Tris, 0xFF00, 0);
  // right wheel phases 0 1 2 3 on bits 4 to 7, left wheel 0 3 2 1 on bits 0 to 3: both forward
  const unsigned pattern[4] = {0xA, 0x6, 0x5, 0x9};
  for (int n = 0; n <= 8; ++n)
    robot.port_write('D', Register::Lat, static_cast<std::uint16_t>(pattern[n & 3] << 4 | pattern[-n & 3]),
                     n * 15000);
  EXPECT_EQ(robot.left_steps(kSecond), 8);
  EXPECT_EQ(robot.right_steps(kSecond), 8);
  EXPECT_EQ(robot.port_read('D', Register::Lat, kSecond), 0xA0 | 0xA);
  EXPECT_DOUBLE_EQ(robot.wheel_angle_rad(Wheel::Left, kSecond), 8 * 2 * 3.14159265358979323846 / 1000);
}

TEST(Pins, port_d_shows_the_coils_of_the_running_driver) {
  Board robot{board::Setup{}};
  drive(robot, 100, 800, 0);
  bool off = false, on = false;
  for (Cycle at = 0; at < kSecond / 5; at += 700) {
    const unsigned word = robot.port_read('D', Register::Port, at);
    EXPECT_EQ(word & 15u, robot.coils(Wheel::Left, at));
    EXPECT_EQ(word >> 4 & 15u, robot.coils(Wheel::Right, at));
    if (at > 120 * 1475) (word & 15u) == 0 ? off = true : on = true;
    const Cycle horizon = robot.port_horizon('D', at);
    EXPECT_GT(horizon, at);
    EXPECT_EQ(robot.port_read('D', Register::Port, horizon - 1), word);
  }
  EXPECT_TRUE(off && on);
}

TEST(Pins, a_pulse_of_the_scan_is_seen_but_not_latched) {
  Board robot{board::Setup{}};
  robot.init_ports(0);
  robot.scan().start(false, false, 0);
  const auto calls = scan_times::calls(0, 70);
  const Cycle on = calls[63] + scan_times::kLight, off = calls[68] + scan_times::kLight;  // pair 1: RF8
  EXPECT_EQ(robot.port_read('F', Register::Lat, on - 1) & 0x180, 0);
  EXPECT_EQ(robot.port_read('F', Register::Lat, on) & 0x180, 0x100);
  EXPECT_EQ(robot.port_horizon('F', on), off);
  // somebody switches the codec on meanwhile
  robot.latch_bit('F', 0, true, on + 10);
  EXPECT_EQ(robot.port_read('F', Register::Lat, off) & 0x181, 0x001);
}

TEST(Pins, selector_10_flashes_body_and_front_led) {
  Board robot{board::Setup{}};
  robot.init_ports(0);
  robot.scan().start(false, true, 0);
  bool seen = false;
  for (Cycle at = 0; at < 600 * 900; at += 900) seen = seen || robot.leds(at) == 3u << 8;
  EXPECT_TRUE(seen);
}

TEST(Converter, programs_may_flash_and_sample_themselves) {
  sim::Scene scene;
  scene.reflection = [](int, sim::Clicks) { return 1000.0; };
  Board robot{board::Setup{}};
  robot.look_at(&scene);
  robot.init_ports(0);
  EXPECT_EQ(robot.convert(8, 1000), 4095);
  robot.latch_bit('F', 7, true, 2000);  // emitter of sensors 0 and 4
  EXPECT_EQ(robot.convert(8, 2000 + 5000), 3095);
  EXPECT_EQ(robot.convert(12, 2000 + 5000), 3095);
  EXPECT_EQ(robot.convert(9, 2000 + 5000), 4095);
  robot.latch_bit('F', 7, false, 8000);
  EXPECT_EQ(robot.convert(8, 8001), 4095);
  EXPECT_EQ(robot.convert(16, 8001), 0);
}

TEST(Board, wheel_ratio_scales_the_angle_and_nothing_else) {
  board::Setup setup;
  setup.wheel_ratio = {1.02, 1.0};
  Board robot(setup);
  drive(robot, 1000, 1000, 0);
  EXPECT_EQ(robot.left_steps(kSecond), robot.right_steps(kSecond));
  // the handler comes to the left motor's agenda after the right one's
  const double cycle_rad = 2 * 3.14159265358979323846 / kSecond;  // at 1000 steps/s
  EXPECT_NEAR(robot.wheel_angle_rad(Wheel::Left, kSecond),
              1.02 * robot.wheel_angle_rad(Wheel::Right, kSecond), 200 * cycle_rad);
}

TEST(Board, a_reset_stops_everything_and_keeps_the_wheels) {
  Board robot{board::Setup{}};
  drive(robot, 700, -700, 0);
  robot.latch_bit('A', 6, true, 0);
  robot.scan().start(false, false, 0);
  robot.uart(1).init_library(7, 0);
  const std::int64_t left = robot.left_steps(kSecond), right = robot.right_steps(kSecond);
  robot.processor_reset(kSecond);
  EXPECT_EQ(robot.leds(kSecond), 0u);
  EXPECT_EQ(robot.left_steps(5 * kSecond), left);
  EXPECT_EQ(robot.right_steps(5 * kSecond), right);
  EXPECT_EQ(robot.coils(Wheel::Left, 5 * kSecond), 0u);
  EXPECT_EQ(robot.scan().interrupts(5 * kSecond), 0);
  EXPECT_FALSE(robot.uart(1).enabled());
  EXPECT_EQ(robot.agendas().next_interrupt(), host::kNever);
  // and it can be driven again; the driver's counter starts from 0
  drive(robot, 1000, 1000, 6 * kSecond);
  EXPECT_NEAR(static_cast<double>(robot.left_steps(7 * kSecond) - left), 999, 3);
  EXPECT_NEAR(static_cast<double>(robot.agendas().commanded_steps(Wheel::Left, 7 * kSecond)), 999, 1);
}

TEST(Board, basic_driver_moves_the_same_wheels) {
  Board robot{board::Setup{}};
  robot.init_ports(0);
  auto set = [&](Wheel wheel, int v, Cycle at) {
    robot.timer_motors().set_speed(board::TimerMotors::Driver::Basic, wheel, v, at, robot.stepper(wheel, at));
  };
  set(Wheel::Left, 500, 0);
  set(Wheel::Right, -500, 0);
  // (57600 / 500 + 1) x 256 = 29696 cycles a step
  EXPECT_EQ(robot.left_steps(100 * 29696), 100);
  EXPECT_EQ(robot.right_steps(100 * 29696), -100);
  set(Wheel::Left, 0, 100 * 29696);
  EXPECT_EQ(robot.left_steps(kSecond), 100);
  EXPECT_EQ(robot.coils(Wheel::Left, kSecond), 0u);
  robot.processor_reset(kSecond);
  EXPECT_EQ(robot.right_steps(2 * kSecond), robot.right_steps(kSecond));
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

TEST(Board, samples_are_taken_at_world_time) {
  sim::Scene scene;
  board::Setup setup;
  setup.boot_delay_s = 0.5;
  setup.clock_ppm = 1000;
  Board robot(setup);
  robot.look_at(&scene);
  robot.scan().start(false, false, 0);
  robot.scan().lit(0, kSecond);
  ASSERT_FALSE(scene.asked.empty());
  // the sample is at most 16 ms old; the robot's second ends 1 ms early
  EXPECT_NEAR(sim::to_seconds(scene.asked.back().at), 0.5 + 0.99, 0.01);
}

TEST(Board, equal_programs_give_equal_hashes_and_different_ones_do_not) {
  auto run = [](int speed, bool look) {
    Board robot{board::Setup{}};
    drive(robot, speed, 300, 0);
    robot.uart(1).init_library(7, 0);
    robot.uart(1).load('x', 5);
    if (look)
      for (Cycle at = 0; at < kSecond; at += 12345) {
        robot.wheel_angle_rad(Wheel::Left, at);
        robot.coils(Wheel::Right, at);
        robot.state_hash(at);
      }
    return robot.state_hash(kSecond);
  };
  EXPECT_EQ(run(500, false), run(500, true));
  EXPECT_NE(run(500, false), run(510, false));
}

// the work of one robot for a second under the benchmark's controller: 16 rounds of 8 readings and 2 speeds,
// and a world of 96 ticks. Bounds are wide: they catch an algorithm that ticks, not a slow machine.
TEST(Board, a_thousand_boards_cost_little) {
  sim::Scene scene;
  scene.reflection = [](int, sim::Clicks) { return 300.0; };
  scene.relative_noise = 0.02;
  std::vector<std::unique_ptr<Board>> robots;
  for (int i = 0; i < 1000; ++i) {
    board::Setup setup;
    setup.robot = i;
    setup.seed = static_cast<std::uint64_t>(i);
    robots.push_back(std::make_unique<Board>(setup));
    robots.back()->look_at(&scene);
    drive(*robots.back(), 200, 300, 0);
    robots.back()->scan().start(false, false, 0);
  }
  // this thread's processor time: others may be at work on the machine
  auto cpu_s = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  double angle_s = 0, prox_s = 0, speed_s = 0, sum = 0;
  const Cycle tick = kSecond / 96, period = kSecond * 64 / 1000;
  Cycle next = period;
  for (Cycle at = tick; at <= kSecond; at += tick) {
    if (at >= next) {
      next += period;
      double began = cpu_s();
      for (auto& robot : robots)
        for (int s = 0; s < 8; ++s) sum += robot->scan().dark(s, at) - robot->scan().lit(s, at);
      prox_s += cpu_s() - began;
      began = cpu_s();
      for (auto& robot : robots) {
        robot->agendas().set_speed(Wheel::Left, 200 + static_cast<int>(at % 700), at);
        robot->agendas().set_speed(Wheel::Right, 300, at);
      }
      speed_s += cpu_s() - began;
    }
    const double began = cpu_s();
    for (auto& robot : robots) {
      robot->exchange(at);
      sum += robot->wheel_angle_rad(Wheel::Left, at) + robot->wheel_angle_rad(Wheel::Right, at);
    }
    angle_s += cpu_s() - began;
  }
  EXPECT_NE(sum, 0);
  std::printf(
      "one robot, one second: angles %.2f us (%.0f ns each), prox %.2f us (%.0f ns each), speeds %.2f us "
      "(%.0f ns each)\n",
      angle_s * 1e3, angle_s * 1e9 / 1000 / 192, prox_s * 1e3, prox_s * 1e9 / 1000 / 120, speed_s * 1e3,
      speed_s * 1e9 / 1000 / 30);
  EXPECT_LT(angle_s + prox_s + speed_s, 2.0);
}

}  // namespace
