// SPDX-License-Identifier: MIT
// The line's interrupt of the fast camera driver, which exists as assembler only: its text is walked through
// here, instruction by instruction, with the cycles of the programmer's manual (1 each, a branch that is
// taken or a skip 2). The original's handler reads bytes 10, 18, 26, ... cycles after its first instruction
// [lib: e_interrupt.s, counted].
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "twinpuck_paths.h"

namespace {

std::string text_of(const std::string& path) {
  std::ifstream in(std::string(TWINPUCK_SOURCE_DIR) + path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Line {
  std::string label, word, operands;
};

/// The instructions of the handler, without comments; .equ names replaced by their numbers.
std::vector<Line> handler() {
  std::map<std::string, std::string> equ;
  std::vector<Line> lines;
  std::istringstream in(text_of("/hal_dspic/camera/fast_2_timer/e_line_interrupt.s"));
  std::string label;
  for (std::string line; std::getline(in, line);) {
    line = line.substr(0, line.find(';'));
    std::smatch m;
    if (std::regex_match(line, m, std::regex(R"(\s*\.equ\s+(\w+),\s*(\w+)\s*)"))) {
      equ[m[1]] = m[2];
    } else if (std::regex_match(line, m, std::regex(R"((\w+):\s*)"))) {
      label = m[1];
    } else if (std::regex_match(line, m, std::regex(R"(\s+([a-z][\w.]*)\s*(.*?)\s*)"))) {
      std::string operands = m[2];
      for (const auto& [name, number] : equ)
        operands = std::regex_replace(operands, std::regex("\\b" + name + "\\b"), number);
      lines.push_back({label, m[1], operands});
      label.clear();
    }
  }
  return lines;
}

struct Walk {
  std::vector<int> reads;  ///< cycles at which a byte of port D is taken
  bool stopped_timer_4 = false, said_ready = false;
};

/// One interrupt with a line of this mask: 1 take, 0 skip, 2 end.
Walk walk(const std::vector<int>& mask, bool last_row) {
  const auto lines = handler();
  std::size_t at = 0, next_mark = 0;
  int cycle = 0, mark = 0;
  Walk w;
  for (int steps = 0; steps < 1000; ++steps) {
    if (at >= lines.size()) break;
    const Line& l = lines[at];
    int cycles = 1;
    std::size_t next = at + 1;
    const auto go = [&](const std::string& label) {
      cycles = 2;
      for (next = 0; next < lines.size() && lines[next].label != label; ++next) {
      }
      EXPECT_LT(next, lines.size()) << "no label " << label;
    };
    if (l.word == "mov.b" && l.operands == "[w0++], w3") {
      mark = mask.at(next_mark++);
    } else if (l.word == "mov.b") {
      EXPECT_EQ(l.operands, "[w2], [w1++]");
      w.reads.push_back(cycle);
    } else if (l.word == "btsc") {
      const bool is_set = mark >> (l.operands.back() - '0') & 1;
      if (!is_set) cycles = 2, next = at + 2;
    } else if (l.word == "bra" && l.operands.substr(0, 2) == "nz") {
      if (!last_row) go(l.operands.substr(4));
    } else if (l.word == "bra") {
      go(l.operands);
    } else if (l.word == "bclr.b") {
      w.stopped_timer_4 |= l.operands == "0x011F, #7";
    } else if (l.word == "mov" && l.operands == "w0, __poxxxx_img_ready") {
      w.said_ready = true;
    } else if (l.word == "retfie") {
      return w;
    } else {
      EXPECT_TRUE(l.word == "push.s" || l.word == "pop.s" || l.word == "clr" || l.word == "mov" ||
                  l.word == "nop" || l.word == "inc" || l.word == "cp")
          << "unknown instruction (REPEAT would need RCOUNT saved): " << l.word;
    }
    cycle += cycles;
    at = next;
  }
  ADD_FAILURE() << "the handler has no end";
  return w;
}

}  // namespace

TEST(LineInterrupt, takes_its_first_byte_at_cycle_10_and_one_every_8_as_the_original) {
  EXPECT_EQ(walk({1, 1, 0, 0, 1, 2}, false).reads, (std::vector<int>{10, 18, 42}));
  EXPECT_EQ(walk({0, 0, 1, 2}, false).reads, (std::vector<int>{26}));
  EXPECT_NE(text_of("/hal_dspic/camera/fast_2_timer/camera_line.h").find("LINE_FIRST_SAMPLE 10 "),
            std::string::npos);
}

TEST(LineInterrupt, stops_timer_4_after_the_last_row_and_not_before) {
  // T4CON lies at 0x011E, TON is bit 15: bit 7 of 0x011F
  EXPECT_NE(text_of("/dspic30/device/sfr.csv").find("0x011E,T4CON,"), std::string::npos);
  EXPECT_TRUE(walk({1, 2}, true).stopped_timer_4);
  EXPECT_TRUE(walk({1, 2}, true).said_ready);
  EXPECT_FALSE(walk({1, 2}, false).stopped_timer_4);
  EXPECT_FALSE(walk({1, 2}, false).said_ready);
}

TEST(LineInterrupt, is_named_by_the_driver_so_that_archives_give_it_out) {
  EXPECT_NE(text_of("/hal_dspic/camera/fast_2_timer/e_timers.c").find("= twinpuck_line_handler;"),
            std::string::npos);
  EXPECT_NE(text_of("/hal_dspic/camera/fast_2_timer/e_line_interrupt.s")
                .find("\n_twinpuck_line_handler:\n__T4Interrupt:\n"),
            std::string::npos);
}
