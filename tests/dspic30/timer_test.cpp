// SPDX-License-Identifier: MIT
// Timers: counts, periods and the instants of their flags.
// A write in cycle t acts from t + 1; a tick that makes TMR == PR sets the flag one cycle later.
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using bench::kNever;
using dspic::Port;
namespace irq = dspic::irq;

TEST(Timer, counts_cycles_from_the_one_after_ton) {
  Bench b;
  b.write("T1CON", 0x8000, 100);
  EXPECT_EQ(b.read("TMR1", 101), 0u);
  EXPECT_EQ(b.read("TMR1", 102), 1u);
  EXPECT_EQ(b.read("TMR1", 1101), 1000u);
}

// TMR = 0 at 101, PR = 1474 at 101 + 1474 = 1575, flag at 1576, again every 1475
TEST(Timer, agenda_timer_matches_every_1475_cycles) {
  Bench b;
  b.write("PR2", 1474, 50);
  b.write("T2CON", 0x8000, 100);
  EXPECT_FALSE(b.flag(irq::T2, 1575));
  EXPECT_TRUE(b.flag(irq::T2, 1576));
  b.clear_flag(irq::T2, 1580);
  EXPECT_EQ(b.flag_rises(irq::T2, 1581), 1576 + 1475);
}

// with a prescaler the count goes back to 0 a whole prescale period after the flag
TEST(Timer, prescaled_flag_comes_when_the_period_is_reached) {
  Bench b;
  b.write("PR1", 3, 0);
  b.write("T1CON", 0x8000 | 1 << 4, 9);  // 1:8, counts from cycle 10
  EXPECT_EQ(b.read("TMR1", 10 + 23), 2u);
  EXPECT_EQ(b.read("TMR1", 10 + 24), 3u);
  EXPECT_EQ(b.flag_rises(irq::T1, 10), 10 + 24 + 1);
  EXPECT_EQ(b.read("TMR1", 10 + 31), 3u);
  EXPECT_EQ(b.read("TMR1", 10 + 32), 0u);
}

struct Prescale : ::testing::TestWithParam<std::pair<int, Cycle>> {};
TEST_P(Prescale, period_is_pr_plus_one_ticks) {
  const auto [code, ratio] = GetParam();
  for (const int timer : {1, 2, 3, 4, 5}) {
    Bench b;
    const int flags[] = {irq::T1, irq::T2, irq::T3, irq::T4, irq::T5};
    const int flag = flags[timer - 1];
    const std::string n = std::to_string(timer);
    b.write("PR" + n, 99, 0);
    b.write("T" + n + "CON", 0x8000u | static_cast<unsigned>(code) << 4, 0);
    const Cycle first = b.flag_rises(flag, 1);
    EXPECT_EQ(first, 1 + 99 * ratio + 1) << n;
    for (int i = 1; i < 4; ++i) {
      b.clear_flag(flag, first + (i - 1) * 100 * ratio);
      EXPECT_EQ(b.flag_rises(flag, first + (i - 1) * 100 * ratio + 1), first + i * 100 * ratio) << n;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, Prescale,
                         ::testing::Values(std::pair{0, Cycle{1}}, std::pair{1, Cycle{8}},
                                           std::pair{2, Cycle{64}}, std::pair{3, Cycle{256}}));

TEST(Timer, pair_of_32_bits_counts_through_and_flags_the_high_timer) {
  Bench b;
  b.write("PR3", 2, 0);
  b.write("PR2", 5, 0);  // period 0x20005 + 1 = 131078
  b.write("T2CON", 0x8008, 0);
  EXPECT_EQ(b.flag_rises(irq::T3, 1), 1 + 131077 + 1);
  EXPECT_FALSE(b.flag(irq::T2, 131079));
  EXPECT_EQ(b.read("TMR2", 1 + 70000), 70000u & 0xFFFF);
  EXPECT_EQ(b.read("TMR3HLD", 1 + 200000), 70000u >> 16);  // latched by the read of TMR2
  b.clear_flag(irq::T3, 131080);
  EXPECT_EQ(b.flag_rises(irq::T3, 131081), 131079 + 131078);
}

TEST(Timer, writing_the_low_half_writes_both) {
  Bench b;
  b.write("T4CON", 0x8008, 0);
  b.write("PR5", 0xFFFF, 0);
  b.write("TMR5HLD", 3, 10);
  b.write("TMR4", 7, 11);
  EXPECT_EQ(b.read("TMR4", 12), 7u);
  EXPECT_EQ(b.read("TMR5HLD", 12), 3u);
  EXPECT_EQ(b.read("TMR5", 12), 3u);
}

TEST(Timer, stopping_keeps_the_count_and_clears_the_prescaler) {
  Bench b;
  b.write("T1CON", 0x8010, 0);       // 1:8 from cycle 1
  b.write("T1CON", 0x0010, 1 + 20);  // 2 ticks and 5 cycles
  EXPECT_EQ(b.read("TMR1", 500), 2u);
  b.write("T1CON", 0x8010, 600);
  EXPECT_EQ(b.read("TMR1", 608), 2u);
  EXPECT_EQ(b.read("TMR1", 609), 3u);  // a whole prescale period after cycle 601
}

TEST(Timer, writing_tmr_clears_the_prescaler) {
  Bench b;
  b.write("T1CON", 0x8010, 0);
  b.write("TMR1", 40, 5);
  EXPECT_EQ(b.read("TMR1", 6 + 7), 40u);
  EXPECT_EQ(b.read("TMR1", 6 + 8), 41u);
}

TEST(Timer, period_of_zero_stays_at_zero_without_a_flag) {
  Bench b;
  b.write("PR1", 0, 0);
  b.write("T1CON", 0x8000, 0);
  EXPECT_EQ(b.read("TMR1", 5000), 0u);
  EXPECT_FALSE(b.flag(irq::T1, 5000));
  EXPECT_EQ(b.chip.horizon(0x084, 5000), kNever);
}

// 1000 > PR: 65536 - 1000 ticks to 0, 10 more to the match
TEST(Timer, period_below_the_count_runs_through_the_top) {
  Bench b;
  b.write("TMR1", 1000, 0);
  b.write("PR1", 10, 0);
  b.write("T1CON", 0x8000, 0);
  EXPECT_EQ(b.read("TMR1", 1 + 64535), 65535u);
  EXPECT_EQ(b.read("TMR1", 1 + 64536), 0u);
  EXPECT_EQ(b.flag_rises(irq::T1, 1), 1 + 64536 + 10 + 1);
}

TEST(Timer, new_period_acts_at_once) {
  Bench b;
  b.write("PR1", 1000, 0);
  b.write("T1CON", 0x8000, 0);
  b.write("PR1", 500, 300);
  EXPECT_EQ(b.flag_rises(irq::T1, 301), 1 + 500 + 1);
}

TEST(Timer, equality_made_by_software_is_a_match_once) {
  Bench b;
  b.write("PR1", 1000, 0);
  b.write("T1CON", 0x8040 & ~0x40, 0);
  b.write("TMR1", 1000, 100);
  EXPECT_EQ(b.flag_rises(irq::T1, 101), 102);
  b.clear_flag(irq::T1, 110);
  EXPECT_EQ(b.flag_rises(irq::T1, 111), 102 + 1001);
}

// switched off in the very cycle in which the match's tick happens: the flag still comes
TEST(Timer, match_of_the_last_cycle_is_not_lost) {
  Bench b;
  b.write("PR1", 10, 0);
  b.write("T1CON", 0x8000, 0);  // TMR = 10 at cycle 11
  b.write("T1CON", 0x0000, 10);
  EXPECT_EQ(b.flag_rises(irq::T1, 11, 100), 12);
  EXPECT_EQ(b.read("TMR1", 50), 10u);
}

TEST(Timer, external_clock_counts_rising_edges) {
  Bench b;
  b.outside.clock({Port::C, 3}, 1000, 50, 20, 100);  // T4CK
  b.write("T4CON", 0x8002, 10);
  EXPECT_EQ(b.read("TMR4", 1000), 0u);
  EXPECT_EQ(b.read("TMR4", 1001), 1u);  // the synchroniser's cycle
  EXPECT_EQ(b.read("TMR4", 1000 + 49 * 50 + 1), 50u);
}

// the camera driver: TMR5 = 0, PR5 = 1, one interrupt after ONE edge: edge 5000, tick 5001, flag 5002
TEST(Timer, camera_driver_gets_its_interrupt_after_one_edge) {
  Bench b;
  b.outside.clock({Port::C, 4}, 5000, 100000, 1000, 5);
  b.write("TMR5", 0, 10);
  b.write("PR5", 1, 10);
  b.write("T5CON", 0x8002, 10);
  EXPECT_EQ(b.flag_rises(irq::T5, 11), 5002);
  b.clear_flag(irq::T5, 5100);
  EXPECT_EQ(b.flag_rises(irq::T5, 5101), 205002);  // the next edge takes it to 0, the third to 1
}

// its line interrupt: TMR4 = 0, PR4 = 1, and the handler clears TMR4: one interrupt for each edge of HREF
TEST(Timer, camera_driver_gets_one_interrupt_a_line) {
  Bench b;
  b.outside.clock({Port::C, 3}, 10000, 2000, 1200, 20);
  b.write("PR4", 1, 10);
  b.write("T4CON", 0x8002, 10);
  Cycle from = 11;
  for (int line = 0; line < 10; ++line) {
    const Cycle flag = b.flag_rises(irq::T4, from);
    EXPECT_EQ(flag, 10000 + 2000 * line + 2);
    b.clear_flag(irq::T4, flag + 10);
    b.write("TMR4", 0, flag + 12);
    from = flag + 13;
  }
}

TEST(Timer, external_clock_with_prescaler) {
  Bench b;
  b.outside.clock({Port::C, 14}, 100, 10, 5, 1000);  // T1CK
  b.write("PR1", 3, 0);
  b.write("T1CON", 0x8012, 0);  // 1:8: 24 edges make TMR = 3
  EXPECT_EQ(b.flag_rises(irq::T1, 1), 100 + 23 * 10 + 1 + 1);
}

// high from 1000 to 1500: counts 500 cycles, the falling edge sets the flag
TEST(Timer, gate_counts_while_the_pin_is_high) {
  Bench b;
  b.outside.clock({Port::C, 14}, 1000, 2000, 500, 2);
  b.write("T1CON", 0x8040, 10);
  EXPECT_EQ(b.flag_rises(irq::T1, 11), 1500 + 1 + 1);
  EXPECT_EQ(b.read("TMR1", 2000), 500u);
  EXPECT_EQ(b.read("TMR1", 5000), 1000u);
}

TEST(Timer, what_nobody_waits_for_is_no_event) {
  Bench b;
  b.write("PR1", 1, 0);
  b.write("T1CON", 0x8000, 0);
  EXPECT_TRUE(b.flag(irq::T1, 10));
  EXPECT_EQ(b.chip.horizon(0x084, 1000), kNever);  // the flag stays
  EXPECT_EQ(b.chip.next_event(1000), kNever);
}

// flag at 102, cleared at 1050: matches at 203, 304 ... 1011 (nine of them) went unseen
TEST(Timer, matches_that_find_their_flag_set_are_counted_as_missed) {
  Bench b;
  b.enable(irq::T1, 0);
  b.write("PR1", 100, 0);
  b.write("T1CON", 0x8000, 0);
  b.chip.run_to(1049);
  EXPECT_EQ(b.chip.interrupts().missed(dspic::kFirstIrqVector + irq::T1, 1049), 9) << "the flag is still set";
  b.clear_flag(irq::T1, 1050);
  EXPECT_EQ(b.chip.interrupts().missed(dspic::kFirstIrqVector + irq::T1, 1050), 9);
  ASSERT_EQ(b.notes.count(dspic::Cause::MissedInterrupt), 1);
  EXPECT_EQ(b.flag_rises(irq::T1, 1051), 102 + 10 * 101);
  // a reset counts as well: 1112 sets it, 1213 to 1920 find it set
  b.chip.run_to(2000);
  b.chip.reset(dspic::ResetKind::Pin, 2000);
  EXPECT_EQ(b.chip.interrupts().missed(dspic::kFirstIrqVector + irq::T1, 2000), 9 + 8);
}

TEST(Timer, horizon_of_the_count_is_its_next_tick) {
  Bench b;
  b.write("T1CON", 0x8010, 0);
  EXPECT_EQ(b.chip.horizon(0x100, 5), 9);
  EXPECT_EQ(b.chip.horizon(0x100, 9), 17);
  EXPECT_EQ(b.chip.horizon(0x102, 9), kNever);
}

TEST(Timer, edges_that_the_chip_makes_itself_are_counted) {
  Bench b;
  b.write("TRISC", 0xE01E & ~0x0008u, 0);  // RC3 = T4CK is an output
  b.write("T4CON", 0x8002, 0);
  for (int i = 0; i < 5; ++i) {
    b.write("LATC", 0x0008, 100 + 20 * i);
    b.write("LATC", 0x0000, 110 + 20 * i);
  }
  EXPECT_EQ(b.read("TMR4", 300), 5u);
}

}  // namespace
