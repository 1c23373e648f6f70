// SPDX-License-Identifier: MIT
// The functions of pins.h through a fake host: interrupts asked for, horizons, the handler's protocol, traps.
#include <gtest/gtest.h>

#include "hal_sim/host/pins.h"
#include "tests/board/flat_scene.h"
#include "tests/drivers/driven_board.h"
#include "tests/drivers/fake_context.h"
#include "tests/drivers/scan_times.h"

namespace {

using board::Board;
using board::Cycle;

constexpr Cycle kTick = 1475;
char left_motor, right_motor, blink;

struct Running : ::testing::Test {
  DrivenBoard robot{board::Setup{}};
  FakeContext context{robot};

  void init_motors() {
    tp_init_ports();
    tp_motor_agenda(0, &left_motor);
    tp_motor_agenda(1, &right_motor);
    tp_agenda_activate(&left_motor, 0);
    tp_agenda_activate(&right_motor, 0);
    tp_agenda_start();
  }
};

using Exports = Running;

TEST_F(Exports, motors_alone_ask_for_no_interrupt) {
  init_motors();
  tp_motor_speed(0, 700);
  EXPECT_EQ(context.requested.count(TP_V_T2), 0u);
  // every tick takes 30 cycles, 13 for each of two nodes less 2, and 5 for the one that counts; the left
  // motor's firing every 14 ticks 83 more
  const double share = (30 - 2 + 2 * 13 + 5) / 1475.0 + 83 / (14 * 1475.0);
  EXPECT_NEAR(static_cast<double>(context.handler_share) / 0x1p32, share, 1e-6);
  tp_agenda_stop();
  EXPECT_EQ(context.handler_share, 0u);
}

TEST_F(Exports, step_counters_say_when_they_change) {
  init_motors();
  tp_motor_speed(1, 1000);
  context.cycle = 9 * kTick;
  EXPECT_EQ(tp_motor_steps(1), 0);
  EXPECT_EQ(context.horizon, 10 * kTick);
  context.cycle = context.horizon;
  context.horizon = host::kNever;
  EXPECT_EQ(tp_motor_steps(1), 1);
  EXPECT_EQ(context.horizon, 20 * kTick);
}

TEST_F(Exports, a_user_agenda_is_served_when_due_and_only_then) {
  init_motors();
  tp_agenda_activate(&blink, 1000);
  EXPECT_EQ(context.requested[TP_V_T2], 1000 * kTick);
  context.cycle = 1000 * kTick;
  tp_agenda_begin();
  EXPECT_EQ(tp_agenda_next(), &blink);
  tp_latch_write('A', 6, 1);
  EXPECT_EQ(tp_agenda_next(), nullptr);
  context.cycle += 200;
  tp_agenda_end();
  EXPECT_EQ(context.requested[TP_V_T2], 2000 * kTick);
  EXPECT_EQ(robot.leds(context.cycle), 1u);
  tp_agenda_destroy(&blink);
  EXPECT_EQ(context.requested[TP_V_T2], -1);
  EXPECT_EQ(tp_agenda_pause(&blink), 2);
}

TEST_F(Exports, an_agenda_may_end_itself) {
  tp_agenda_start();
  tp_agenda_activate(&blink, 5);
  context.cycle = 5 * kTick;
  tp_agenda_begin();
  ASSERT_EQ(tp_agenda_next(), &blink);
  EXPECT_EQ(tp_agenda_destroy(&blink), 1);
  EXPECT_EQ(tp_agenda_next(), nullptr);
  tp_agenda_end();
  EXPECT_EQ(context.requested[TP_V_T2], -1);
}

TEST_F(Exports, division_by_zero_in_a_motor_agenda_traps) {
  init_motors();
  tp_agenda_set_cycle(&left_motor, 5);
  context.cycle = 5 * kTick;
  tp_agenda_begin();
  EXPECT_EQ(tp_agenda_next(), nullptr);
  tp_agenda_end();
  context.cycle = context.requested[TP_V_T2];
  tp_agenda_begin();
  EXPECT_THROW(tp_agenda_next(), std::runtime_error);
}

TEST_F(Exports, array_filled_lasts_one_interrupt) {
  tp_scan_start(0, 0);
  EXPECT_EQ(tp_scan_array_filled(), 0);
  const auto calls = scan_times::calls(0, 101);
  EXPECT_EQ(context.horizon, calls[99]);
  context.cycle = calls[99];
  context.horizon = host::kNever;
  EXPECT_EQ(tp_scan_array_filled(), 1);
  EXPECT_EQ(context.horizon, calls[100]);
  context.cycle = calls[100];
  EXPECT_EQ(tp_scan_array_filled(), 0);
}

TEST_F(Exports, readings_hold_until_the_next_sample) {
  sim::Scene scene;
  scene.reflection = [](int, sim::Clicks) { return 321.0; };
  robot.look_at(&scene);
  tp_scan_start(0, 0);
  context.cycle = tp_scan_filled_at();
  context.horizon = host::kNever;
  const tp_i64 pair = tp_scan_pair(3);
  EXPECT_EQ(pair & 0xFFFF, 4095);
  EXPECT_EQ(pair >> 16, 4095 - 321);
  EXPECT_GT(context.horizon, context.cycle);
  EXPECT_LT(context.horizon, context.cycle + 260 * scan_times::kFrame);
  std::int16_t dark[10], lit[10];
  tp_scan_values(dark, lit);
  for (int sensor = 0; sensor < 8; ++sensor) EXPECT_EQ(dark[sensor] - lit[sensor], 321);
  EXPECT_EQ(dark[9], 0);
  EXPECT_EQ(tp_scan_pair(10), 0);
  EXPECT_EQ(tp_scan_pair(-1), 0);
  tp_scan_switch(0);
  EXPECT_EQ(context.handler_share, 0u);
}

TEST_F(Exports, transmit_interrupt_follows_the_last_loaded_byte) {
  tp_uart_init(1, 7);
  tp_uart_load(1, 'a');
  EXPECT_EQ(context.requested[TP_V_U1TX], 0);  // straight into the shift register
  for (char c : {'b', 'c', 'd', 'e'}) tp_uart_load(1, c);
  EXPECT_EQ(context.requested[TP_V_U1TX], 4 * 1280);
  EXPECT_EQ(tp_uart_unread(1), 0);
  EXPECT_EQ(tp_uart_take(1), -1);
}

// 8 bytes: one in the shift register, four wait; the eighth is accepted when the fourth moves on
TEST_F(Exports, printf_waits_for_room) {
  tp_console("12345678", 8, 1);
  EXPECT_EQ(context.cycle, 3 * 1280);
  EXPECT_EQ(robot.uart(1).idle_at(), 8 * 1280);
}

TEST_F(Exports, open_inputs_and_dark_sensors) { EXPECT_EQ(tp_convert(8), 4095); }

TEST_F(Exports, selector_pins_read_through) {
  robot.turn_selector(9);
  EXPECT_EQ(tp_pins_read('G') >> 6 & 15, 9);
  EXPECT_EQ(tp_revision_1_3(), 0);
  EXPECT_EQ(tp_battery_counts(), 0);
}

TEST_F(Exports, basic_and_timer3_motors) {
  tp_init_ports();
  tp_timer_motor_speed(0, 0, 1000);
  EXPECT_EQ(context.background[TP_BG_MOTOR_LEFT].first, 58 * 256);
  context.cycle = 58 * 256;
  EXPECT_EQ(tp_timer_motor_steps(0, 0), 1);
  tp_timer_motor_speed(0, 0, 0);
  EXPECT_EQ(context.background[TP_BG_MOTOR_LEFT].second, 0);
  tp_timer3_motors_start();
  tp_timer_motor_speed(1, 1, 999);
  context.cycle += 11 * 1536;
  EXPECT_EQ(tp_timer_motor_steps(1, 1), 1);
}

}  // namespace
