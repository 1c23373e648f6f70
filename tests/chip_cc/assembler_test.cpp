// SPDX-License-Identifier: MIT
// A project's .s file becomes an object as the whole-program assembler reads it.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "compiler/cache/elf_reader.h"
#include "compiler/cache/object_cache.h"
#include "dspic30/core/disassembler.h"
#include "dspic30/core/instruction_table.h"
#include "tests/support/wording.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;
using dspic::Operand;

struct Assembled {
  std::string messages;
  cc::ElfFile object;

  explicit Assembled(const std::string& text) {
    const fs::path work = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "assembler";
    fs::create_directories(work);
    std::ofstream(work / "x.s") << text;
    fs::remove(work / "x.o");
    messages = cc::run_process({std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc", (work / "x.s").string(),
                                "-o", (work / "x.o").string()})
                   .output;
    object = cc::read_elf(work / "x.o");
  }
};

bool is_placed_by_linker(const dspic::Row& row) {
  return row.has(Operand::Branch) || row.has(Operand::Target) || row.has(Operand::DoEnd);
}

// all forms of instructions, accumulators included, whose names a variable might have
TEST(ChipAssembler, instructions_become_the_words_that_they_come_from) {
  std::mt19937 random(1);
  std::string text = "\t.text\n";
  std::vector<std::uint32_t> words;
  for (const dspic::Row& row : dspic::instruction_rows()) {
    if (is_placed_by_linker(row)) continue;
    for (int tries = 0, written = 0; tries < 400 && written < 8; ++tries) {
      const std::uint32_t word = (random() & 0xFFFFFF & ~row.mask) | row.match;
      if (dspic::find_row(word) != &row) continue;
      const std::string line = dspic::disassemble(word, 0, 0);
      if (line[0] == '.') continue;
      text += "\t" + line + "\n";
      words.push_back(word);
      ++written;
    }
  }
  ASSERT_GT(words.size(), 800u);
  const Assembled made(text);
  ASSERT_EQ(made.messages, "");
  const std::string code = made.object.section(".text");
  ASSERT_EQ(code.size(), 4 * words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::uint32_t word = 0;
    for (int k = 3; k >= 0; --k) word = word << 8 | static_cast<unsigned char>(code[4 * i + k]);
    EXPECT_EQ(word, words[i]) << dspic::disassemble(words[i], 0, 0);
  }
}

TEST(ChipAssembler, data_in_code_fill_the_lower_half_of_words) {
  const Assembled made(R"(
        .section .table, code
        .hword 0x1234, 0x5678
        .pword 0x9ABCDE
        .byte 1, 2, 3, 4
        .asciz "ab"
)");
  EXPECT_TRUE(wording::reads(made.messages,
                             "…/assembler/x.s:6:16: warning: an odd number of bytes in code; a zero "
                             "follows\n        .asciz \"ab\"\n               ^"));
  const std::string expected("\x34\x12\0\0\x78\x56\0\0\xDE\xBC\x9A\0\1\2\0\0\3\4\0\0ab\0\0\0\0\0\0", 28);
  EXPECT_EQ(made.object.section(".table"), expected);
}

// .short is LLVM's: packed structs and debugging information have it at odd places
TEST(ChipAssembler, words_in_data_are_aligned_but_not_shorts) {
  const Assembled made("\t.data\n\t.byte 1\n\t.short 2\n\t.word 3\n");
  EXPECT_EQ(made.messages, "");
  EXPECT_EQ(made.object.section(".data"), std::string("\1\2\0\0\3\0", 6));
}

TEST(ChipAssembler, mistakes_say_what_is_wrong) {
  for (const auto& [text, message] : {
           std::pair{".section .x, code, wide",
                     "…/assembler/x.s:1:10: error: .section: unknown attribute 'wide'\n.section .x, code, "
                     "wide\n         ^"},
           std::pair{".section .x, code, address(0x100)",
                     "…/assembler/x.s:1:10: error: .section: code at an address: `twinpuck asm` does "
                     "that\n.section .x, code, address(0x100)\n         ^"},
           std::pair{".section .x, data, address(where)",
                     "…/assembler/x.s:1:10: error: .section: address: got no number\n.section .x, data, "
                     "address(where)\n         ^"},
           std::pair{".section .x, data, align(3)",
                     "…/assembler/x.s:1:10: error: alignment: got 3, expected a power of two up to "
                     "32768\n.section .x, data, align(3)\n         ^"},
           std::pair{".text\n .org 0x200",
                     "…/assembler/x.s:2:7: error: the linker says where code lies; `twinpuck asm` takes "
                     "whole programs\n .org 0x200\n      ^"},
           std::pair{".data\n .pword 1",
                     "…/assembler/x.s:2:9: error: .pword outside a code section\n .pword 1\n        ^"},
           std::pair{".text\n .palign 3",
                     "…/assembler/x.s:2:10: error: alignment: got 3, expected a power of two up to 32768\n "
                     ".palign 3\n         ^"},
           std::pair{".text\n .palign 1 << 40",
                     "…/assembler/x.s:2:10: error: alignment: got 1099511627776, expected a power of two up "
                     "to 32768\n .palign 1 << 40\n         ^"},
           std::pair{"config __FXYZ, 1",
                     "…/assembler/x.s:1:1: error: config: unknown word '__FXYZ'\nconfig __FXYZ, 1\n^"},
           std::pair{"config __FOSC, NO_SUCH",
                     "…/assembler/x.s:1:1: error: config: got no value: NO_SUCH\nconfig __FOSC, NO_SUCH\n^"},
           std::pair{
               "config __FOSC",
               "…/assembler/x.s:1:1: error: config: expected a word's name and its value\nconfig __FOSC\n^"},
       }) {
    const Assembled made(std::string(text) + "\n");
    EXPECT_TRUE(wording::reads(made.messages, message));
    EXPECT_FALSE(made.object.ok) << text;
  }
}

}  // namespace
