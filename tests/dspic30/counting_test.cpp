// SPDX-License-Identifier: MIT
// Loops that count: jumped over without a change of course, and counted as waits.
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;

struct Draw {
  std::uint32_t state;
  unsigned operator()(unsigned below) {
    state = state * 1664525u + 1013904223u;
    return static_cast<unsigned>((std::uint64_t{state} * below) >> 32);
  }
};

// --- loops that make no sense ----------------------------------------------------------------------------

std::string number(Draw& draw) {
  const unsigned kind = draw(4);
  const unsigned value = kind == 0   ? draw(0x10000)
                         : kind == 1 ? draw(400)
                         : kind == 2 ? 0x10000 - 1 - draw(400)
                                     : 0x8000 - 200 + draw(400);
  return std::to_string(value);
}

std::string operation(Draw& draw) {
  static const char* const kOperations[] = {
      "add w0, #K, w0",  "sub w0, #K, w0",   "inc w0, w0",      "dec w0, w0",     "inc2 w0, w0",
      "dec2 w0, w0",     "add #J, w0",       "sub #J, w0",      "subr w0, #K, w1", "mov w0, w1",
      "add w0, w2, w1",  "sub w0, w2, w1",   "sub w2, w0, w1",  "subr w0, w2, w1", "cp w0, w2",
      "cp w2, w0",       "cp w0, #K",        "cp0 w0",          "cpb w1, w3",     "addc w1, #0, w1",
      "subb w1, #0, w1", "neg w0, w1",       "mov w0, [w8]",    "mov [w8], w0",   "inc [w8], [w8]",
      "inc word",        "dec word",         "mov word, w0",    "mov w0, word",   "add word",
      "sub word, WREG",  "cp word",          "sub w0, w2, [w15]", "sub w2, w0, [w15]", "nop",
      "repeat #3\n nop", "inc.b w0, w0",     "ze w0, w1",       "and w0, #15, w1", "btss w0, #3",
      "clr w1",          "mov #3, w3",       "rcall short",     "mov [w8+2], w4", "mov w0, [w8+4]",
      "mov w1, w0",      "mov word, WREG",   "addc w1, w4, w1", "subbr w1, w3, w4", "add w0, w0, w1",
      "mov.d w0, w4",    "mov.d w0, [w8]",   "push w0\n pop w1", "inc w5, w5",     "com w0, w1",
      "mov word",        "btsc flags, #2",   "mov.b w0, [w8]",  "subb w0, w1, w1", "add w0, w1, w0"};
  std::string text = kOperations[draw(draw(2) ? 12 : std::size(kOperations))];
  if (const auto at = text.find('K'); at != std::string::npos) text.replace(at, 1, std::to_string(draw(32)));
  if (const auto at = text.find('J'); at != std::string::npos) text.replace(at, 1, std::to_string(draw(1024)));
  return " " + text + "\n";
}

std::string branch(Draw& draw) {
  static const char* const kConditions[] = {"z", "nz", "c",  "nc",  "n",   "nn", "lt",
                                            "le", "gt", "ge", "gtu", "leu", "ov", "nov"};
  return std::string(" bra ") + kConditions[draw(std::size(kConditions))] + ", ";
}

std::string random_loop(std::uint32_t seed) {
  Draw draw{seed * 2654435761u};
  std::string text = "__reset: mov #__SP_init, w15\n mov #word, w8\n clr w9\n";
  for (const char* reg : {"w0", "w1", "w2", "w3", "w4", "w5"}) text += " mov #" + number(draw) + ", " + reg + "\n";
  text += " mov w3, word\n mov w4, word+2\n mov w1, word+4\n mov #7, w10\n mov w10, flags\n";
  if (draw(2))
    text += " mov #" + std::to_string(200 + draw(3000)) + ", w10\n mov w10, PR1\n bset IEC0, #T1IE\n bset T1CON, #15\n";
  text += "2:\n";
  if (draw(3)) text += " mov #" + number(draw) + ", w0\n";
  if (draw(2)) text += " mov w0, word\n";
  const bool in_do = draw(6) == 0;
  if (in_do) text += " do #" + std::to_string(draw(2) ? draw(16384) : draw(200)) + ", 4f\n";
  text += "1:\n";
  const unsigned operations = in_do ? draw(4) : 1 + draw(6);
  for (unsigned i = 0; i < operations; ++i) {
    const bool skips = draw(12) == 0;
    if (skips) text += branch(draw) + "3f\n";
    text += operation(draw);
    if (skips) text += "3:\n";
  }
  text += in_do ? "4: nop\n" : branch(draw) + "1b\n";
  text += " inc w9, w9\n bra 2b\nshort: nop\n return\n";
  text += "__T1Interrupt: bclr IFS0, #T1IF\n" + std::string(draw(2) ? " inc w10, w10\n" : " inc count\n") +
          " retfie\n .bss\nflags: .space 2\nword: .space 6\ncount: .space 2\n";
  return text;
}

TEST(Counting, any_loop_goes_the_same_way_jumped_over_or_not) {
  int jumped = 0;
  constexpr int kLoops = 2000;
  for (std::uint32_t seed = 1; seed <= kLoops; ++seed) {
    const std::string text = random_loop(seed);
    CoreBench whole(text, {}, false), steps(text, {}, false);
    Draw draw{seed};
    Cycle to = 0;
    for (int cut = 0; cut < 12; ++cut) {
      whole.run(whole.cpu->now() + 1 + draw(draw(2) ? 3000 : 100));
      for (; steps.cpu->now() < whole.cpu->now(); ++to) steps.run(to);
      ASSERT_EQ(steps.cpu->now(), whole.cpu->now()) << seed << "\n" << text;
      ASSERT_EQ(steps.cpu->pc(), whole.cpu->pc()) << seed << "\n" << text;
      ASSERT_EQ(steps.cpu->state_hash(), whole.cpu->state_hash()) << seed << "\n" << text;
      ASSERT_EQ(steps.cpu->idle(steps.cpu->now()), whole.cpu->idle(whole.cpu->now())) << seed << "\n" << text;
    }
    EXPECT_EQ(steps.cpu->jumped(), 0);
    jumped += whole.cpu->jumped() > 0;
  }
  EXPECT_GT(jumped, kLoops / 4);
}

}  // namespace
