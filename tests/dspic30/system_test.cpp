// SPDX-License-Identifier: MIT
// Resets, watchdog, oscillator, low-voltage detector, EEPROM, module disable, CAN's mode.
// 2 ms are 29491.2 cycles of FCY = 14.7456 MHz.
#include "dspic30/device/chip_parts.h"
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using bench::kNever;
using dspic::Cause;
using dspic::ResetKind;
namespace irq = dspic::irq;

TEST(Reset, rcon_tells_why) {
  Bench b;
  EXPECT_EQ(b.read("RCON", 0) & 0xF0FF, 0x0003u);
  b.write("RCON", 0, 1);
  const std::pair<ResetKind, unsigned> kinds[] = {
      {ResetKind::Instruction, 0x0040},   {ResetKind::Pin, 0x0080},
      {ResetKind::Watchdog, 0x0010},      {ResetKind::BrownOut, 0x0002},
      {ResetKind::IllegalOpcode, 0x4000}, {ResetKind::TrapConflict, 0x8000}};
  unsigned sticky = 0;
  Cycle now = 10;
  for (const auto& [kind, bit] : kinds) {
    b.chip.reset(kind, now++);
    sticky |= bit;
    EXPECT_EQ(b.read("RCON", now) & 0xF0FF, sticky);
  }
  b.chip.reset(ResetKind::PowerOn, now);
  EXPECT_EQ(b.read("RCON", now) & 0xF0FF, 0x0003u);
}

TEST(Reset, peripherals_stop_and_registers_return) {
  Bench b;
  b.write("PR1", 10, 0);
  b.write("T1CON", 0x8000, 0);
  b.enable(irq::T1, 0);
  b.write("TRISA", 0, 0);
  b.chip.parts().interrupts.set_level(5, 0);
  b.chip.reset(ResetKind::Instruction, 100);
  EXPECT_EQ(b.read("PR1", 101), 0xFFFFu);
  EXPECT_EQ(b.read("T1CON", 101), 0u);
  EXPECT_EQ(b.read("IEC0", 101), 0u);
  EXPECT_EQ(b.read("IFS0", 5000), 0u);
  EXPECT_EQ(b.read("TRISA", 101), 0xF6C0u);
  EXPECT_EQ(b.chip.interrupts().cpu_level(), 0);
  EXPECT_EQ(b.outside.driven.back().driven, 0);
}

// FWDT 0x8000 | A 1:8 | B 1:3 -> 2 ms x 8 x 3 = 48 ms = 707788.8 cycles
TEST(Watchdog, bites_after_its_time) {
  dspic::Configuration c;
  c.fwdt = 0x8000 | 1 << 4 | 2;
  Bench b(c);
  EXPECT_EQ(b.chip.next_event(0), 707789);
  EXPECT_FALSE(b.chip.reset_due(707788).has_value());
  ASSERT_TRUE(b.chip.reset_due(707789).has_value());
  EXPECT_EQ(*b.chip.reset_due(707789), ResetKind::Watchdog);
  b.chip.reset(ResetKind::Watchdog, 707789);
  EXPECT_EQ(b.read("RCON", 707790) & 0x10, 0x10u);
  EXPECT_EQ(b.notes.count(Cause::WatchdogReset), 1);
}

TEST(Watchdog, clearing_starts_its_time_again) {
  dspic::Configuration c;
  c.fwdt = 0x8000;  // 2 ms
  Bench b(c);
  for (Cycle now = 20000; now < 200000; now += 20000) b.chip.clear_watchdog(now);
  EXPECT_FALSE(b.chip.reset_due(180000 + 29490).has_value());
  EXPECT_TRUE(b.chip.reset_due(180000 + 29491).has_value());
}

TEST(Watchdog, shortest_and_longest_time) {
  dspic::Configuration c;
  c.fwdt = 0x8000;
  EXPECT_EQ(Bench(c).chip.next_event(0), 29491);
  c.fwdt = 0x803F;  // 512 x 16 x 2 ms = 16.384 s
  EXPECT_EQ(Bench(c).chip.next_event(0), 241591910);
}

TEST(Watchdog, software_may_switch_it_on) {
  Bench b;  // the e-puck's FWDT: off, longest time
  EXPECT_EQ(b.chip.next_event(0), kNever);
  b.set("RCON", 0x20, 1000);
  EXPECT_EQ(b.chip.next_event(1000), 1000 + 241591910);
  b.clear("RCON", 0x20, 2000);
  EXPECT_EQ(b.chip.next_event(2000), kNever);
}

TEST(Oscillator, reset_value_is_the_configured_source) {
  Bench b;
  EXPECT_EQ(b.read("OSCCON", 0), 0x7720u);
}

TEST(Oscillator, bytes_need_their_unlock_sequence) {
  Bench b;
  b.write("OSCCON", 0x0300, 1);  // as a word: no
  EXPECT_EQ(b.read("OSCCON", 2), 0x7720u);
  b.chip.write(0x743, 0x01, 8, 3);  // without the keys: no
  EXPECT_EQ(b.read("OSCCON", 4), 0x7720u);
  EXPECT_EQ(b.notes.count(Cause::NotUnlocked), 1);
  b.chip.write(0x743, 0x78, 8, 5);
  b.chip.write(0x743, 0x9A, 8, 6);
  b.chip.write(0x743, 0x01, 8, 7);
  EXPECT_EQ(b.read("OSCCON", 8), 0x7120u);
  b.chip.write(0x743, 0x78, 8, 9);
  b.chip.write(0x743, 0x9A, 8, 10);
  b.write("LATA", 0, 11);  // in between: no
  b.chip.write(0x743, 0x02, 8, 12);
  EXPECT_EQ(b.read("OSCCON", 13), 0x7120u);
}

TEST(LowVoltage, flag_rises_below_the_chosen_threshold) {
  Bench b;
  b.write("RCON", 0x1000 | 7 << 8, 1);             // 3.0 V
  EXPECT_EQ(b.read("RCON", 2) & 0x2000, 0x2000u);  // BGST
  EXPECT_FALSE(b.flag(irq::Lvd, 10));
  b.outside.supply = 2.9;
  b.chip.outside_changed(100);
  EXPECT_TRUE(b.flag(irq::Lvd, 101));
}

struct Eeprom : ::testing::Test {
  Bench b;
  /// Key sequence and WR, as the library's assembler does it.
  void go(unsigned operation, Cycle now) {
    b.write("NVMCON", operation, now);
    b.write("NVMKEY", 0x55, now + 1);
    b.write("NVMKEY", 0xAA, now + 2);
    b.set("NVMCON", 0x8000, now + 3);
  }
};

TEST_F(Eeprom, word_is_erased_and_written) {
  EXPECT_EQ(b.chip.table_read(0x7FF000, 0), 0xFFFF);
  b.chip.table_write(0x7FF004, 0x1234, 1);
  go(0x4004, 2);
  EXPECT_EQ(b.read("NVMCON", 6) & 0x8000, 0x8000u);
  EXPECT_EQ(b.read("NVMADR", 6), 0xF004u);
  EXPECT_EQ(b.read("NVMADRU", 6), 0x7Fu);
  EXPECT_EQ(b.chip.horizon(0x760, 10), 5 + 29491);
  EXPECT_EQ(b.flag_rises(irq::Nvm, 10), 5 + 29491);
  EXPECT_EQ(b.read("NVMCON", 5 + 29491) & 0x8000, 0u);
  EXPECT_EQ(b.chip.table_read(0x7FF004, 30000), 0x1234);
  EXPECT_LE(b.chip.stalled_until(), 30000);  // EEPROM does not hold the processor
  // the latches are empty again: another word of the same latch is written with ones
  b.write("NVMADR", 0xF044, 30001);
  go(0x4004, 30002);
  EXPECT_EQ(b.chip.table_read(0x7FF044, 60000), 0xFFFF);
  // programming clears bits only
  b.chip.table_write(0x7FF004, 0xFF0F, 70000);
  go(0x4004, 70001);
  EXPECT_EQ(b.chip.table_read(0x7FF004, 110000), 0x1204);
  b.write("NVMADR", 0xF004, 110001);
  go(0x4044, 110002);
  EXPECT_EQ(b.chip.table_read(0x7FF004, 150000), 0xFFFF);
}

TEST_F(Eeprom, row_of_sixteen_words) {
  for (unsigned i = 0; i < 16; ++i) b.chip.table_write(0x7FF020 + 2 * i, static_cast<std::uint16_t>(i), 1);
  go(0x4005, 2);
  for (unsigned i = 0; i < 16; ++i) EXPECT_EQ(b.chip.table_read(0x7FF020 + 2 * i, 40000), i);
  EXPECT_EQ(b.chip.table_read(0x7FF040, 40000), 0xFFFF);
  go(0x4045, 40001);  // NVMADR points into the row
  for (unsigned i = 0; i < 16; ++i) EXPECT_EQ(b.chip.table_read(0x7FF020 + 2 * i, 80000), 0xFFFF);
}

TEST_F(Eeprom, without_the_keys_nothing_happens) {
  b.chip.table_write(0x7FF000, 0, 1);
  b.write("NVMCON", 0x4004, 2);
  b.set("NVMCON", 0x8000, 3);
  EXPECT_EQ(b.read("NVMCON", 4) & 0x8000, 0u);
  b.write("NVMKEY", 0x55, 5);
  b.write("LATA", 0, 6);  // an interrupt handler comes in between
  b.write("NVMKEY", 0xAA, 7);
  b.set("NVMCON", 0x8000, 8);
  b.write("NVMKEY", 0x55, 10);
  b.write("NVMKEY", 0xAA, 11);
  b.write("LATA", 0, 12);
  b.set("NVMCON", 0x8000, 13);
  EXPECT_EQ(b.chip.table_read(0x7FF000, 80000), 0xFFFF);
  EXPECT_EQ(b.notes.count(Cause::NotUnlocked), 1);
}

TEST_F(Eeprom, without_wren_nothing_happens) {
  b.chip.table_write(0x7FF000, 0, 1);
  go(0x0004, 2);
  EXPECT_EQ(b.chip.table_read(0x7FF000, 80000), 0xFFFF);
}

TEST_F(Eeprom, flash_operation_holds_the_processor) {
  go(0x4041, 2);
  EXPECT_EQ(b.chip.stalled_until(), 5 + 29491);
}

TEST_F(Eeprom, survives_resets) {
  b.chip.eeprom()[5] = 77;
  b.chip.reset(ResetKind::PowerOn, 10);
  EXPECT_EQ(b.chip.table_read(0x7FF00A, 11), 77);
}

TEST(ModuleDisable, registers_fall_silent) {
  Bench b;
  b.write("PR2", 100, 0);
  b.write("T2CON", 0x8000, 0);
  b.write("PMD1", 1 << 12, 50);
  EXPECT_EQ(b.read("T2CON", 51), 0u);
  b.write("PR2", 5, 52);
  EXPECT_FALSE(b.flag(irq::T2, 5000));
  b.write("PMD1", 0, 5001);
  EXPECT_EQ(b.read("PR2", 5002), 0xFFFFu);
  b.write("T2CON", 0x8000, 5003);
  EXPECT_EQ(b.read("TMR2", 5014), 10u);
}

// chips of which the same is known share it, until one switches a module off
TEST(ModuleDisable, is_each_chips_own) {
  Bench a, b;
  for (Bench* one : {&a, &b}) one->chip.parts().bus.share();
  for (Bench* one : {&a, &b}) one->write("PR2", 100, 0);
  a.write("PMD1", 1 << 12, 50);
  EXPECT_EQ(a.read("PR2", 51), 0u);
  EXPECT_EQ(b.read("PR2", 51), 100u);
  b.write("PR3", 7, 60);
  const auto wrote = [](Bench& one, const char* name) {
    return one.chip.parts().bus.was_written(Bench::at(name));
  };
  EXPECT_TRUE(wrote(b, "PR3"));
  EXPECT_FALSE(wrote(a, "PR3"));
  a.write("PMD1", 0, 70);
  EXPECT_EQ(a.read("PR2", 71), 0xFFFFu);
}

TEST(Can, operating_mode_follows_the_request) {
  Bench b;
  EXPECT_EQ(b.read("C1CTRL", 0), 0x0480u);
  b.write("C1CTRL", 0x0000, 10);
  EXPECT_EQ(b.read("C1CTRL", 13) >> 5 & 7, 4u);
  EXPECT_EQ(b.chip.horizon(0x390, 13), 14);
  EXPECT_EQ(b.read("C1CTRL", 14) >> 5 & 7, 0u);
}

}  // namespace
