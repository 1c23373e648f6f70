// SPDX-License-Identifier: MIT
// The remote control's line: RC5 frames in Manchester code, from the published code's own numbers.
#include "hal_sim/board/remote.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal_sim/board/board.h"

namespace {

using board::Cycle;
using board::KeyPress;
using board::RemoteReceiver;
using board::RobotClock;

constexpr double kBitS = 64 / 36000.0;  // 64 periods of 36 kHz

Cycle cycle_of(double seconds) { return static_cast<Cycle>(std::llround(seconds * 14745600)); }

/// The frame as somebody who listens decodes it: level in the first and second half of each bit.
std::string decoded(const RemoteReceiver& remote, double frame_at_s) {
  std::string bits;
  for (int bit = 0; bit < 14; ++bit) {
    const bool first = remote.level(cycle_of(frame_at_s + (bit + 0.25) * kBitS));
    const bool second = remote.level(cycle_of(frame_at_s + (bit + 0.75) * kBitS));
    bits += first == second ? '?' : first ? '1' : '0';  // silence is high: a 1 is silence, then carrier
  }
  return bits;
}

TEST(Remote, line_is_high_for_ever_when_nobody_presses_anything) {
  RobotClock clock;
  RemoteReceiver remote(clock);
  EXPECT_TRUE(remote.level(0));
  EXPECT_EQ(remote.horizon(0), board::kNever);
}

// 11, toggle 0, address 00101, key 100011
TEST(Remote, a_press_is_a_frame_of_fourteen_bits) {
  RobotClock clock;
  RemoteReceiver remote(clock);
  remote.press({35, 1.0, 0.05, 5});
  EXPECT_EQ(decoded(remote, 1.0), "11000101100011");
  EXPECT_TRUE(remote.level(cycle_of(1.0 + 14.5 * kBitS)));
  EXPECT_EQ(remote.horizon(cycle_of(1.0 + 14.5 * kBitS)), board::kNever);
}

TEST(Remote, first_falling_edge_is_in_the_middle_of_the_first_bit) {
  RobotClock clock;
  RemoteReceiver remote(clock);
  remote.press({1, 0.5, 0, 0});
  const Cycle edge = remote.next_edge(0, true);
  EXPECT_NEAR(static_cast<double>(edge) / 14745600, 0.5 + kBitS / 2, 1e-7);
  EXPECT_TRUE(remote.level(edge - 1));
  EXPECT_FALSE(remote.level(edge));
  EXPECT_EQ(remote.horizon(edge - 1), edge);
  // up again at the end of the first bit: the second one begins with silence
  EXPECT_NEAR(static_cast<double>(remote.next_edge(edge, false)) / 14745600, 0.5 + kBitS, 1e-7);
}

TEST(Remote, a_held_key_repeats_and_a_new_press_toggles) {
  RobotClock clock;
  RemoteReceiver remote(clock);
  remote.press({7, 0, 0.25, 8});  // 0, 113.8 and 227.6 ms: three frames
  remote.press({7, 1.0, 0, 8});
  for (int frame = 0; frame < 3; ++frame)
    EXPECT_EQ(decoded(remote, frame * 64 * kBitS), "11001000000111") << frame;
  EXPECT_EQ(decoded(remote, 3 * 64 * kBitS), "??????????????");
  EXPECT_EQ(decoded(remote, 1.0), "11101000000111");
}

TEST(Remote, two_keys_at_once_overlay_their_carriers) {
  RobotClock clock;
  RemoteReceiver remote(clock);
  remote.press({0, 0, 0, 0});
  remote.press({63, 0, 0, 31});
  // they agree in the two start bits; from then on one of them always sends
  EXPECT_EQ(decoded(remote, 0).substr(0, 2), "11");
  for (double t = 2.1 * kBitS; t < 14 * kBitS; t += kBitS / 7) EXPECT_FALSE(remote.level(cycle_of(t)));
  const Cycle end = remote.next_edge(cycle_of(3 * kBitS), false);
  EXPECT_NEAR(static_cast<double>(end) / 14745600, 14 * kBitS, 1e-7);
}

TEST(Remote, changes_are_seen_at_the_first_cycle_after_them_on_any_clock) {
  for (std::int64_t ppb : {0, 80'000'000, -70'000'001}) {
    RobotClock clock(ppb, 12345);
    RemoteReceiver remote(clock);
    remote.press({0x2A, 0.1, 0.2, 0x15});
    int changes = 0;
    for (Cycle at = 0; (at = remote.horizon(at)) < board::kNever; ++changes)
      ASSERT_NE(remote.level(at), remote.level(at - 1)) << "change " << changes << ", " << ppb << " ppb";
    EXPECT_GT(changes, 20);
    EXPECT_EQ(changes % 2, 0);  // ends idle, as it began
  }
}

TEST(Remote, the_pin_is_rf6) {
  board::Board robot{board::Setup{}};
  robot.pins().init(0);
  robot.remote().press({3, 0.01, 0, 0});
  const Cycle falls = robot.pins().horizon('F', 0);
  EXPECT_EQ(robot.pins().read('F', board::Pins::Register::Port, falls - 1) >> 6 & 1, 1);
  EXPECT_EQ(robot.pins().read('F', board::Pins::Register::Port, falls) >> 6 & 1, 0);
}

}  // namespace
