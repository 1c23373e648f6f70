// SPDX-License-Identifier: MIT
// Loops that count: jumped over without a change of course, and counted as waits.
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
using bench::Draw;

// --- loops that make no sense

std::string number(Draw& draw) {
  const unsigned kind = draw(4);
  const unsigned value = kind == 0   ? draw(0x10000)
                         : kind == 1 ? draw(400)
                         : kind == 2 ? 0x10000 - 1 - draw(400)
                                     : 0x8000 - 200 + draw(400);
  return std::to_string(value);
}

std::string operation(Draw& draw) {
  static const char* const kOperations[] = {"add w0, #K, w0",
                                            "sub w0, #K, w0",
                                            "inc w0, w0",
                                            "dec w0, w0",
                                            "inc2 w0, w0",
                                            "dec2 w0, w0",
                                            "add #J, w0",
                                            "sub #J, w0",
                                            "subr w0, #K, w1",
                                            "mov w0, w1",
                                            "add w0, w2, w1",
                                            "sub w0, w2, w1",
                                            "sub w2, w0, w1",
                                            "subr w0, w2, w1",
                                            "cp w0, w2",
                                            "cp w2, w0",
                                            "cp w0, #K",
                                            "cp0 w0",
                                            "cpb w1, w3",
                                            "addc w1, #0, w1",
                                            "subb w1, #0, w1",
                                            "neg w0, w1",
                                            "mov w0, [w8]",
                                            "mov [w8], w0",
                                            "inc [w8], [w8]",
                                            "inc word",
                                            "dec word",
                                            "mov word, w0",
                                            "mov w0, word",
                                            "add word",
                                            "sub word, WREG",
                                            "cp word",
                                            "sub w0, w2, [w15]",
                                            "sub w2, w0, [w15]",
                                            "nop",
                                            "repeat #3\n nop",
                                            "inc.b w0, w0",
                                            "ze w0, w1",
                                            "and w0, #15, w1",
                                            "btss w0, #3",
                                            "clr w1",
                                            "mov #3, w3",
                                            "rcall short",
                                            "mov [w8+2], w4",
                                            "mov w0, [w8+4]",
                                            "mov w1, w0",
                                            "mov word, WREG",
                                            "addc w1, w4, w1",
                                            "subbr w1, w3, w4",
                                            "add w0, w0, w1",
                                            "mov.d w0, w4",
                                            "mov.d w0, [w8]",
                                            "push w0\n pop w1",
                                            "inc w5, w5",
                                            "com w0, w1",
                                            "mov word",
                                            "btsc flags, #2",
                                            "mov.b w0, [w8]",
                                            "subb w0, w1, w1",
                                            "add w0, w1, w0"};
  std::string text = kOperations[draw(draw(2) ? 12 : std::size(kOperations))];
  if (const auto at = text.find('K'); at != std::string::npos) text.replace(at, 1, std::to_string(draw(32)));
  if (const auto at = text.find('J'); at != std::string::npos)
    text.replace(at, 1, std::to_string(draw(1024)));
  return " " + text + "\n";
}

std::string branch(Draw& draw) {
  static const char* const kConditions[] = {"z",  "nz", "c",  "nc",  "n",   "nn", "lt",
                                            "le", "gt", "ge", "gtu", "leu", "ov", "nov"};
  return std::string(" bra ") + kConditions[draw(std::size(kConditions))] + ", ";
}

std::string random_loop(std::uint32_t seed) {
  Draw draw{seed * 2654435761u};
  std::string text = "__reset: mov #__SP_init, w15\n mov #word, w8\n clr w9\n";
  for (const char* reg : {"w0", "w1", "w2", "w3", "w4", "w5"})
    text += " mov #" + number(draw) + ", " + reg + "\n";
  text += " mov w3, word\n mov w4, word+2\n mov w1, word+4\n mov #7, w10\n mov w10, flags\n";
  if (draw(2))
    text += " mov #" + std::to_string(200 + draw(3000)) +
            ", w10\n mov w10, PR1\n bset IEC0, #T1IE\n bset T1CON, #15\n";
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
    EXPECT_EQ(steps.cpu->cpu().waits->jumped(), 0);
    jumped += whole.cpu->cpu().waits->jumped() > 0;
  }
  EXPECT_GT(jumped, kLoops / 2);
}

// --- delays as people and compilers write them; how much of the time at least is waited

struct Delay {
  const char* name;
  double idle;
  const char* text;
};
const Delay kDelays[] = {
    {"a register down", 0.99,
     "__reset: clr w9\n2: mov #30000, w0\n1: dec w0, w0\n nop\n bra nz, 1b\n inc w9, w9\n bra 2b"},
    {"up to a bound beyond the sign", 0.99,
     "__reset: mov #50000, w1\n2: clr w0\n1: inc w0, w0\n cp w0, w1\n bra ltu, 1b\n inc w9, w9\n bra 2b"},
    {"a word of the stack, signed, without optimisation", 0.99,
     R"(__reset: mov #__SP_init, w15
2:  lnk #2
    clr w0
    mov w0, [w14]
    bra 3f
1:  nop
    inc [w14], [w14]
3:  mov #20000, w0
    mov [w14], w1
    sub w1, w0, [w15]
    bra lt, 1b
    ulnk
    inc w9, w9
    bra 2b)"},
    {"32 bits in registers", 0.99, R"(__reset: nop
2:  mov #0xE000, w0
    clr w1
    mov #0x2345, w2
    mov #1, w3
1:  nop
    add w0, #1, w0
    addc w1, #0, w1
    sub w0, w2, w4
    subb w1, w3, w4
    bra ltu, 1b
    inc w9, w9
    bra 2b)"},
    {"32 bits on the stack", 0.96, R"(__reset: mov #__SP_init, w15
2:  lnk #4
    mov #0x2345, w2
    mov #1, w3
    mov #0xE000, w6
    mov w2, [w14]
    mov w3, [w14+2]
1:  mov [w14], w0
    mov [w14+2], w1
    sub w0, #1, w0
    subb w1, #0, w1
    mov w0, [w14]
    mov w1, [w14+2]
    mov.d [w14], w4
    cp w4, w6
    cpb w5, #0
    bra c, 1b
    ulnk
    inc w9, w9
    bra 2b)"},
    {"one in another", 0.95, R"(__reset: clr w9
2:  mov #50, w1
1:  mov #400, w0
3:  dec w0, w0
    bra nz, 3b
    dec w1, w1
    bra nz, 1b
    inc w9, w9
    bra 2b)"},
    {"a short one in another", 0.95, R"(__reset: clr w9
2:  mov #2000, w1
1:  mov #5, w0
3:  dec w0, w0
    bra nz, 3b
    dec w1, w1
    bra nz, 1b
    inc w9, w9
    bra 2b)"},
    {"DO", 0.97, "__reset: clr w9\n2: do #9999, 1f\n nop\n1: nop\n inc w9, w9\n bra 2b"},
    {"rounds of repeated NOPs", 0.99, R"(__reset: clr w9
2:  mov #100, w0
1:  repeat #150
    nop
    dec w0, w0
    bra nz, 1b
    inc w9, w9
    bra 2b)"},
    {"a function that is called in each round", 0.99, R"(__reset: mov #__SP_init, w15
2:  mov #9000, w0
1:  rcall short
    sub w0, #1, w0
    bra nn, 1b
    inc w9, w9
    bra 2b
short: nop
    return)"},
    {"a flag with a time limit", 0.99, R"(__reset: mov #__SP_init, w15
    clr flags
2:  mov #20000, w0
1:  btsc flags, #3
    bra 3f
    dec w0, w0
    bra nz, 1b
3:  inc w9, w9
    bra 2b
    .bss
flags: .space 2)"},
    {"a peripheral's flag with a time limit", 0.9, R"(__reset: mov #20000, w0
    mov w0, PR2
    bset T2CON, #15
2:  mov #8000, w0
1:  btsc IFS0, #T2IF
    bra 3f
    dec w0, w0
    bra nz, 1b
3:  bclr IFS0, #T2IF
    inc w9, w9
    bra 2b)"}};

TEST(Counting, delays_are_waits) {
  for (const Delay& delay : kDelays) {
    for (const bool interrupted : {false, true}) {
      std::string text = delay.text;
      if (interrupted) {
        const auto at = text.find(':') + 1;
        text.insert(
            at,
            " mov #__SP_init, w15\n mov #1999, w10\n mov w10, PR1\n bset IEC0, #T1IE\n bset T1CON, #15\n");
        text.insert(text.find("    .bss") == std::string::npos ? text.size() : text.find("    .bss"),
                    "\n__T1Interrupt: bclr IFS0, #T1IF\n inc w11, w11\n retfie\n");
      }
      for (const bool translates : {false, true}) {
        CoreBench whole(text, {}, translates), steps(text, {}, translates);
        constexpr Cycle kEnd = 700000;
        whole.run(kEnd);
        for (Cycle to = 1; to < kEnd; to += 7) steps.run(to);
        steps.run(whole.cpu->now());
        const std::string what = std::string(delay.name) + (interrupted ? ", interrupted" : "");
        EXPECT_EQ(steps.cpu->now(), whole.cpu->now()) << what;
        EXPECT_EQ(steps.cpu->state_hash(), whole.cpu->state_hash()) << what;
        EXPECT_EQ(steps.cpu->idle(kEnd), whole.cpu->idle(kEnd)) << what;
        EXPECT_GT(whole.w(9), 1u) << what;
        // behind an interrupt the way to the loop's first instruction is work
        const double idle = static_cast<double>(whole.cpu->idle(kEnd)) / kEnd;
        EXPECT_GT(idle, delay.idle - (interrupted ? 0.02 : 0)) << what << (translates ? ", translated" : "");
      }
    }
  }
}

// waits with a time limit, one after the other, each ended by what a handler does: all are counted, whatever
// comes in between, and however many there are
std::string waits_in_turn(int many) {
  std::string text = R"(__reset: mov #__SP_init, w15
    mov #799, w10
    mov w10, PR1
    bset IEC0, #T1IE
    bset T1CON, #15
again:)";
  for (int i = 0; i < many; ++i) {
    const std::string n = std::to_string(i);
    text += "\n    setm flag\n    mov #20000, w0\n    mov #0, w1\nwait" + n +
            ":\n    sub w0, #1, w0\n    subb w1, #0, w1\n    bra z, out" + n +
            "\n    cp0 flag\n    bra nz, wait" + n + "\nout" + n +
            ": inc w9, w9\n    clr PORTB\n    repeat #" + std::to_string(13 + 2 * i) + "\n    mov w2, w3\n";
  }
  return text + R"(    bra again
__T1Interrupt: bclr IFS0, #T1IF
    clr flag
    retfie
    .bss
flag: .space 2)";
}

TEST(Counting, waits_that_come_in_turn_are_all_found) {
  constexpr Cycle kEnd = 4000000;
  for (const int many : {2, 7, 12}) {
    CoreBench whole(waits_in_turn(many), {}, false), steps(waits_in_turn(many), {}, false);
    whole.run(kEnd / 2);
    const Cycle before = whole.cpu->idle(kEnd / 2), jumped = whole.cpu->cpu().waits->jumped();
    whole.run(kEnd);
    for (Cycle to = 1; to < kEnd; to += 997) steps.run(to);
    steps.run(whole.cpu->now());
    EXPECT_EQ(steps.cpu->state_hash(), whole.cpu->state_hash()) << many;
    EXPECT_EQ(steps.cpu->idle(kEnd), whole.cpu->idle(kEnd)) << many;
    EXPECT_NEAR(whole.w(9), kEnd / 800, 2) << many;
    // of 800 cycles some 60 are work: the handler, the way to the next wait, the rest of a round
    EXPECT_GT(static_cast<double>(whole.cpu->idle(kEnd) - before) / (kEnd / 2), 0.9) << many;
    EXPECT_GT(static_cast<double>(whole.cpu->cpu().waits->jumped() - jumped) / (kEnd / 2), 0.85) << many;
  }
}

}  // namespace
