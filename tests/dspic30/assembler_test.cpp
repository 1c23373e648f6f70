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
      "__reset: nop\n.section .const, psv\n.ascii \"a\\n\\r\\t\\0\\\\\\\"\", \"z\"\n.asciz \"b\"\n.string "
      "\"\"\n",
      "x.s");
  ASSERT_TRUE(image.messages.empty()) << image.messages[0].text;
  std::string bytes;  // two of them in a word of the flash that data are read from
  for (std::uint32_t at = 0x102; image.program.count(at); at += 2)
    for (const int shift : {0, 8}) bytes += static_cast<char>(image.program.at(at) >> shift & 0xFF);
  EXPECT_EQ(bytes, std::string("a\n\r\t\0\\\"zb\0\0\0", 12));
}

}  // namespace
