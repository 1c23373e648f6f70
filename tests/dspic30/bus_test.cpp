// SPDX-License-Identifier: MIT
// The register space as the table describes it, and what the bus has to say about it.
#include "dspic30/memory/sfr_table.h"
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using dspic::Cause;

TEST(Bus, every_register_reads_its_reset_value) {
  Bench b;
  for (const dspic::SfrInfo* r = std::begin(dspic::kSfrRows); r != std::end(dspic::kSfrRows); ++r)
    EXPECT_EQ(b.read(r->name, 0), r->reset) << r->name;
}

TEST(Bus, unimplemented_bits_read_zero_whatever_is_written) {
  for (const dspic::SfrInfo* r = std::begin(dspic::kSfrRows); r != std::end(dspic::kSfrRows); ++r) {
    Bench b;
    b.write(r->name, 0xFFFF, 10);
    EXPECT_EQ(b.read(r->name, 11) & ~r->implemented, 0u) << r->name;
  }
}

TEST(Bus, no_register_is_without_an_owner) {
  for (const dspic::SfrInfo* r = std::begin(dspic::kSfrRows); r != std::end(dspic::kSfrRows); ++r) {
    Bench b;
    b.write(r->name, 0, 10);
    EXPECT_EQ(b.notes.count(Cause::UnimplementedAddress), 0) << r->name;
  }
}

TEST(Bus, peek_changes_nothing) {
  Bench b;
  dspic::UartFrame f;
  f.start = 1000;
  b.write("U1MODE", 0x8000, 0);
  b.write("U1BRG", 7, 0);
  b.chip.uart_receive(1, f, f.start);
  b.write("T2CON", 0x8008, 0);
  const std::uint64_t before = b.chip.state_hash(50000);
  for (unsigned a = 0; a < dspic::kSfrBytes; a += 2) b.chip.peek(a, 50000);
  EXPECT_EQ(b.chip.state_hash(50000), before);
  b.read("U1RXREG", 50000);
  EXPECT_NE(b.chip.state_hash(50000), before);
}

TEST(Bus, unmodelled_bit_is_named_once_and_kept) {
  Bench b;
  b.write("U1MODE", 0xA000, 5);  // USIDL
  b.write("U1MODE", 0xA000, 6);
  EXPECT_EQ(b.notes.count(Cause::UnmodelledBit), 1);
  EXPECT_EQ(b.notes.all[0].place, "U1MODE.USIDL");
  EXPECT_EQ(b.notes.all[0].cycle, 5);
  EXPECT_EQ(b.read("U1MODE", 7), 0xA000u);
  b.write("U2MODE", 0xA000, 8);
  EXPECT_EQ(b.notes.count(Cause::UnmodelledBit), 2);
}

TEST(Bus, writes_to_nowhere_are_named) {
  Bench b;
  b.chip.write(0x2D8, 1, 16, 5);  // port E, which this chip lacks
  EXPECT_EQ(b.chip.read(0x2D8, 16, 6), 0);
  ASSERT_EQ(b.notes.count(Cause::UnimplementedAddress), 1);
  EXPECT_EQ(b.notes.all[0].place, "0x02d8");
}

TEST(Bus, uninitialised_reads_are_named_when_asked_for) {
  dspic::Configuration c;
  c.warn_uninitialised = true;
  Bench b(c);
  b.read("TMR1", 1);
  b.read("TMR1", 2);
  b.write("TMR2", 0, 3);
  b.read("TMR2", 4);
  b.read("PR1", 5);
  ASSERT_EQ(b.notes.count(Cause::UninitialisedRead), 1);
  EXPECT_EQ(b.notes.all[0].place, "TMR1");
  EXPECT_EQ(Bench().notes.all.size(), 0u);
}

TEST(Bus, names_and_addresses) {
  EXPECT_STREQ(dspic::Dspic30f6014a::register_name(0x110), "T2CON");
  EXPECT_STREQ(dspic::Dspic30f6014a::register_name(0x111), "T2CON");
  EXPECT_EQ(dspic::Dspic30f6014a::register_name(0x054), nullptr);
  EXPECT_EQ(dspic::Dspic30f6014a::register_name(0x900), nullptr);
  EXPECT_EQ(dspic::sfr_named("NVMKEY")->address, 0x766);
  EXPECT_EQ(dspic::sfr_named("NOTHING"), nullptr);
  EXPECT_EQ(dspic::sfr_bit_name(*dspic::sfr_info(0x104), 5), "T1CON.TCKPS");
}

TEST(Bus, same_calls_give_the_same_state) {
  const auto run = [] {
    Bench b;
    b.write("ADCON3", 0x0127, 0);
    b.write("ADCSSL", 0x1C, 0);
    b.write("ADCON2", 0x0408, 0);
    b.write("ADCON1", 0x80E4, 0);
    b.write("PR2", 1474, 0);
    b.write("T2CON", 0x8000, 0);
    for (int i = 0; i < 300; ++i) {
      b.read("IFS0", 1000 * i);
      b.clear_flag(dspic::irq::Adc, 1000 * i + 3);
      b.clear_flag(dspic::irq::T2, 1000 * i + 7);
    }
    return b.chip.state_hash(300000);
  };
  EXPECT_EQ(run(), run());
}

// looking more often must not change what is seen
TEST(Bus, state_does_not_depend_on_who_looks) {
  const auto run = [](dspic::Cycle step) {
    Bench b;
    b.write("U1BRG", 7, 0);
    b.write("U1MODE", 0x8000, 0);
    b.write("U1STA", 0x8400, 0);
    b.write("U1TXREG", 'a', 10);
    b.write("U1TXREG", 'b', 11);
    b.write("ADCON3", 0x0127, 12);
    b.write("ADCSSL", 0x1C, 12);
    b.write("ADCON2", 0x0408, 12);
    b.write("ADCON1", 0x80E4, 12);
    b.write("PR1", 700, 12);
    b.write("T1CON", 0x8010, 12);
    b.write("DCICON2", 3 << 10 | 15 << 5 | 15, 13);
    b.write("DCICON3", 3, 13);
    b.write("TSCON", 1, 13);
    b.write("DCICON1", 0x8000, 13);
    for (dspic::Cycle now = 100; step && now < 40000; now += step) b.chip.peek(0x084, now);
    return std::make_pair(b.chip.state_hash(40000), b.outside.held);
  };
  EXPECT_EQ(run(0), run(1));
  EXPECT_EQ(run(0), run(997));
}

// the models number the sources by irqs.inc; the header's and the assembler's names are sfr.csv's
TEST(SfrTable, flags_enables_and_priorities_stand_where_the_sources_are) {
  for (int irq = 0; irq < dspic::kIrqs; ++irq) {
    const std::string name = dspic::irq_name(irq) == std::string("ADC") ? "AD" : dspic::irq_name(irq);
    if (name == "?") continue;
    SCOPED_TRACE(name);
    const auto field_at = [](const std::string& word, int bit) {
      return dspic::sfr_bit_name(*dspic::sfr_named(word), bit);
    };
    const std::string n = std::to_string(irq / 16), ifs = "IFS" + n, iec = "IEC" + n,
                      ipc = "IPC" + std::to_string(irq / 4);
    EXPECT_EQ(field_at(ifs, irq % 16), ifs + "." + name + "IF");
    EXPECT_EQ(field_at(iec, irq % 16), iec + "." + name + "IE");
    for (int bit = 0; bit < 3; ++bit) EXPECT_EQ(field_at(ipc, 4 * (irq % 4) + bit), ipc + "." + name + "IP");
  }
}

TEST(SfrTable, constants_are_what_the_table_says) {
  static_assert(dspic::sfr_bits("INTCON1", "STKERR", "ADDRERR") == 0x000C);
  for (const dspic::SfrInfo& row : dspic::kSfrRows) {
    std::uint16_t all = 0;
    for (const dspic::SfrField& field : dspic::fields_of(row)) {
      const dspic::SfrBits bits = dspic::sfr_field(row.name, field.name);
      EXPECT_EQ(bits.lowest, field.bit) << row.name << "." << field.name;
      EXPECT_EQ(bits.mask, ((1 << field.width) - 1) << field.bit) << row.name << "." << field.name;
      EXPECT_EQ(bits.of(0xFFFF), (1u << field.width) - 1) << row.name << "." << field.name;
      all |= bits.mask;
    }
    if (all != 0) {
      EXPECT_EQ(all, row.implemented) << row.name;
    }
  }
}

}  // namespace
