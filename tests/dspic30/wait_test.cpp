// SPDX-License-Identifier: MIT
// Waits that are jumped over, against the same programs run instruction by instruction.
#include "tests/dspic30/core_bench.h"

#include <iterator>

namespace {

using bench::CoreBench;
using bench::Cycle;

const char* const kWaits[] = {
    // a flag in RAM that a handler sets, in a function that is called
    R"(
__reset: mov #__SP_init, w15
    mov #999, w0
    mov w0, PR1
    clr flag
    clr w1
    bset IEC0, #T1IE
    bset T1CON, #15
1:  rcall ready
    cp0 w0
    bra z, 1b
    clr flag
    inc w1, w1
    bra 1b
ready: push w2
    mov flag, w0
    pop w2
    return
__T1Interrupt: bclr IFS0, #T1IF
    setm flag
    retfie
    .bss
flag: .space 2)",
    // of two handlers one changes nothing that the wait looks at, the other ends it: when is in w5
    R"(
__reset: mov #__SP_init, w15
    mov #2000, w0
    mov w0, PR1
    mov #300, w0
    mov w0, PR2
    clr flags
    clr other
    clr w1
    clr w5
    bset IEC0, #T1IE
    bset IEC0, #T2IE
    bset T1CON, #15
    bset T2CON, #15
1:  cp0 other
    bra nz, 2f
    cp0.b flags+1
    bra z, 1b
2:  mov TMR1, w4
    add w4, w5, w5
    clr flags
    inc w1, w1
    bra 1b
__T1Interrupt: bclr IFS0, #T1IF
    bset.b flags+1, #2
    retfie
__T2Interrupt: bclr IFS0, #T2IF
    retfie
    .bss
flags: .space 2
other: .space 2)",
    // one handler changes how the round rounds, and so what it comes to; the other looks at that
    R"(
__reset: mov #__SP_init, w15
    mov #19997, w0
    mov w0, PR1
    mov #300, w0
    mov w0, PR2
    mov #6, w1
    mov #0x1234, w0
    lac w0, a
    mov #0x8000, w0
    mov w0, ACCAL
    clr never
    clr sum
    bset IEC0, #T1IE
    bset IEC0, #T2IE
    bset T1CON, #15
    bset T2CON, #15
1:  sac.r a, w2
    cp0 never
    bra z, 1b
__T1Interrupt: bclr IFS0, #T1IF
    btg CORCON, #RND
    retfie
__T2Interrupt: bclr IFS0, #T2IF
    mov w2, w0
    xor sum
    retfie
    .bss
sum: .space 2
never: .space 2)",
    // a handler changes a register
    R"(
__reset: mov #__SP_init, w15
    mov #2000, w0
    mov w0, PR1
    mov #300, w0
    mov w0, PR2
    clr w1
    clr w3
    clr w5
    bset IEC0, #T1IE
    bset IEC0, #T2IE
    bset T1CON, #15
    bset T2CON, #15
1:  cp0 w3
    bra z, 1b
    mov TMR1, w4
    add w4, w5, w5
    clr w3
    inc w1, w1
    bra 1b
__T1Interrupt: bclr IFS0, #T1IF
    mov #1, w3
    retfie
__T2Interrupt: bclr IFS0, #T2IF
    retfie)",
    // a handler looks at what the round left beyond the stack's end, and leaves something else there
    R"(
__reset: mov #__SP_init, w15
    mov #300, w0
    mov w0, PR2
    mov #6, w1
    mov #0x1111, w2
    clr never
    clr sum
    bset IEC0, #T2IE
    bset T2CON, #15
1:  rcall ready
    cp0 w4
    bra z, 1b
ready: push w2
    mov never, w4
    pop w2
    return
__T2Interrupt: bclr IFS0, #T2IF
    mov [w15], w0
    xor sum
    mov #0x7777, w6
    push w6
    pop w6
    retfie
    .bss
never: .space 2
sum: .space 2)",
    // a handler returns to another priority, which the round reads
    R"(
__reset: mov #__SP_init, w15
    mov #19997, w0
    mov w0, PR1
    mov #300, w0
    mov w0, PR2
    mov #6, w1
    clr never
    clr sum
    mov #0x2000, w8
    clr w9
    bset IEC0, #T1IE
    bset IEC0, #T2IE
    bset T1CON, #15
    bset T2CON, #15
1:  mov SR, w2
    cp0 never
    bra z, 1b
__T1Interrupt: bclr IFS0, #T1IF
    push w9
    mov [w15-4], w9
    xor w8, w9, w9
    mov w9, [w15-4]
    pop w9
    retfie
__T2Interrupt: bclr IFS0, #T2IF
    mov w2, w0
    xor sum
    retfie
    .bss
never: .space 2
sum: .space 2)",
    // a flag of the interrupt controller, polled
    R"(
__reset: mov #1234, w0
    mov w0, PR2
    clr w1
    bset T2CON, #15
1:  btss IFS0, #T2IF
    bra 1b
    bclr IFS0, #T2IF
    inc w1, w1
    bra 1b)",
    // room in a transmitter
    R"(
__reset: mov #95, w0
    mov w0, U1BRG
    mov #0x8000, w0
    mov w0, U1MODE
    bset U1STA, #10
    clr w1
1:  btsc U1STA, #9
    bra 1b
    inc w1, w1
    mov w1, U1TXREG
    bra 1b)",
    // a counting register is no wait, but one can be seen through it
    R"(
__reset: mov #0xFFFF, w0
    mov w0, PR3
    clr w1
    bset T3CON, #15
1:  mov TMR3, w2
    mov #30000, w3
    cp w2, w3
    bra ltu, 1b
    clr TMR3
    inc w1, w1
    bra 1b)"};

TEST(Wait, is_jumped_over_without_a_change_of_course) {
  for (const char* text : kWaits) {
    CoreBench whole(text), steps(text);
    whole.run(300000);
    for (Cycle to = 1; to < 300000; ++to) steps.run(to);
    steps.run(whole.cpu->now());
    EXPECT_GT(whole.w(1), 5u) << text;
    EXPECT_EQ(steps.cpu->now(), whole.cpu->now()) << text;
    EXPECT_EQ(steps.cpu->state_hash(), whole.cpu->state_hash()) << text;
    EXPECT_EQ(steps.cpu->cpu().waits->jumped(), 0) << text;
    EXPECT_GT(whole.cpu->cpu().waits->jumped(), text == *std::rbegin(kWaits) ? -1 : 200000) << text;
  }
}

// RETFIE leaves DC as the handler left it, so the first round behind it ends in other flags
TEST(Wait, goes_on_at_once_behind_an_interrupt) {
  CoreBench b(R"(
__reset: mov #__SP_init, w15
    mov #1999, w0
    mov w0, PR1
    clr flag
    bset IEC0, #T1IE
    bset T1CON, #15
1:  cp0 flag
    bra z, 1b
__T1Interrupt: bclr IFS0, #T1IF
    mov #1, w2
    add w2, w2, w2
    retfie
    .bss
flag: .space 2)");
  b.run(200000);
  EXPECT_EQ(b.w(2), 2u);
  EXPECT_GT(b.cpu->cpu().waits->jumped(), 190000);
}

// found by fuzzing: a look for a wait counted the cycles of what is repeated instead of the REPEAT's
TEST(Wait, a_look_at_a_repeat_takes_its_time) {
  const std::string text =
      "__reset: mov #0x900, w1\n1: repeat #20\n mov.d [w1], w2\n inc w4, w4\n mov w4, 0x910\n bra 1b";
  CoreBench whole(text), steps(text);
  whole.run(20000);
  for (Cycle to = 1; to < 20000; ++to) steps.run(to);
  steps.run(whole.cpu->now());
  EXPECT_EQ(steps.cpu->now(), whole.cpu->now());
  EXPECT_EQ(steps.cpu->state_hash(), whole.cpu->state_hash());
}

// rounds that look alike in registers, but change two words of RAM or take bytes out of a FIFO
TEST(Wait, a_round_that_changes_something_is_none) {
  CoreBench b("__reset: clr w1\n1: inc 0x900\n inc 0x902\n bra 1b");
  b.run(100000);
  EXPECT_EQ(b.cpu->cpu().waits->jumped(), 0);
  CoreBench fifo("__reset: clr w1\n1: mov U1RXREG, w0\n bra 1b");
  fifo.run(100000);
  EXPECT_EQ(fifo.cpu->cpu().waits->jumped(), 0);
}

// --- where waits begin: as many places as a program needs, and up to 32 of one kind

TEST(WaitHeads, of_equal_places_are_all_kept_until_there_is_no_more_room) {
  constexpr int kApart = 8, kMost = 32, kTried = 4;
  std::vector<dspic::Decoded> code(2 * kApart * kMost);
  dspic::WaitHeads heads;
  EXPECT_FALSE(heads.has(&code[0]));
  const auto nobody = [](const dspic::Decoded*) {};
  heads.move(code.data(), nobody);
  // eight apart, so that they collide as long as there is room for eight, then for 16
  for (int n = 0; n < 2 * kTried; ++n) {
    heads.add(&code[static_cast<std::size_t>(n * kApart)]);
    for (int known = 0; known <= n; ++known)
      EXPECT_TRUE(heads.has(&code[static_cast<std::size_t>(known * kApart)])) << n << ", " << known;
    EXPECT_FALSE(heads.has(&code[static_cast<std::size_t>((n + 1) * kApart)]));
  }
  // what was known of one goes along: it pauses 50 cycles, and twice as long each time
  heads.forget();
  heads.add(&code[0]);
  heads.pause(&code[0], false, 1000);
  for (int n = 1; n <= kTried; ++n) heads.add(&code[static_cast<std::size_t>(n * kApart)]);
  EXPECT_FALSE(heads.is_due(&code[0], 1049));
  EXPECT_TRUE(heads.is_due(&code[0], 1050));
  // ... and to other words: each is told of
  std::vector<dspic::Decoded> far(kMost * (kTried + 1));
  int told = 0;
  heads.move(far.data(), [&](const dspic::Decoded* head) {
    EXPECT_EQ((head - far.data()) % kApart, 0);
    ++told;
  });
  EXPECT_EQ(told, kTried + 1);
  EXPECT_FALSE(heads.is_due(&far[0], 1049));
  EXPECT_TRUE(heads.is_due(&far[0], 1050));
  // 32 words apart only four have room: the fifth takes the place of one
  heads.forget();
  EXPECT_FALSE(heads.has(&far[0]));
  for (int n = 0; n <= kTried; ++n) heads.add(&far[static_cast<std::size_t>(n * kMost)]);
  int kept = 0;
  for (int n = 0; n <= kTried; ++n) kept += heads.has(&far[static_cast<std::size_t>(n * kMost)]);
  EXPECT_EQ(kept, kTried);
  EXPECT_TRUE(heads.has(&far[kTried * kMost]));
}

// --- what is known of them: four of one place, whichever words they lie in

TEST(KnownWaits, of_equal_places_are_all_found_until_there_is_no_more_room) {
  constexpr std::ptrdiff_t kApart = 16, kTried = 4;
  CoreBench b("__reset: bra __reset");
  const dspic::Decoded* const code = b.cpu->cpu().code();
  dspic::KnownWaits known;
  known.move(code);
  const auto add = [&](std::ptrdiff_t n, Cycle took) {
    dspic::KnownWaits::Wait wait;
    wait.first = code + n * kApart;
    wait.took = took;
    known.add(b.cpu->cpu(), wait);
  };
  for (std::ptrdiff_t n = 0; n < kTried; ++n) add(n, n + 1);
  add(2, 30);  // once more: it is another one now
  for (std::ptrdiff_t n = 0; n < kTried; ++n) {
    ASSERT_TRUE(known.at(code + n * kApart)) << n;
    EXPECT_EQ(known.at(code + n * kApart)->took, n == 2 ? 30 : n + 1);
  }
  EXPECT_FALSE(known.at(code + kTried * kApart));
  EXPECT_FALSE(known.at(code + 1));
  // all go along to other words
  const std::vector<dspic::Decoded> other(kApart * (kTried + 1));
  known.move(other.data());
  EXPECT_FALSE(known.at(code));
  for (std::ptrdiff_t n = 0; n < kTried; ++n)
    EXPECT_TRUE(known.at(&other[static_cast<std::size_t>(n * kApart)]));
  known.forget();
  EXPECT_FALSE(known.at(other.data()));
}

}  // namespace
