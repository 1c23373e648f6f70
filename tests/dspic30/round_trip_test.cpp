// SPDX-License-Identifier: MIT
// Words -> text -> words: decoder, disassembler and assembler agree about every row of the instruction table.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "dspic30/asm/instruction_text.h"
#include "dspic30/core/disassembler.h"
#include "dspic30/core/instruction_table.h"

namespace {

using dspic::disassemble;

constexpr std::uint32_t kHere = 0x10000;  // every branch from here has a target

std::vector<std::uint32_t> assemble(const std::string& text) {
  std::string complaint;
  const auto complain = [&](const std::string& message) { complaint = message; };
  const std::size_t end = text.find(' ');
  std::vector<std::uint32_t> words;
  const std::string name = text.substr(0, end),
                    operands = end == std::string::npos ? "" : text.substr(end + 1);
  const auto choice = dspic::assembly::choose(name, operands, complain);
  if (choice.row)
    words = dspic::assembly::encode(
        choice, kHere, [](const std::string& t) { return std::strtoll(t.c_str(), nullptr, 0); }, complain);
  EXPECT_EQ(complaint, "") << text;
  return words;
}

// a word comes back as itself, or is one that the disassembler gives as a number
bool survives(std::uint32_t word, std::uint32_t second) {
  const std::string text = disassemble(word, second, kHere);
  if (text[0] == '.') return false;
  const std::vector<std::uint32_t> words = assemble(text);
  EXPECT_FALSE(words.empty()) << text;
  if (words.empty()) return true;
  EXPECT_EQ(words[0], word) << text;
  EXPECT_EQ(words.size(), static_cast<std::size_t>(dspic::instruction_words(word))) << text;
  EXPECT_EQ(words.back(), words.size() == 2 ? second : word) << text;
  return true;
}

TEST(RoundTrip, random_words_come_back) {
  std::mt19937 random(1);
  const char* wanted = std::getenv("ROUND_TRIP_WORDS");  // for a longer run
  const int count = wanted ? std::atoi(wanted) : 200000;
  int written = 0;
  for (int i = 0; i < count && !::testing::Test::HasFailure(); ++i)
    written += survives(random() & 0xFFFFFF, random() & (i % 2 ? 0x7F : 0xFFFF));
  EXPECT_GT(written, count / 2);
}

TEST(RoundTrip, every_row_comes_back) {
  std::mt19937 random(2);
  for (const dspic::Row& row : dspic::instruction_rows()) {
    int written = 0;
    for (int i = 0; i < 2000; ++i) {
      const std::uint32_t word = row.match | (random() & ~row.mask & 0xFFFFFF & (i == 0 ? 0 : ~0u));
      if (dspic::find_row(word) == &row) written += survives(word, random() & 0x7F);
    }
    EXPECT_GT(written, 0) << row.mnemonic << " " << row.operands;
  }
}

// fields cover all bits that the mask leaves open, and no two rows claim one word
TEST(RoundTrip, rows_are_whole_and_apart) {
  for (const dspic::Row& row : dspic::instruction_rows()) {
    std::uint32_t covered = row.mask;
    for (const dspic::Field& field : row.fields) {
      EXPECT_EQ(covered & field.mask, 0u) << row.mnemonic;
      covered |= field.mask;
    }
    const bool has_unread_bits = row.fields.empty() && row.mask != 0xFFFFFF;  // NOP, NOPR, BREAK
    EXPECT_TRUE(has_unread_bits || covered == 0xFFFFFF) << row.mnemonic << " " << row.operands;
  }
  std::mt19937 random(3);
  for (int i = 0; i < 100000; ++i) {
    const std::uint32_t word = random() & 0xFFFFFF;
    int claims = 0;
    for (const dspic::Row& row : dspic::instruction_rows())
      claims += (word & row.mask) == row.match && (!row.legal || row.legal(dspic::fields_of(row, word)));
    EXPECT_LE(claims, 1) << std::hex << word;
  }
}

TEST(Disassembler, writes_the_manuals_syntax) {
  EXPECT_EQ(disassemble(0x40CCB0, 0, 0), "add.b w1, [w0++], [w9]");
  EXPECT_EQ(disassemble(0x200AB4, 0, 0), "mov #0xab, w4");
  EXPECT_EQ(disassemble(0x3AFFFE, 0, 0x200), "bra nz, 0x0001fe");
  EXPECT_EQ(disassemble(0x0201FE, 0x000001, 0), "call 0x0101fe");
  EXPECT_EQ(disassemble(0xA8C2D7, 0, 0), "bset.b 0x02d7, #6");
  EXPECT_EQ(disassemble(0x064000, 0, 0), "retfie");
  EXPECT_EQ(disassemble(0x010001 | 0x008000, 0, 0), ".pword 0x018001");
}

}  // namespace
