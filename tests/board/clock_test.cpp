// SPDX-License-Identifier: MIT
#include "hal_sim/board/clock.h"

#include <gtest/gtest.h>

namespace {

using board::RobotClock;

TEST(RobotClock, a_perfect_crystal_counts_clicks) {
  const RobotClock clock(0, 5000);
  EXPECT_EQ(clock.cycle_at(5000), 0);
  EXPECT_EQ(clock.cycle_at(4999), -1);
  EXPECT_EQ(clock.click_at(14'745'600), 14'745'600 + 5000);
}

// 100 ppm fast: 1474.56 cycles too many a second, without drift over hours
TEST(RobotClock, parts_per_million_are_exact) {
  const RobotClock clock(100'000);
  EXPECT_EQ(clock.cycle_at(14'745'600), 14'745'600 + 1474);
  const sim::Clicks day = sim::Clicks{86400} * 14'745'600;
  EXPECT_EQ(clock.cycle_at(day), day + day / 10'000);
}

TEST(RobotClock, conversions_are_monotone_and_fit_each_other) {
  for (std::int64_t ppb : {-50'000'000, -37'123, -1, 1, 999, 250'000, 50'000'000}) {
    const RobotClock clock(ppb, 12'345);
    std::int64_t last = clock.cycle_at(0);
    for (sim::Clicks t = 0; t < 3'000'000'000; t += 7'654'321) {
      const std::int64_t cycle = clock.cycle_at(t);
      EXPECT_GE(cycle, last);
      last = cycle;
      EXPECT_LE(clock.click_at(cycle), t);
      EXPECT_GE(clock.cycle_at(clock.click_at(cycle)), cycle);
      EXPECT_LT(clock.cycle_at(clock.click_at(cycle) - 1), cycle);
    }
  }
}

// a span of 20 hours and more, or a crystal that is off by half a per cent, is counted as any other
TEST(RobotClock, long_spans_and_bad_crystals_are_as_exact) {
  const auto floor_of = [](__int128 a, __int128 b) {
    return static_cast<std::int64_t>(a / b - (a % b < 0 ? 1 : 0));
  };
  constexpr std::int64_t kBillion = 1'000'000'000, kEdge = std::int64_t{1} << 40;
  for (std::int64_t ppb :
       {-999'999'999, -4'194'304, -4'194'303, -7, 131'000, 4'194'303, 4'194'304, 900'000'000}) {
    const RobotClock clock(ppb);
    for (std::int64_t span :
         {-kEdge - 1, -kEdge, -kEdge + 1, std::int64_t{-3}, kEdge - 1, kEdge, 7 * kEdge + 3}) {
      EXPECT_EQ(clock.cycle_at(span), floor_of(static_cast<__int128>(span) * (kBillion + ppb), kBillion));
      EXPECT_EQ(clock.click_at(span), -floor_of(-static_cast<__int128>(span) * kBillion, kBillion + ppb));
    }
  }
}

// a robot that begins again counts on; its cycles lie as they lay after the world's beginning
TEST(RobotClock, a_new_beginning_is_as_the_first_one_and_forgets_nothing) {
  for (std::int64_t ppb : {-37'123, 0, 131'000}) {
    const RobotClock first(ppb, 12'345);
    RobotClock clock(ppb, 12'345);
    const sim::Clicks at[] = {1'000'003, 5'000'077};
    board::Cycle begun[2];
    for (int n = 0; n < 2; ++n) {
      begun[n] = clock.cycle_at(at[n]);
      clock.begin_again(at[n]);
    }
    for (sim::Clicks t = 12'345; t < 3'900'000; t += 7'919) {
      EXPECT_EQ(clock.cycle_at(at[1] + t), begun[1] + first.cycle_at(t));
      EXPECT_EQ(clock.cycle_at(at[0] + t), begun[0] + first.cycle_at(t));
      EXPECT_EQ(clock.click_at(begun[1] + first.cycle_at(t)), at[1] + first.click_at(first.cycle_at(t)));
      EXPECT_EQ(clock.click_at(begun[0] + first.cycle_at(t)), at[0] + first.click_at(first.cycle_at(t)));
    }
    EXPECT_EQ(clock.cycle_at(900'000), first.cycle_at(900'000));
    EXPECT_EQ(clock.click_at(first.cycle_at(900'000)), first.click_at(first.cycle_at(900'000)));
    EXPECT_EQ(clock.cycle_at(at[1] + 100), begun[1]) << "it boots again";
  }
}

}  // namespace
