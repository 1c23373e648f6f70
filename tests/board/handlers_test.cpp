// SPDX-License-Identifier: MIT
// What the handlers that nobody runs take from the program, against a plain walk through time.
#include "hal_sim/board/handlers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "hal_sim/board/board.h"
#include "tests/board/scan_times.h"

namespace {

using board::Board;
using board::Cycle;
using board::Wheel;

constexpr Cycle kTick = board::kAgendaTickCycles;
const char left_motor = 0, right_motor = 0;

using scan_times::Call;

/// Cycle by cycle: a program that is interrupted.
Cycle walk(const std::vector<Call>& calls, Cycle from, Cycle work) {
  Cycle now = from;
  std::size_t next = 0;
  while (next < calls.size() && calls[next].at < from) ++next;
  for (Cycle done = 0; done < work;) {
    if (next < calls.size() && calls[next].at <= now) {
      now += calls[next++].cycles;
      continue;
    }
    ++now;
    ++done;
  }
  return now;
}

TEST(Handlers, the_scan_interrupts_when_its_frames_end) {
  board::Setup setup;
  Board robot(setup);
  robot.scan().start(false, false, 1234);
  const auto calls = scan_times::calls(1234, 700);
  for (std::size_t i = 1; i < calls.size(); ++i) {
    EXPECT_EQ(robot.scan().next_call(calls[i - 1].at + 1), calls[i].at) << i;
    EXPECT_EQ(robot.scan().last_call(calls[i].at + 1).at, calls[i].at) << i;
    EXPECT_EQ(robot.scan().last_call(calls[i].at).at, calls[i - 1].at) << i;
  }
  std::mt19937 random(1);
  for (int n = 0; n < 2000; ++n) {
    const Cycle from = 1234 + random() % 500'000;
    const Cycle work = 1 + random() % 4000;
    const Cycle end = walk(calls, from, work);
    EXPECT_EQ(robot.handlers().done(from, work, 0), end) << from << " " << work;
    EXPECT_EQ(robot.handlers().done(from, work, 4), end);
    EXPECT_EQ(robot.handlers().done(from, work, 5), from + work);  // its own level
    EXPECT_GE(robot.handlers().work(from, end, 0), work);
    EXPECT_LT(robot.handlers().work(from, end - 1, 0), work);
  }
}

TEST(Handlers, both_together_take_what_each_takes) {
  board::Setup setup;
  Board robot(setup);
  robot.agendas().name_motor(Wheel::Left, &left_motor);
  robot.agendas().name_motor(Wheel::Right, &right_motor);
  robot.agendas().activate(&left_motor, 0, 0);
  robot.agendas().activate(&right_motor, 0, 0);
  robot.agendas().start(100);
  robot.scan().start(false, false, 500);
  robot.settle_handlers(500);
  robot.agendas().set_speed(Wheel::Left, 800, 500);   // every 12 ticks
  robot.agendas().set_speed(Wheel::Right, 200, 500);  // 15 ticks on, 35 off
  std::vector<Call> calls = scan_times::calls(500, 700);
  for (int tick = 1; tick < 400; ++tick) {
    Cycle cycles = 35 - 2 + 2 * (13 + 5);
    // the left motor's phase falls from 0: 2 more to phases 1 and 2, with coil C on
    if (tick % 12 == 0) cycles += 107 + (tick / 12 % 4 == 2 || tick / 12 % 4 == 3 ? 2 : 0);
    if (tick >= 50 && (tick - 50) % 50 == 0) cycles += 123;
    if (tick >= 65 && (tick - 65) % 50 == 0) cycles += 125;
    calls.push_back({100 + tick * kTick, cycles});
  }
  std::sort(calls.begin(), calls.end(), [](const Call& a, const Call& b) { return a.at < b.at; });
  std::mt19937 random(2);
  for (int n = 0; n < 2000; ++n) {
    const Cycle from = 2000 + random() % 400'000;
    const Cycle work = 1 + random() % 60'000;
    EXPECT_EQ(robot.handlers().done(from, work, 0), walk(calls, from, work)) << from << " " << work;
  }
}

TEST(Handlers, a_step_waits_for_the_converters_handler) {
  board::Setup setup;
  Board robot(setup);
  robot.agendas().name_motor(Wheel::Right, &right_motor);
  robot.agendas().activate(&right_motor, 0, 0);
  robot.scan().start(false, false, 0);
  // the tick at which the wheel steps comes 10 cycles after a frame's end: 109 - 10 cycles to wait
  const Cycle step_tick = scan_times::calls(0, 20)[18].at + 10;
  robot.agendas().start(step_tick - 10 * kTick);
  robot.agendas().set_speed(Wheel::Right, 1000, step_tick - 10 * kTick);
  robot.port_write('D', Board::Register::Tris, 0, 0);
  const Cycle pins = 99 + 1 + 19 + 18 + 82;  // the wait, entry, the node, and B and C go high
  EXPECT_EQ(robot.agendas().stepper_at(Wheel::Right, step_tick + kTick).stepped_at(), step_tick + pins);
  // without the scan it does not wait
  setup.spread_handlers = true;
  Board plain(setup);
  plain.agendas().name_motor(Wheel::Right, &right_motor);
  plain.agendas().activate(&right_motor, 0, 0);
  plain.agendas().start(step_tick - 10 * kTick);
  plain.agendas().set_speed(Wheel::Right, 1000, step_tick - 10 * kTick);
  plain.port_write('D', Board::Register::Tris, 0, 0);
  EXPECT_EQ(plain.agendas().stepper_at(Wheel::Right, step_tick + kTick).stepped_at(), step_tick);
}

TEST(Handlers, frames_slip_when_the_converter_waits_for_the_ticks_handler) {
  board::Setup setup;
  Board robot(setup);
  robot.agendas().start(0);
  // the call of slot 2 comes one cycle after a tick: two cycles of the entry are left
  const Cycle start = 100 * kTick + 1 - 15 - 2700;
  robot.scan().start(false, false, start);
  const Cycle fourth = scan_times::calls(start, 4)[3].at;
  EXPECT_EQ(robot.scan().next_call(fourth - 10), fourth);
  robot.settle_handlers(fourth - 500);
  EXPECT_EQ(robot.scan().next_call(fourth - 10), fourth + 2);
}

}  // namespace
