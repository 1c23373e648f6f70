// SPDX-License-Identifier: MIT
// Interrupt controller: acceptance, latency, priorities, nesting, DISI, traps.
#include "dspic30/device/chip_parts.h"
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using bench::kNever;
namespace irq = dspic::irq;

constexpr int vector(int i) { return dspic::kFirstIrqVector + i; }

struct Interrupts : ::testing::Test {
  Bench b;
  /// Software sets the flag in cycle `now`.
  void request(int i, Cycle now) { b.set("IFS" + std::to_string(i / 16), 1u << i % 16, now); }
};

// the flag is set in f; the instruction of cycle f completes; f+1 to f+3 pass; the handler begins in f+4
TEST_F(Interrupts, handler_begins_four_cycles_after_the_flag) {
  b.enable(irq::T1, 0);
  b.write("PR1", 99, 0);
  b.write("T1CON", 0x8000, 0);
  const Cycle flag = 1 + 99 + 1;
  EXPECT_EQ(b.chip.next_event(10), flag + 1);
  EXPECT_EQ(b.chip.interrupts().pending(flag), dspic::kNoVector);
  EXPECT_EQ(b.chip.interrupts().pending(flag + 1), vector(irq::T1));
  const auto entry = b.chip.interrupts().enter(vector(irq::T1), flag + 1);
  EXPECT_EQ(entry.first_instruction, flag + 4);
  EXPECT_EQ(entry.level, 4);
  EXPECT_EQ(entry.address, 0x1Au);
}

TEST_F(Interrupts, return_takes_three_cycles_and_one_instruction_runs_between_two_handlers) {
  b.enable(irq::T1, 0);
  b.enable(irq::T2, 0);
  request(irq::T1, 10);
  request(irq::T2, 10);
  ASSERT_EQ(b.chip.interrupts().pending(20), vector(irq::T1));
  b.chip.interrupts().enter(vector(irq::T1), 20);
  EXPECT_EQ(b.chip.interrupts().pending(30), dspic::kNoVector);  // same priority
  b.clear_flag(irq::T1, 30);
  EXPECT_EQ(b.chip.interrupts().leave(40), 43);
  EXPECT_EQ(b.chip.interrupts().pending(43), dspic::kNoVector);
  EXPECT_EQ(b.chip.next_event(43), 44);
  EXPECT_EQ(b.chip.interrupts().pending(44), vector(irq::T2));
}

TEST_F(Interrupts, software_can_force_an_interrupt) {
  b.enable(irq::U1Rx, 0);
  request(irq::U1Rx, 100);
  EXPECT_EQ(b.chip.interrupts().pending(101),
            dspic::kNoVector);  // set from 101 on, seen from the boundary 102 on
  EXPECT_EQ(b.chip.next_event(100), 102);
  EXPECT_EQ(b.chip.interrupts().pending(102), vector(irq::U1Rx));
}

TEST_F(Interrupts, higher_priority_nests_and_equal_priority_waits) {
  b.write("IPC0", 0x2000, 0);  // T1 2
  b.write("IPC1", 0x0500, 0);  // T2 5
  b.enable(irq::T1, 0);
  b.enable(irq::T2, 0);
  request(irq::T1, 10);
  b.chip.interrupts().enter(vector(irq::T1), 12);
  EXPECT_EQ(b.chip.interrupts().cpu_level(), 2);
  request(irq::T2, 20);
  EXPECT_EQ(b.chip.interrupts().pending(22), vector(irq::T2));
  b.chip.interrupts().enter(vector(irq::T2), 22);
  EXPECT_EQ(b.chip.interrupts().cpu_level(), 5);
  EXPECT_EQ(b.chip.interrupts().nesting(), 2);
  b.chip.interrupts().leave(40);
  EXPECT_EQ(b.chip.interrupts().cpu_level(), 2);
  b.chip.interrupts().leave(50);
  EXPECT_EQ(b.chip.interrupts().cpu_level(), 0);
}

TEST_F(Interrupts, among_equals_the_lower_vector_wins) {
  for (const int i : {irq::Dci, irq::Adc, irq::T4}) {
    b.enable(i, 0);
    request(i, 5);
  }
  EXPECT_EQ(b.chip.interrupts().pending(10), vector(irq::Adc));
}

TEST_F(Interrupts, priority_zero_switches_a_source_off) {
  b.enable(irq::T1, 0);
  b.write("IPC0", 0x0444, 0);
  request(irq::T1, 5);
  EXPECT_EQ(b.chip.interrupts().pending(10), dspic::kNoVector);
  EXPECT_FALSE(b.chip.interrupts().wakes(10));
}

TEST_F(Interrupts, nstdis_runs_every_handler_at_level_7) {
  b.write("INTCON1", 0x8000, 0);
  b.write("IPC1", 0x7000, 0);  // T3 7
  b.enable(irq::T1, 0);
  b.enable(irq::T3, 0);
  request(irq::T1, 5);
  EXPECT_EQ(b.chip.interrupts().enter(vector(irq::T1), 7).level, 7);
  request(irq::T3, 10);
  EXPECT_EQ(b.chip.interrupts().pending(20), dspic::kNoVector);
  b.write("SR", 0, 20);  // IPL is read-only
  EXPECT_EQ(b.chip.interrupts().cpu_level(), 7);
}

TEST_F(Interrupts, sr_ipl_masks_levels_up_to_its_own) {
  b.enable(irq::T1, 0);
  b.write("SR", 4 << 5, 0);
  request(irq::T1, 5);
  EXPECT_EQ(b.chip.interrupts().pending(10), dspic::kNoVector);
  EXPECT_TRUE(b.chip.interrupts().wakes(10));
  b.write("SR", 3 << 5, 11);
  EXPECT_EQ(b.chip.interrupts().pending(12), vector(irq::T1));
  EXPECT_EQ(b.read("SR", 12), 3u << 5);
}

// DISI #10 in cycle 100: blocked from 100 to 110, DISICNT 10 at 101 and 0 at 111
TEST_F(Interrupts, disi_holds_priorities_below_7_for_count_plus_one_cycles) {
  b.enable(irq::T1, 0);
  b.write("IPC1", 0x7444, 0);
  b.chip.interrupts().disi(10, 100);
  request(irq::T1, 101);
  EXPECT_EQ(b.read("DISICNT", 101), 10u);
  EXPECT_EQ(b.read("DISICNT", 110), 1u);
  EXPECT_EQ(b.read("INTCON2", 110) & 0x4000, 0x4000u);
  EXPECT_EQ(b.chip.interrupts().pending(110), dspic::kNoVector);
  EXPECT_EQ(b.chip.next_event(103), 111);
  EXPECT_EQ(b.chip.interrupts().pending(111), vector(irq::T1));
  EXPECT_EQ(b.read("INTCON2", 111) & 0x4000, 0u);
}

TEST_F(Interrupts, disi_does_not_hold_priority_7_and_ends_when_the_count_is_written) {
  b.write("IPC1", 0x7444, 0);  // T3 7
  b.enable(irq::T3, 0);
  b.enable(irq::T1, 0);
  b.chip.interrupts().disi(1000, 100);
  request(irq::T1, 110);
  EXPECT_EQ(b.chip.interrupts().pending(120), dspic::kNoVector);
  request(irq::T3, 121);
  EXPECT_EQ(b.chip.interrupts().pending(125), vector(irq::T3));
  b.clear_flag(irq::T3, 126);
  b.write("DISICNT", 0, 130);
  EXPECT_EQ(b.chip.interrupts().pending(131), vector(irq::T1));
}

TEST_F(Interrupts, alternate_table_moves_the_vectors_by_0x80) {
  b.write("INTCON2", 0x8000, 0);
  b.enable(irq::T1, 0);
  request(irq::T1, 5);
  EXPECT_EQ(b.chip.interrupts().enter(vector(irq::T1), 8).address, 0x9Au);
}

TEST_F(Interrupts, flag_set_between_read_and_write_of_one_instruction_survives) {
  b.write("PR1", 9, 0);
  b.write("T1CON", 0x8000, 0);  // flag at 11
  const unsigned before = b.read("IFS0", 10);
  b.write("IFS0", before & ~0x40u, 11);  // _T2IF = 0
  EXPECT_TRUE(b.flag(irq::T1, 12));
  b.write("IFS0", 0, 100);  // clears what was there to be seen
  EXPECT_FALSE(b.flag(irq::T1, 100));
}

TEST_F(Interrupts, priorities_read_back) {
  EXPECT_EQ(b.read("IPC0", 0), 0x4444u);
  EXPECT_EQ(b.read("IPC9", 0), 0x0444u);
  EXPECT_EQ(b.read("IPC10", 0), 0x0440u);
  b.write("IPC2", 0x6513, 1);
  EXPECT_EQ(b.read("IPC2", 2), 0x6513u);
  EXPECT_EQ(b.chip.interrupts().priority(vector(irq::Adc)), 6);
}

TEST_F(Interrupts, traps_stand_above_all_interrupts) {
  b.write("IPC0", 0x7444, 0);
  b.enable(irq::T1, 0);
  request(irq::T1, 5);
  b.chip.interrupts().raise_trap(dspic::Trap::MathError, 6);
  EXPECT_EQ(b.chip.interrupts().pending(8), 4);
  const auto entry = b.chip.interrupts().enter(4, 8);
  EXPECT_EQ(entry.level, 11);
  EXPECT_EQ(entry.address, 0x0Cu);
  EXPECT_EQ(b.read("INTCON1", 9), 0x0010u);
  EXPECT_EQ(b.read("CORCON", 9) & 0x8, 0x8u);  // IPL3
  EXPECT_EQ(b.chip.interrupts().pending(20), dspic::kNoVector);
  b.clear("INTCON1", 0x10, 21);
  b.chip.interrupts().leave(30);
  EXPECT_EQ(b.chip.interrupts().pending(34), vector(irq::T1));
}

TEST_F(Interrupts, trap_levels_are_14_13_12_11) {
  const int levels[] = {14, 13, 12, 11};
  for (int trap = 1; trap <= 4; ++trap) {
    Bench fresh;
    fresh.chip.interrupts().raise_trap(static_cast<dspic::Trap>(trap), 1);
    ASSERT_EQ(fresh.chip.interrupts().pending(2), trap);
    EXPECT_EQ(fresh.chip.interrupts().enter(trap, 2).level, levels[trap - 1]);
  }
}

TEST_F(Interrupts, hard_trap_during_a_hard_trap_asks_for_a_reset) {
  b.chip.interrupts().raise_trap(dspic::Trap::AddressError, 5);
  b.chip.interrupts().enter(2, 6);
  EXPECT_FALSE(b.chip.reset_due(7).has_value());
  b.chip.interrupts().raise_trap(dspic::Trap::AddressError, 8);
  ASSERT_TRUE(b.chip.reset_due(9).has_value());
  b.chip.reset(*b.chip.reset_due(9), 9);
  EXPECT_EQ(b.read("RCON", 10) & 0x8000, 0x8000u);
  EXPECT_FALSE(b.chip.reset_due(10).has_value());
}

// timers of short periods, lowered now and then: some matches find their flag set
TEST(LowerFlags, is_reading_and_writing_the_flags_in_one) {
  bench::Bench plain, quick;
  for (bench::Bench* b : {&plain, &quick}) {
    b->write("IEC0", 0x0048, 0);  // T1, T2
    b->write("IFS0", 0, 0);
    b->write("PR1", 39, 1);
    b->write("PR2", 56, 1);
    b->write("T1CON", 0x8000, 2);
    b->write("T2CON", 0x8000, 2);
  }
  constexpr unsigned kIfs0 = dspic::sfr("IFS0");
  std::uint32_t state = 1;
  int taken = 0;
  Cycle now = 10;
  for (int i = 0; i < 2000; ++i) {
    state = state * 1664525 + 1013904223;
    now += 1 + (state >> 24) % 60;
    const auto keep = static_cast<std::uint16_t>(~(state >> 20 & 1 ? 0x0008u : 0x0040u));
    plain.chip.write(kIfs0, plain.chip.read(kIfs0, 16, now) & keep, 16, now);
    dspic::ChipParts& parts = quick.chip.parts();
    parts.events.run_to(now);
    if (parts.lower_flags(kIfs0, keep, now))
      ++taken;
    else
      quick.chip.write(kIfs0, quick.chip.read(kIfs0, 16, now) & keep, 16, now);
    ASSERT_EQ(plain.chip.peek(kIfs0, now), quick.chip.peek(kIfs0, now)) << i;
    ASSERT_EQ(plain.chip.next_event(now), quick.chip.next_event(now)) << i;
  }
  for (int irq : {irq::T1, irq::T2}) {
    EXPECT_GT(plain.chip.interrupts().missed(vector(irq), now), 100);
    EXPECT_EQ(plain.chip.interrupts().missed(vector(irq), now),
              quick.chip.interrupts().missed(vector(irq), now));
  }
  EXPECT_GT(taken, 1000);
  EXPECT_LT(taken, 2000);  // a timer that has been missed hears of it
}

TEST_F(Interrupts, handler_that_never_clears_its_flag_is_named) {
  b.enable(irq::T2, 0);
  request(irq::T2, 5);
  for (int i = 0; i < 3; ++i) {
    b.chip.interrupts().enter(vector(irq::T2), 10 + 20 * i);
    b.chip.interrupts().leave(20 + 20 * i);
  }
  ASSERT_EQ(b.notes.count(dspic::Cause::FlagNeverCleared), 1);
  EXPECT_EQ(b.notes.all[0].place, "T2");
  EXPECT_EQ(
      b.notes.all[0].message,
      "the handler of T2 returns without clearing IFS0.T2IF, so it is entered again at once and the main "
      "program hardly runs");
}

TEST_F(Interrupts, trap_handler_that_never_clears_its_flag_is_named) {
  auto& interrupts = b.chip.interrupts();
  const int math = static_cast<int>(dspic::Trap::MathError);
  const auto handle = [&](bool clears, dspic::Cycle at) {
    interrupts.raise_trap(dspic::Trap::MathError, at);
    interrupts.enter(math, at);
    if (clears) b.clear("INTCON1", 0x10, at + 5);
    interrupts.leave(at + 10);
  };
  for (bool clears : {false, true, false}) handle(clears, 10);  // not twice in turn
  EXPECT_EQ(b.notes.count(dspic::Cause::FlagNeverCleared), 0);
  handle(false, 100);
  ASSERT_EQ(b.notes.count(dspic::Cause::FlagNeverCleared), 1);
  EXPECT_EQ(b.notes.all[0].place, "MathError");
  EXPECT_EQ(b.notes.all[0].message,
            "the handler of MathError returns without clearing INTCON1.MATHERR, so it is entered again at "
            "once and the program does not go on");
}

TEST_F(Interrupts, handler_that_clears_its_flag_is_not) {
  b.enable(irq::T2, 0);
  for (int i = 0; i < 5; ++i) {
    request(irq::T2, 5 + 100 * i);
    b.chip.interrupts().enter(vector(irq::T2), 10 + 100 * i);
    b.clear_flag(irq::T2, 15 + 100 * i);
    request(irq::T2, 18 + 100 * i);  // at once again: an event of its own
    b.chip.interrupts().leave(20 + 100 * i);
    b.clear_flag(irq::T2, 25 + 100 * i);
  }
  EXPECT_EQ(b.notes.count(dspic::Cause::FlagNeverCleared), 0);
  EXPECT_EQ(b.chip.interrupts().served(vector(irq::T2)), 5);
}

TEST_F(Interrupts, names_follow_the_vendors) {
  EXPECT_STREQ(dspic::vector_name(vector(irq::T1)), "T1");
  EXPECT_STREQ(dspic::vector_name(vector(irq::Dci)), "DCI");
  EXPECT_STREQ(dspic::vector_name(vector(irq::C2)), "C2");
  EXPECT_STREQ(dspic::vector_name(vector(irq::U2Tx)), "U2TX");
  EXPECT_STREQ(dspic::vector_name(vector(39)), "?");
  EXPECT_STREQ(dspic::vector_name(-1), "?");
}

}  // namespace
