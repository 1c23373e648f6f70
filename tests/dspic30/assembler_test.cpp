// SPDX-License-Identifier: MIT
// The whole-program assembler on texts that are short and would grow without end.
#include "dspic30/asm/assembler.h"

#include <gtest/gtest.h>

namespace {

std::string first_message(const std::string& text) {
  const auto image = dspic::assembly::assemble(text, "x.s");
  return image.messages.empty() ? "" : image.messages[0].text;
}

TEST(Assembler, many_sections_together_have_a_limit) {
  EXPECT_EQ(first_message(R"(
        .macro one n
        .section .s\n, code
        .space 90000
        .endm
        one 1
        one 2
        one 3
)"),
            "all sections grow beyond 196608 bytes");
  EXPECT_EQ(first_message(".space 98304\n.space 2\n"), "the section grows beyond 98304 bytes");
  EXPECT_EQ(first_message(".space 98304 - 0x100\n"), "");
}

TEST(Assembler, blocks_that_are_repeated_count_as_text) {
  std::string text = ".rept 60000\n.macro m\n";
  for (int i = 0; i < 1000; ++i) text += "nop\n";
  EXPECT_EQ(first_message(text + ".endm\n.endr\n"), "the text grows too long: a macro without end?");
}

TEST(Assembler, text_is_bytes_and_knows_escapes) {
  const auto image = dspic::assembly::assemble(
      "__reset: nop\n.section .const, psv\n.ascii \"a, b(\\n\\r\\t\\0\\\\\\\"\", \"z\"\n.asciz "
      "\"b\"\n.string "
      "\"\"\n",
      "x.s");
  ASSERT_TRUE(image.messages.empty()) << image.messages[0].text;
  std::string bytes;  // two of them in a word of the flash that data are read from
  for (std::uint32_t at = 0x102; image.program.count(at); at += 2)
    for (const int shift : {0, 8}) bytes += static_cast<char>(image.program.at(at) >> shift & 0xFF);
  EXPECT_EQ(bytes, std::string("a, b(\n\r\t\0\\\"zb\0\0\0", 16));
}

// 1b is the label that comes before, on this line too; 1f the one that comes behind it
TEST(Assembler, numbers_are_labels_of_their_neighbourhood) {
  const auto image = dspic::assembly::assemble(
      "__reset: nop\n1: bra 1f\n bra 1b\n1: nop\n bra 1b\n1: bra 1b\n bra 2f\n2: nop\n", "x.s");
  ASSERT_TRUE(image.messages.empty()) << image.messages[0].text;
  std::vector<int> words_on;
  for (const std::uint32_t at : {0x102u, 0x104u, 0x108u, 0x10Au, 0x10Cu})
    words_on.push_back(static_cast<std::int16_t>(image.program.at(at) & 0xFFFF));
  EXPECT_EQ(words_on, (std::vector<int>{1, -2, -2, -1, 0}));
}

// each operator, by where it binds: what is written as a number
TEST(Assembler, expressions_are_computed_in_64_bits) {
  const struct {
    const char* text;
    std::int64_t value;
  } rows[] = {
      {"2 + 3 * 4", 14}, {"(2 + 3) * 4", 20},   {"20 - 6 - 5", 9},     {"20 / 6", 3},  {"20 % 6", 2},
      {"-20 / 6", -3},   {"1 << 4", 16},        {"1 << 63 >> 63", -1}, {"1 << 64", 0}, {"256 >> 4", 16},
      {"256 >> 64", 0},  {"3 == 3", 1},         {"3 == 4", 0},         {"3 != 3", 0},  {"3 != 4", 1},
      {"3 <= 2", 0},     {"3 <= 3", 1},         {"3 <= 4", 1},         {"3 >= 2", 1},  {"3 >= 3", 1},
      {"3 >= 4", 0},     {"3 < 2", 0},          {"3 < 3", 0},          {"3 < 4", 1},   {"3 > 2", 1},
      {"3 > 3", 0},      {"3 > 4", 0},          {"2 && 1", 1},         {"2 && 0", 0},  {"0 || 2", 1},
      {"0 || 0", 0},     {"6 & 3", 2},          {"6 | 3", 7},          {"6 ^ 3", 5},   {"~5 & 0xF", 10},
      {"-(3)", -3},      {"1 | 2 == 2", 1 | 1}, {"'A' + 1", 66}};
  for (const auto& row : rows) {
    const auto image =
        dspic::assembly::assemble("__reset: mov #(" + std::string(row.text) + ") & 0xFFFF, w0\n", "x.s");
    ASSERT_TRUE(image.messages.empty()) << row.text << ": " << image.messages[0].text;
    const auto reset = image.program.at(0x100);
    EXPECT_EQ(reset >> 4 & 0xFFFF, row.value & 0xFFFF) << row.text;
  }
  EXPECT_EQ(first_message("__reset: mov #1 / 0, w0\n"), "division by zero");
  EXPECT_EQ(first_message("__reset: mov #1 % 0, w0\n"), "division by zero");
}

TEST(Assembler, registers_are_w0_to_w15_and_nothing_that_looks_like_them) {
  for (const char* good : {"w0", "w9", "w10", "w15", "W3"})
    EXPECT_EQ(first_message("__reset: mov " + std::string(good) + ", w1\n"), "") << good;
  for (const char* bad : {"w16", "w99", "w100", "w00", "w05", "wa", "w1x", "w:", "w1:", "w/", "w", "v1"})
    EXPECT_NE(first_message("__reset: mov " + std::string(bad) + ", w1\n"), "") << bad;
}

// least and most of each kind of operand, and one step beyond: what is told
TEST(Assembler, operands_have_the_ranges_of_their_fields) {
  const struct Operand {
    const char* text;  // an instruction; % stands for the number
    std::int64_t least, most, step;
    const char* range;
  } operands[] = {{"mov.b %, WREG", 0, 0x1FFF, 1, "0x0 to 0x1FFF"},
                  {"mov %, WREG", 0, 0x1FFE, 2, "0x0 to 0x1FFF, even"},
                  {"mov %, w1", 0, 0xFFFE, 2, "0x0 to 0xFFFE, even"},
                  {"mov w1, %", 0, 0xFFFE, 2, "0x0 to 0xFFFE, even"},
                  {"mov #%, w0", -0x8000, 0xFFFF, 1, "-0x8000 to 0xFFFF"},
                  {"mov.b #%, w0", -0x80, 0xFF, 1, "-0x80 to 0xFF"},
                  {"add w1, #%, w2", 0, 31, 1, "0x0 to 0x1F"},
                  {"add #%, w2", 0, 1023, 1, "0x0 to 0x3FF"},
                  {"repeat #%", 0, 0x3FFF, 1, "0x0 to 0x3FFF"},
                  {"disi #%", 0, 0x3FFF, 1, "0x0 to 0x3FFF"},
                  {"lnk #%", 0, 0x3FFE, 2, "0x0 to 0x3FFE, even"},
                  {"bset w1, #%", 0, 15, 1, "0x0 to 0xF"},
                  {"bset.b w1, #%", 0, 7, 1, "0x0 to 0x7"},
                  {"bset.b 0x802, #%", 0, 7, 1, "0x0 to 0x7"},
                  {"sl w1, #%, w2", 0, 15, 1, "0x0 to 0xF"},
                  {"sftac A, #%", -16, 16, 1, "-0x10 to 0x10"},
                  {"mov [w1 + %], w2", -1024, 1022, 2, "-0x400 to 0x3FE, even"},
                  {"mov w2, [w1 + %]", -1024, 1022, 2, "-0x400 to 0x3FE, even"},
                  {"mov.b [w1 + %], w2", -512, 511, 1, "-0x200 to 0x1FF"},
                  {"goto %", 0, 0x7FFFFE, 2, "0x0 to 0x7FFFFE, even"}};
  for (const Operand& o : operands) {
    const auto with = [&o](std::int64_t number) {
      std::string text = o.text;
      return first_message("__reset: " + text.replace(text.find('%'), 1, std::to_string(number)) + "\n");
    };
    for (const std::int64_t good : {o.least, o.least + o.step, o.most - o.step, o.most})
      EXPECT_EQ(with(good), "") << o.text;
    for (const std::int64_t bad : {o.least - o.step, o.most + o.step, o.least + o.step - 1}) {
      if (o.step == 1 && bad == o.least) continue;
      const std::string told = with(bad);
      EXPECT_NE(told.find(std::string(", expected ") + o.range), std::string::npos)
          << o.text << " with " << bad << ": " << told;
    }
  }
}

}  // namespace
