// SPDX-License-Identifier: MIT
// What the decoder says of an instruction's registers: nothing that it does depends on one that it is said
// not to touch. Known waits (known_waits.h) stand on that.
#include <random>

#include "dspic30/core/code_store.h"
#include "dspic30/core/instruction_table.h"
#include "tests/dspic30/core_bench.h"

namespace {

using dspic::Fields;
using dspic::Row;

constexpr unsigned kRam = 0x1000, kRamBytes = 0x0F00;  // where pointers lead

struct Outcome {
  std::vector<unsigned> w;
  unsigned sr = 0, pc = 0;
  std::int64_t a = 0, b = 0;
  bench::Cycle now = 0;
  std::vector<std::uint8_t> ram;
};

Outcome run_one(const std::vector<std::uint32_t>& words, const std::vector<std::uint16_t>& w) {
  bench::CoreBench bench("nop\n", {}, false);
  for (std::size_t i = 0; i < words.size(); ++i)
    bench.program.write(static_cast<unsigned>(0x200 + 2 * i), words[i]);
  bench.program.write(0, 0x040200);  // goto 0x200
  bench.program.write(2, 0);
  bench.run(bench.cpu->now() + 1);
  for (unsigned n = 0; n < 16; ++n) bench.cpu->set_w(static_cast<int>(n), w[n]);
  for (unsigned i = 0; i < kRamBytes; ++i)
    bench.cpu->set_ram(kRam + i, static_cast<std::uint8_t>(i * 37 + 11));
  bench.run(bench.cpu->now() + 1);
  Outcome outcome;
  for (int n = 0; n < 16; ++n) outcome.w.push_back(bench.w(n));
  outcome.sr = bench.cpu->sr();
  outcome.pc = bench.cpu->pc();
  outcome.a = bench.cpu->cpu().acc[0];
  outcome.b = bench.cpu->cpu().acc[1];
  outcome.now = bench.cpu->now();
  outcome.ram.assign(bench.cpu->ram(), bench.cpu->ram() + dspic::Processor::kRamBytes);
  return outcome;
}

// fields at random, addresses in RAM
bool draw(const Row& row, std::mt19937& chance, Fields& f) {
  for (const dspic::Field& field : row.fields)
    f.*field.member = static_cast<unsigned>(chance()) & dspic::field_limit(row, field.member);
  if (row.has(dspic::Operand::File)) f.f = kRam + (f.f % 0x0E00 & ~1u);
  if (row.has(dspic::Operand::FileWord)) f.f = (kRam + f.f % 0x0E00) / 2;
  return !row.legal || row.legal(f);
}

TEST(Touch, nothing_depends_on_registers_that_are_not_touched) {
  std::mt19937 chance(7);
  for (const Row& row : dspic::instruction_rows()) {
    if (row.id == dspic::Insn::Reset) continue;  // of all of them, behind a reset
    int tried = 0;
    for (int i = 0; i < 60 && tried < 12; ++i) {
      Fields f;
      if (!draw(row, chance, f)) continue;
      const std::vector<std::uint32_t> words{dspic::encode(row, f), 0x000004, 0};
      if (dspic::find_row(words[0]) != &row) continue;
      ++tried;
      dspic::ProgramMemory memory;
      for (std::size_t at = 0; at < words.size(); ++at)
        memory.write(static_cast<unsigned>(0x200 + 2 * at), words[at]);
      dspic::WordRegisters registers;
      dspic::decode_word(memory, 0x200, {}, registers);
      std::vector<std::uint16_t> w(16);
      for (std::uint16_t& value : w)
        value = static_cast<std::uint16_t>(kRam + 0x100 + (chance() % 0x0A00 & ~1u));
      std::vector<std::uint16_t> other = w;
      for (unsigned n = 0; n < 15; ++n)
        if (!(registers.touches >> n & 1)) other[n] ^= 0x0A5A;
      const Outcome a = run_one(words, w), b = run_one(words, other);
      for (unsigned n = 0; n < 16; ++n) {
        const bool touched = registers.touches >> n & 1;
        EXPECT_EQ(b.w[n], touched ? a.w[n] : other[n]) << row.mnemonic << " " << row.operands << " W" << n;
        if (!touched) {
          EXPECT_EQ(a.w[n], w[n]) << row.mnemonic << " " << row.operands << " W" << n;
        }
      }
      EXPECT_EQ(a.sr, b.sr) << row.mnemonic << " " << row.operands;
      EXPECT_EQ(a.pc, b.pc) << row.mnemonic << " " << row.operands;
      EXPECT_EQ(a.now, b.now) << row.mnemonic << " " << row.operands;
      EXPECT_EQ(a.a, b.a) << row.mnemonic << " " << row.operands;
      EXPECT_EQ(a.b, b.b) << row.mnemonic << " " << row.operands;
      EXPECT_EQ(a.ram, b.ram) << row.mnemonic << " " << row.operands;
    }
    EXPECT_GT(tried, 0) << row.mnemonic << " " << row.operands;
  }
}

// the commonest wait looks at a variable alone
TEST(Touch, a_look_at_a_variable_touches_none) {
  dspic::ProgramMemory memory;
  memory.write(0x200, dspic::encode(dspic::row_of(dspic::Insn::Cp0_f), [] {
                 Fields f;
                 f.f = 0x1000;
                 return f;
               }()));
  dspic::WordRegisters registers;
  dspic::decode_word(memory, 0x200, {}, registers);
  EXPECT_EQ(registers.touches, 1u << 15);
}

}  // namespace
