// SPDX-License-Identifier: MIT
// Runs instruction_cases.txt: each row of the instruction table, in assembler text, against what
// was computed by hand.
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "dspic30/asm/expression.h"
#include "dspic30/core/instruction_table.h"
#include "tests/dspic30/core_bench.h"
#include "twinpuck_paths.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
using dspic::assembly::trimmed;

constexpr unsigned kFlags = 0x10F;  // DC, N, OV, Z, C

unsigned flag_bits(const std::string& names) {
  unsigned bits = 0;
  std::istringstream parts(names);
  for (std::string name; std::getline(parts, name, '+');)
    if (name != "-") bits |= dspic::sfr_field("SR", name).mask;
  return bits;
}

struct Case {
  std::string row, before, text, after;
  int line;
};

std::vector<Case> read_cases() {
  std::vector<Case> cases;
  std::ifstream in(TWINPUCK_SOURCE_DIR "/tests/dspic30/instruction_cases.txt");
  std::string line, row;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '=') {
      row = trimmed(line.substr(1));
      continue;
    }
    const std::size_t first = line.find('|'), second = line.find('|', first + 1);
    cases.push_back({row, trimmed(line.substr(0, first)), trimmed(line.substr(first + 1, second - first - 1)),
                     trimmed(line.substr(second + 1)), number});
  }
  return cases;
}

std::vector<std::pair<std::string, std::string>> pairs(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> all;
  std::istringstream parts(text);
  for (std::string part; parts >> part;)
    if (part != "-") all.emplace_back(part.substr(0, part.find('=')), part.substr(part.find('=') + 1));
  return all;
}

std::int64_t number(const std::string& text) { return std::strtoll(text.c_str(), nullptr, 0); }

void set(CoreBench& b, const std::string& name, const std::string& value) {
  const auto v = static_cast<unsigned>(number(value));
  if (name[0] == 'w') {
    b.cpu->set_w(std::stoi(name.substr(1)), static_cast<std::uint16_t>(v));
  } else if (name[0] == '0') {
    const auto address = static_cast<unsigned>(number(name));
    b.cpu->set_ram(address, static_cast<std::uint8_t>(v));
    b.cpu->set_ram(address + 1, static_cast<std::uint8_t>(v >> 8));
  } else if (name == "flags") {
    b.chip->write(bench::Bench::at("SR"), static_cast<std::uint16_t>(flag_bits(value)), 16, 0);
  } else if (name.compare(0, 3, "ACC") == 0) {
    for (const char* part : {"L", "H", "U"})
      b.chip->write(bench::Bench::at(name + part),
                    static_cast<std::uint16_t>(number(value) >> (*part == 'L'   ? 0
                                                                 : *part == 'H' ? 16
                                                                                : 32)),
                    16, 0);
  } else {
    b.chip->write(bench::Bench::at(name), static_cast<std::uint16_t>(v), 16, 0);
  }
}

void expect(CoreBench& b, const std::string& name, const std::string& value) {
  const std::int64_t v = number(value);
  if (name[0] == 'w') {
    EXPECT_EQ(b.w(std::stoi(name.substr(1))), v) << name;
  } else if (name[0] == '0') {
    EXPECT_EQ(b.word(static_cast<unsigned>(number(name))), v) << name;
  } else if (name == "high") {
    EXPECT_EQ(b.cpu->sr() & 0xFC00u, flag_bits(value)) << name;
  } else if (name.compare(0, 3, "ACC") == 0) {
    EXPECT_EQ(b.cpu->cpu().acc[static_cast<std::size_t>(name[3] - 'A')] & 0xFFFFFFFFFF, v) << name;
  } else {
    EXPECT_EQ(b.sfr(name), v) << name;
  }
}

void run(const Case& c) {
  std::string text = ".section .cases, code, address(0)\n__reset:\n" + c.text;
  for (char& letter : text)
    if (letter == '/') letter = '\n';
  CoreBench b(text);
  for (const auto& [name, value] : pairs(c.before)) set(b, name, value);
  Cycle cycles = 0;
  unsigned flags = 0, words = 0;
  while (b.image.program.count(2 * words)) ++words;
  std::int64_t pc = 2 * words;
  std::vector<std::pair<std::string, std::string>> rest;
  for (const auto& [name, value] : pairs(c.after)) {
    if (name == "cycles")
      cycles = number(value);
    else if (name == "flags")
      flags = flag_bits(value);
    else if (name == "pc")
      pc = value[0] == '+' ? 2 * number(value.substr(1)) : number(value);
    else
      rest.emplace_back(name, value);
  }
  ASSERT_GT(cycles, 0) << "cycles are missing";
  b.run(cycles);
  EXPECT_EQ(b.cpu->now(), cycles);
  EXPECT_EQ(b.cpu->pc(), pc);
  EXPECT_EQ(b.cpu->sr() & kFlags, flags);
  for (const auto& [name, value] : rest) expect(b, name, value);
}

TEST(Instruction, cases_hold) {
  for (const Case& c : read_cases()) {
    SCOPED_TRACE("instruction_cases.txt:" + std::to_string(c.line) + ": " + c.row + ": " + c.text);
    run(c);
  }
}

// each case in a loop, as often as it lasts: what is translated does what the interpreter does
TEST(Instruction, cases_translated) {
  int translated = 0;
  for (const Case& c : read_cases()) {
    SCOPED_TRACE("instruction_cases.txt:" + std::to_string(c.line) + ": " + c.row + ": " + c.text);
    std::string text = ".section .cases, code, address(0)\n__reset: inc w10, w10 / " + c.text +
                       " / nop / nop / nop / bra __reset";
    for (char& letter : text)
      if (letter == '/') letter = '\n';
    CoreBench one(text, {}, false), other(text, {}, true);
    for (CoreBench* b : {&one, &other})
      for (const auto& [name, value] : pairs(c.before)) set(*b, name, value);
    for (Cycle end = 40; end < 400; end += 40) {
      one.run(end);
      other.run(end);
      ASSERT_EQ(one.cpu->state_hash(), other.cpu->state_hash()) << end;
      ASSERT_EQ(one.chip->state_hash(end), other.chip->state_hash(end)) << end;
    }
    ASSERT_EQ(one.resets, other.resets);
    translated += other.cpu->cpu().table().translated() > 0;
  }
  EXPECT_GT(translated, 200);
}

// The registers that serve as a word's pointers, or are its operands, if it has none: source, destination.
std::pair<unsigned, unsigned> pointers_of(std::uint32_t word) {
  const dspic::Row* const row = dspic::find_row(word);
  if (!row) return {0, 0};
  const dspic::Fields f = dspic::fields_of(*row, word);
  if (!row->has(dspic::Operand::Prefetch) && !row->has(dspic::Operand::Distance))
    return {row->has(dspic::Operand::RsPair) ? 2 * f.s : f.s,
            row->has(dspic::Operand::RdPair) ? 2 * f.d : f.d};
  const dspic::PrefetchMode x = dspic::prefetch_mode(f.i, false);
  return {x.on ? static_cast<unsigned>(x.pointer) : 8, 13};
}

// A case as the head of a loop. Its pointers become modulo and bit-reversed ones, plain ones again, other
// ones, and then all code is decoded anew as they stand: in each of these the loop runs hot
int run_as_head(const Case& c, unsigned modcon_of_pointers(unsigned source, unsigned destination)) {
  std::string text = ".section .cases, code, address(0)\n__reset: " + c.text +
                     " / nop / nop / inc w10, w10 / bra __reset\n__AddressError: bclr INTCON1, #ADDRERR / "
                     "retfie / __StackError: bclr INTCON1, #STKERR / mov #0xA00, w15 / retfie / __MathError: "
                     "bclr INTCON1, #MATHERR / retfie";
  for (char& letter : text)
    if (letter == '/') letter = '\n';
  CoreBench one(text, {}, false), other(text, {}, true);
  const auto [source, destination] = pointers_of(one.image.program.at(0));
  const unsigned modcon = modcon_of_pointers(source, destination);
  for (CoreBench* b : {&one, &other}) {
    for (const auto& [name, value] : pairs(c.before)) set(*b, name, value);
    for (const auto& [name, value] :
         {std::pair("XMODSRT", 0x8FCu), {"XMODEND", 0x90Bu}, {"YMODSRT", 0x1900u}, {"YMODEND", 0x190Bu}})
      b->chip->write(bench::Bench::at(name), static_cast<std::uint16_t>(value), 16, 0);
    b->chip->write(bench::Bench::at("XBREV"), 0x8008, 16, 0);
  }
  int translated = 0;
  Cycle end = 0;
  for (const unsigned mode : {modcon, 0u, modcon, modcon ^ 0x8000u, modcon}) {
    for (CoreBench* b : {&one, &other})
      b->chip->write(bench::Bench::at("MODCON"), static_cast<std::uint16_t>(mode), 16, b->cpu->now());
    for (int i = 0; i < 3; ++i) {
      end += 40;
      one.run(end);
      other.run(end);
      EXPECT_EQ(one.cpu->now(), other.cpu->now()) << end;
      EXPECT_EQ(one.cpu->state_hash(), other.cpu->state_hash()) << end;
      EXPECT_EQ(one.chip->state_hash(end), other.chip->state_hash(end)) << end;
      if (testing::Test::HasFailure()) return 0;
    }
    translated += other.cpu->cpu().table().translated() > 0;
  }
  other.cpu->translate_all();  // special from the first decoding on
  one.run(end + 120);
  other.run(end + 120);
  EXPECT_EQ(one.cpu->state_hash(), other.cpu->state_hash()) << "decoded anew";
  EXPECT_EQ(one.resets, other.resets);
  return translated;
}

TEST(Instruction, cases_are_heads_of_hot_code_with_special_pointers) {
  int translated = 0;
  for (const Case& c : read_cases()) {
    SCOPED_TRACE("instruction_cases.txt:" + std::to_string(c.line) + ": " + c.row + ": " + c.text);
    translated += run_as_head(c, [](unsigned source, unsigned destination) {
      return 0xC000u | (destination & 15) << 8 | 10u << 4 | (source & 15);  // modulo reads, reversed writes
    });
    translated += run_as_head(c, [](unsigned source, unsigned destination) {
      return 0xC000u | 15u << 8 | (source & 15) << 4 | (destination & 15);  // modulo writes
    });
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(translated, 1500);
}

// and the row that a case names is one that its text assembles to
TEST(Instruction, every_row_has_a_case) {
  std::set<std::string> named, met;
  for (const Case& c : read_cases()) {
    named.insert(c.row);
    std::string text = ".section .cases, code, address(0)\n" + c.text;
    for (char& letter : text)
      if (letter == '/') letter = '\n';
    for (const auto& [address, word] : dspic::assembly::assemble(text, "case").program)
      if (const dspic::Row* row = dspic::find_row(word))
        met.insert(std::string(row->mnemonic) + " " + row->operands);
  }
  for (const dspic::Row& row : dspic::instruction_rows()) {
    const std::string mnemonic = row.mnemonic, operands = row.operands;
    const bool is_condition = mnemonic.find(' ') != std::string::npos;
    const std::string name = trimmed(mnemonic + (is_condition ? "," : " ") + operands);
    EXPECT_TRUE(named.count(name)) << name;
    EXPECT_TRUE(met.count(mnemonic + " " + operands)) << name;
  }
}

}  // namespace
