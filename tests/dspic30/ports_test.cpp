// SPDX-License-Identifier: MIT
// Ports, external interrupts and change notification.
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using bench::kNever;
using dspic::Cause;
using dspic::Pin;
using dspic::Port;
namespace irq = dspic::irq;

TEST(Ports, all_implemented_pins_are_inputs_after_reset) {
  Bench b;
  EXPECT_EQ(b.read("TRISA", 0), 0xF6C0u);
  EXPECT_EQ(b.read("TRISB", 0), 0xFFFFu);
  EXPECT_EQ(b.read("TRISC", 0), 0xE01Eu);
  EXPECT_EQ(b.read("TRISD", 0), 0xFFFFu);
  EXPECT_EQ(b.read("TRISF", 0), 0x01FFu);
  EXPECT_EQ(b.read("TRISG", 0), 0xF3CFu);
}

TEST(Ports, writing_port_or_latch_sets_the_latch) {
  Bench b;
  b.write("TRISA", 0, 10);
  b.write("PORTA", 0xFFFF, 11);
  EXPECT_EQ(b.read("LATA", 12), 0xF6C0u);  // unimplemented bits are not there
  EXPECT_EQ(b.read("PORTA", 13), 0xF6C0u);
  b.write("LATA", 0x0040, 14);
  EXPECT_EQ(b.read("PORTA", 15), 0xF6C0u);  // the levels of one cycle before
  EXPECT_EQ(b.read("PORTA", 16), 0x0040u);
}

TEST(Ports, outside_is_told_of_outputs_one_cycle_after_the_write) {
  Bench b;
  b.write("LATA", 0x0040, 10);
  const std::size_t before = b.outside.driven.size();
  EXPECT_EQ(b.outside.driven[before - 1].driven, 0);  // still an input
  b.write("TRISA", 0xF6C0 & ~0x0040u, 20);
  ASSERT_EQ(b.outside.driven.size(), before + 1);
  EXPECT_EQ(b.outside.driven.back().driven, 0x0040);
  EXPECT_EQ(b.outside.driven.back().levels, 0x0040);
  EXPECT_EQ(b.outside.driven.back().at, 21);
  b.write("TRISA", 0xF6C0 & ~0x0040u, 30);
  EXPECT_EQ(b.outside.driven.size(), before + 1);  // nothing new
}

TEST(Ports, port_reads_the_pins_and_latch_reads_the_latch) {
  Bench b;
  b.outside.wired[Port::G] = 0x03C0;
  b.outside.waves[Port::G] = {{0, 0x0340}, {500, 0x0080}};
  EXPECT_EQ(b.read("PORTG", 100) & 0x3C0, 0x0340u);
  EXPECT_EQ(b.read("LATG", 100), 0u);
  EXPECT_EQ(b.chip.horizon(0x2E6, 100), 500);
  EXPECT_EQ(b.chip.horizon(0x2E8, 100), kNever);
  EXPECT_EQ(b.read("PORTG", 500) & 0x3C0, 0x0080u);
}

TEST(Ports, analogue_pins_read_zero) {
  Bench b;
  b.outside.wired[Port::B] = 0x0003;
  b.outside.waves[Port::B][0] = 0x0003;
  EXPECT_EQ(b.read("PORTB", 10), 0u);
  EXPECT_EQ(b.notes.count(Cause::DigitalAnalogue), 2);
  b.write("ADPCFG", 0x0001, 11);
  EXPECT_EQ(b.read("PORTB", 12), 1u);
  EXPECT_EQ(b.notes.count(Cause::DigitalAnalogue), 2);
  EXPECT_EQ(b.notes.all[0].place, "ADPCFG.PCFG0");
}

TEST(Ports, byte_writes_touch_one_lane) {
  Bench b;
  b.write("LATD", 0x1234, 1);
  b.chip.write(0x2D7, 0xAB, 8, 2);
  EXPECT_EQ(b.read("LATD", 3), 0xAB34u);
  b.chip.write(0x2D6, 0xCD, 8, 4);
  EXPECT_EQ(b.read("LATD", 5), 0xABCDu);
  EXPECT_EQ(b.chip.read(0x2D7, 8, 6), 0xAB);
}

// on silicon the second of two adjacent bit operations on PORT reads the pins of one cycle before
TEST(Ports, synchronised_reads_lag_by_a_cycle) {
  Bench b;
  b.write("TRISA", 0, 0);
  b.set("PORTA", 0x0040, 10);
  b.set("PORTA", 0x0080, 11);
  EXPECT_EQ(b.read("LATA", 12), 0x0080u);  // the first bit is lost
  b.write("LATA", 0, 20);
  b.set("PORTA", 0x0040, 30);
  b.set("PORTA", 0x0080, 32);  // with a NOP between
  EXPECT_EQ(b.read("LATA", 33), 0x00C0u);
}

TEST(Ports, latch_of_an_input_that_is_toggled_is_named_once) {
  Bench b;
  for (int i = 0; i < 6; ++i) b.write("LATA", i & 1 ? 0 : 0x40, 10 + i);
  ASSERT_EQ(b.notes.count(Cause::InputDriven), 1);
  EXPECT_EQ(b.notes.all[0].place, "TRISA6");
  b.write("TRISA", 0xF680, 30);
  for (int i = 0; i < 6; ++i) b.write("LATA", i & 1 ? 0 : 0x40, 40 + i);
  EXPECT_EQ(b.notes.count(Cause::InputDriven), 1);
}

TEST(Ports, setting_latches_before_directions_is_no_mistake) {
  Bench b;
  b.write("LATA", 0xFFFF, 1);
  b.write("LATA", 0, 2);
  b.write("TRISA", 0, 3);
  for (int i = 0; i < 6; ++i) b.write("LATA", i & 1 ? 0 : 0x40, 10 + i);
  EXPECT_EQ(b.notes.count(Cause::InputDriven), 0);
}

TEST(Ports, bit_operations_beside_moving_inputs_are_no_mistake) {
  Bench b;
  b.outside.wired[Port::G] = 0x0040;
  for (int i = 0; i < 50; ++i) b.outside.waves[Port::G][100 * i] = i & 1 ? 0x40 : 0;
  b.write("TRISG", 0xF3CE, 1);  // RG0 is an output
  for (int i = 0; i < 40; ++i) {
    const unsigned word = b.read("PORTG", 50 + 100 * i);
    b.write("PORTG", word ^ 1, 50 + 100 * i);
  }
  EXPECT_EQ(b.notes.count(Cause::InputDriven), 0);
}

// --- INT0 to INT4

TEST(ExternalInterrupt, flag_comes_two_cycles_after_its_edge) {
  Bench b;
  b.outside.clock({Port::F, 6}, 1000, 500, 100, 4);
  b.chip.outside_changed(0);
  EXPECT_EQ(b.flag_rises(irq::Int0, 1), 1002);
  b.write("INTCON2", 1, 1010);  // falling
  b.clear_flag(irq::Int0, 1011);
  EXPECT_EQ(b.flag_rises(irq::Int0, 1012), 1102);
}

TEST(ExternalInterrupt, edges_while_the_flag_is_set_are_missed) {
  const struct {
    Pin pin;
    int irq;
  } kLines[] = {{{Port::F, 6}, irq::Int0},
                {{Port::A, 12}, irq::Int1},
                {{Port::A, 13}, irq::Int2},
                {{Port::A, 14}, irq::Int3},
                {{Port::A, 15}, irq::Int4}};
  for (const auto& line : kLines) {
    Bench b;
    b.outside.clock(line.pin, 1000, 100, 50, 10);
    b.chip.outside_changed(0);
    b.enable(line.irq, 0);
    b.clear_flag(line.irq, 1450);  // edges at 1100, 1200, 1300, 1400
    EXPECT_EQ(b.chip.interrupts().missed(dspic::kFirstIrqVector + line.irq, 1450), 4) << line.irq;
    EXPECT_EQ(b.flag_rises(line.irq, 1451), 1502);
  }
}

TEST(ExternalInterrupt, outside_that_changes_its_mind_is_asked_again) {
  Bench b;
  EXPECT_EQ(b.chip.horizon(0x084, 100), kNever);
  b.outside.clock({Port::F, 6}, 5000, 100, 50, 1);
  b.chip.outside_changed(200);
  EXPECT_EQ(b.flag_rises(irq::Int0, 201), 5002);
}

TEST(ExternalInterrupt, pin_driven_by_the_chip_itself_works_too) {
  Bench b;
  b.write("TRISA", 0xF6C0 & ~0x1000u, 0);
  b.write("LATA", 0x1000, 100);
  EXPECT_EQ(b.flag_rises(irq::Int1, 100), 103);
}

// --- change notification

TEST(ChangeNotification, enabled_pin_that_changes_sets_the_flag) {
  Bench b;
  b.outside.clock({Port::G, 6}, 1000, 1000, 300, 2);  // CN8
  b.write("CNEN1", 0x0100, 10);
  EXPECT_EQ(b.flag_rises(irq::Cn, 11), 1002);
  b.read("PORTG", 1010);
  b.clear_flag(irq::Cn, 1011);
  EXPECT_EQ(b.flag_rises(irq::Cn, 1012), 1302);
}

TEST(ChangeNotification, return_to_what_was_read_is_no_mismatch) {
  Bench b;
  b.outside.clock({Port::G, 6}, 1000, 1000, 300, 1);
  b.write("CNEN1", 0x0100, 10);
  b.flag_rises(irq::Cn, 11);
  b.clear_flag(irq::Cn, 1100);  // without reading the port
  EXPECT_EQ(b.flag_rises(irq::Cn, 1101, 100000), -1);
}

TEST(ChangeNotification, other_pins_do_not_count) {
  Bench b;
  b.outside.clock({Port::G, 7}, 1000, 1000, 300, 5);
  b.write("CNEN1", 0x0100, 10);
  EXPECT_EQ(b.flag_rises(irq::Cn, 11, 100000), -1);
}

// CN0 to CN23 [DS70143 pins]: each has a bit of its own in CNEN1, CNEN2, CNPU1 and CNPU2
constexpr Pin kInputs[] = {{Port::C, 14}, {Port::C, 13}, {Port::B, 0},  {Port::B, 1}, {Port::B, 2},
                           {Port::B, 3},  {Port::B, 4},  {Port::B, 5},  {Port::G, 6}, {Port::G, 7},
                           {Port::G, 8},  {Port::G, 9},  {Port::B, 15}, {Port::D, 4}, {Port::D, 5},
                           {Port::D, 6},  {Port::D, 7},  {Port::F, 4},  {Port::F, 5}, {Port::D, 13},
                           {Port::D, 14}, {Port::D, 15}, {Port::A, 6},  {Port::A, 7}};
constexpr std::pair<const char*, Port> kAllPorts[] = {{"PORTA", Port::A}, {"PORTB", Port::B},
                                                      {"PORTC", Port::C}, {"PORTD", Port::D},
                                                      {"PORTF", Port::F}, {"PORTG", Port::G}};

TEST(ChangeNotification, each_input_has_its_bit) {
  for (int n = 0; n < 24; ++n)
    for (const bool others : {false, true}) {
      Bench b;
      b.write("ADPCFG", 0xFFFF, 0);
      b.outside.clock(kInputs[n], 1000, 1000, 300, 1);
      const auto own = static_cast<std::uint32_t>(1u << n), enabled = others ? 0xFFFFFFu & ~own : own;
      b.write("CNEN1", enabled & 0xFFFF, 10);
      b.write("CNEN2", enabled >> 16, 10);
      EXPECT_EQ(b.flag_rises(irq::Cn, 11, 5000), others ? -1 : 1002) << "CN" << n;
      EXPECT_EQ(b.read("CNEN2", 5001) << 16 | b.read("CNEN1", 5001), enabled);
    }
}

TEST(ChangeNotification, pull_ups_lift_open_pins) {
  for (int n = 0; n < 24; ++n) {
    Bench b;
    b.write("ADPCFG", 0xFFFF, 0);
    b.write(n < 16 ? "CNPU1" : "CNPU2", 1u << n % 16, 2);
    for (const auto& [name, port] : kAllPorts)
      EXPECT_EQ(b.read(name, 3), port == kInputs[n].port ? 1u << kInputs[n].bit : 0u) << "CN" << n;
  }
}

}  // namespace
