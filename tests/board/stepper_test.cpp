// SPDX-License-Identifier: MIT
#include "hal_sim/board/stepper.h"

#include <gtest/gtest.h>

namespace {

using board::kPhaseCoils;
using board::Stepper;

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
  for (int phase : {0, 1, 2, 3, 0, 1}) right.energise(kPhaseCoils[phase], 0);
  for (int phase : {0, 3, 2, 1, 0, 3}) left.energise(kPhaseCoils[phase], 0);
  EXPECT_EQ(right.steps(), 5);
  EXPECT_EQ(left.steps(), 5);
  for (int phase : {0, 3}) right.energise(kPhaseCoils[phase], 0);
  EXPECT_EQ(right.steps(), 3);
}

TEST(Stepper, two_phases_at_once_lose_the_step) {
  Stepper s = connected(+1);
  s.energise(kPhaseCoils[2], 0);
  EXPECT_EQ(s.steps(), 0);
  EXPECT_EQ(s.lost(), 1);
  s.energise(kPhaseCoils[3], 0);  // the rotor is still at 0: one back
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
      s.energise(pins, n * 1000 + bit);
    }
    EXPECT_EQ(s.steps(), n);
  }
}

TEST(Stepper, rotor_follows_within_the_time_it_has) {
  Stepper s = connected(+1);
  s.energise(kPhaseCoils[1], 1000, 400);
  EXPECT_DOUBLE_EQ(s.position(1000), 0.0);
  EXPECT_DOUBLE_EQ(s.position(1100), 0.25);
  EXPECT_DOUBLE_EQ(s.position(1400), 1.0);
  EXPECT_DOUBLE_EQ(s.position(9999), 1.0);
  // a next step before the first is complete starts where the rotor is
  s.energise(kPhaseCoils[2], 2000, 400);
  s.energise(kPhaseCoils[3], 2200, 400);
  EXPECT_DOUBLE_EQ(s.position(2200), 1.5);
  EXPECT_DOUBLE_EQ(s.position(2600), 3.0);
}

}  // namespace
