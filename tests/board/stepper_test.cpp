// SPDX-License-Identifier: MIT
#include "hal_sim/board/stepper.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <utility>

#include "hal_sim/board/motors.h"

namespace {

using board::kPhaseCoils;
using board::Stepper;

constexpr board::Cycle kStep = board::kFcyHz / 100;  // 100 steps/s

Stepper connected(int forward) {
  Stepper s(forward);
  s.connect(true);
  return s;
}

// A B C D of phases 0 to 3: 0101 0110 1010 1001; bit 0 is A
TEST(Stepper, coil_patterns_are_those_of_the_robot) {
  EXPECT_EQ(kPhaseCoils[0], 0b1010u);
  EXPECT_EQ(kPhaseCoils[1], 0b0110u);
  EXPECT_EQ(kPhaseCoils[2], 0b0101u);
  EXPECT_EQ(kPhaseCoils[3], 0b1001u);
}

TEST(Stepper, right_wheel_goes_forward_with_growing_phase_and_left_with_falling) {
  Stepper right = connected(+1), left = connected(-1);
  board::Cycle at = 0;
  for (int phase : {0, 1, 2, 3, 0, 1}) right.energise(kPhaseCoils[phase], at += kStep);
  for (int phase : {0, 3, 2, 1, 0, 3}) left.energise(kPhaseCoils[phase], at += kStep);
  EXPECT_EQ(right.steps(), 5);
  EXPECT_EQ(left.steps(), 5);
  for (int phase : {0, 3}) right.energise(kPhaseCoils[phase], at += kStep);
  EXPECT_EQ(right.steps(), 3);
}

TEST(Stepper, two_phases_at_once_lose_the_step) {
  Stepper s = connected(+1);
  s.energise(kPhaseCoils[2], kStep);
  EXPECT_EQ(s.steps(), 0);
  EXPECT_EQ(s.lost(), 1);
  EXPECT_EQ(s.faults(kStep).jumps.first, kStep);
  s.energise(kPhaseCoils[3], 2 * kStep);  // the rotor is still at 0: one back
  EXPECT_EQ(s.steps(), -1);
}

TEST(Stepper, no_current_or_one_coil_moves_nothing) {
  Stepper s = connected(+1);
  for (unsigned coils : {0u, 1u, 2u, 4u, 8u, 3u, 12u, 15u, 7u}) s.energise(coils, 0);
  EXPECT_EQ(s.steps(), 0);
  EXPECT_EQ(s.lost(), 0);
}

TEST(Stepper, floating_pins_drive_nothing) {
  Stepper s(+1);
  s.energise(kPhaseCoils[1], 0);
  EXPECT_EQ(s.steps(), 0);
  s.connect(true);
  s.energise(kPhaseCoils[1], 0);
  EXPECT_EQ(s.steps(), 1);
}

// writing the four bits one after another passes through single-coil states only
TEST(Stepper, follows_pins_that_are_written_one_by_one) {
  Stepper s = connected(+1);
  unsigned pins = kPhaseCoils[0];
  s.energise(pins, 0);
  for (int n = 1; n <= 12; ++n) {
    const unsigned want = kPhaseCoils[n & 3];
    for (int bit = 0; bit < 4; ++bit) {
      pins = (pins & ~(1u << bit)) | (want & (1u << bit));
      s.energise(pins, n * kStep + bit);
    }
    EXPECT_EQ(s.steps(), n);
  }
}

TEST(Stepper, rotor_follows_within_the_time_it_has) {
  Stepper s = connected(+1);
  s.energise(kPhaseCoils[1], 100000, 40000);
  EXPECT_DOUBLE_EQ(s.position(100000), 0.0);
  EXPECT_DOUBLE_EQ(s.position(110000), 0.25);
  EXPECT_DOUBLE_EQ(s.position(140000), 1.0);
  EXPECT_DOUBLE_EQ(s.position(199999), 1.0);
  // a next step before the first is complete starts where the rotor is
  s.energise(kPhaseCoils[2], 200000, 40000);
  s.energise(kPhaseCoils[3], 220000, 40000);
  EXPECT_DOUBLE_EQ(s.position(220000), 1.5);
  EXPECT_DOUBLE_EQ(s.position(260000), 3.0);
}

// --- what a motor does not do

std::int64_t steps_after_a_second_at(int steps_s) {
  Stepper s = connected(+1);
  for (int n = 1; n <= steps_s; ++n) s.energise(kPhaseCoils[n & 3], n * board::kFcyHz / steps_s);
  EXPECT_EQ(s.lost() > 0, steps_s > 1100);
  return s.steps();
}

TEST(Stepper, follows_1000_steps_a_second_and_not_2000) {
  EXPECT_EQ(steps_after_a_second_at(1000), 1000);
  EXPECT_LT(std::abs(steps_after_a_second_at(2000)), 1000);
  EXPECT_LT(std::abs(steps_after_a_second_at(50000)), 10);
}

TEST(Stepper, one_early_step_is_caught_up) {
  Stepper s = connected(+1);
  s.energise(kPhaseCoils[1], kStep);
  s.energise(kPhaseCoils[2], kStep + board::kPullOutCycles / 2);
  s.energise(kPhaseCoils[3], kStep + 2 * board::kPullOutCycles);
  EXPECT_EQ(s.steps(), 3);
  EXPECT_EQ(s.lost(), 0);
}

// 1010 to 0101 pin by pin passes a neighbour's pattern for microseconds: that does not pull
TEST(Stepper, patterns_that_only_pass_do_not_pull) {
  Stepper s = connected(+1);
  s.energise(0b1010, kStep);
  s.energise(0b1011, 2 * kStep);
  s.energise(0b1001, 2 * kStep + 2);
  s.energise(0b1101, 2 * kStep + 4);
  s.energise(0b0101, 2 * kStep + 6);
  EXPECT_EQ(s.steps(), 0);
  EXPECT_EQ(s.faults(2 * kStep + 6).jumps.count, 1);
  EXPECT_EQ(s.faults(2 * kStep + 6).opposed.count, 0);
}

TEST(Stepper, coils_held_for_a_second_and_opposed_ends_are_counted) {
  Stepper s = connected(+1);
  s.energise(0b1010, kStep);
  EXPECT_EQ(s.faults(kStep + board::kRestCycles - 1).held.count, 0);
  EXPECT_EQ(s.faults(kStep + board::kRestCycles).held.count, 1);
  EXPECT_EQ(s.faults(kStep + 5 * board::kRestCycles).held.first, kStep);
  s.energise(0, kStep + 2 * board::kRestCycles);
  s.energise(0b0011, 3 * board::kRestCycles);
  s.energise(0, 4 * board::kRestCycles);
  const board::StepperFaults faults = s.faults(9 * board::kRestCycles);
  EXPECT_EQ(faults.held.count, 1);
  EXPECT_EQ(faults.opposed.count, 1);
  EXPECT_EQ(faults.opposed.first, 3 * board::kRestCycles);
}

// who has foreseen how a wheel turns looks again once these are others
TEST(Motors, whoever_commands_one_is_counted) {
  const std::array<double, 2> ratio{1, 1};
  board::Motors motors(ratio);
  const std::pair<const char*, std::function<void()>> commands[] = {
      {"directions", [&] { motors.set_directions(0, 0); }},
      {"a pattern", [&] { motors.write(0x6A, kStep); }},
      {"another of one motor", [&] { motors.write(0x65, 2 * kStep); }},
      {"steps are lost", [&] { motors.lose_steps(board::Wheel::Left, nullptr, 3 * kStep); }},
      {"no current", [&] { motors.release(4 * kStep); }},
      {"a reset", [&] { motors.processor_reset(); }},
      {"the beginning", [&] { motors.begin_again(5 * kStep); }},
      {"no driver", [&] { motors.attach(nullptr); }},
  };
  for (const auto& [name, command] : commands) {
    const std::uint64_t before = motors.commands();
    command();
    EXPECT_NE(motors.commands(), before) << name;
  }
  const std::uint64_t before = motors.commands();
  motors.write(0, 6 * kStep);  // the pattern that is there
  motors.steps(board::Wheel::Left, 7 * kStep);
  motors.turn(board::Wheel::Right, 7 * kStep);
  EXPECT_EQ(motors.commands(), before);
}

}  // namespace
