// SPDX-License-Identifier: MIT
// What translated code takes at one look: the page of the PSV window, both words of a return address.
#include <gtest/gtest.h>

#include <string>

#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
using bench::Draw;

// it runs as interpreted, wherever it is cut
void expect_alike(const std::string& text, CoreBench& translated) {
  CoreBench interpreted(text, {}, false);
  Draw draw{7};
  for (Cycle end = 0; end < 60000; end += 1 + draw(draw(3) ? 3000 : 40)) {
    interpreted.run(end);
    translated.run(end);
    ASSERT_EQ(interpreted.cpu->pc(), translated.cpu->pc()) << end;
    ASSERT_EQ(interpreted.cpu->state_hash(), translated.cpu->state_hash()) << end;
  }
  EXPECT_GT(translated.cpu->cpu().table().translated(), 0);
}

// another page each time, in the loop and in a handler that pushes and pops it
TEST(TranslatedBounds, the_window_shows_the_page_that_was_chosen) {
  const std::string text = R"(__reset: mov #0x2700, w0
    mov w0, SPLIM
    mov #149, w0
    mov w0, PR1
    mov #0x8000, w0
    mov w0, T1CON
    bset IEC0, #T1IE
    bset CORCON, #PSV
    clr w3
    clr w7
loop: mov #psvpage(first), w4
    mov w4, PSVPAG
    mov #psvoffset(first), w1
    mov [w1], w2
    add w3, w2, w3
    mov #psvpage(second), w4
    mov w4, PSVPAG
    mov [w1], w2
    add w3, w2, w3
    mov [w1], w2
    add w7, w2, w7
    bra loop
__T1Interrupt: push.d w0
    push w2
    push PSVPAG
    bclr IFS0, #T1IF
    mov #psvpage(third), w0
    mov w0, PSVPAG
    mov #psvoffset(third), w1
    mov [w1], w2
    mov 0x0910, w0
    add w2, w0, w0
    mov w0, 0x0910
    pop PSVPAG
    pop w2
    pop.d w0
    retfie
    .section .first, code, address(0x8100)
first: .pword 5
    .section .second, code, address(0x10100)
second: .pword 0x11
    .section .third, code, address(0x4100)
third: .pword 3)";
  CoreBench translated(text, {}, true);
  expect_alike(text, translated);
  // a round adds 5 + 0x11 to W3, 0x11 to W7; a call of the handler 3
  ASSERT_TRUE(translated.run_to("loop"));
  EXPECT_EQ(translated.w(3) * 0x11 & 0xFFFF, translated.w(7) * 0x16 & 0xFFFF);
  EXPECT_GT(translated.w(7), 0);
  const int sum = translated.cpu->ram(0x0910) | translated.cpu->ram(0x0911) << 8;
  EXPECT_EQ(sum % 3, 0);
  EXPECT_GT(sum, 600);
}

// W15 comes up to SPLIM and beyond it: calls, frames and what is pushed trap where they would
TEST(TranslatedBounds, the_stack_ends_where_it_does) {
  const std::string text = R"(__reset: mov #0x2700, w0
    mov w0, SPLIM
    mov #0x26E0, w8
    clr w9
    clr w10
loop: mov w8, w15
    rcall f
    inc w9, w9
next: inc2 w8, w8
    mov #0x2710, w0
    cp w8, w0
    bra ltu, loop
    mov #0x26E0, w8
    bra loop
f:  lnk #4
    mov w8, [w14]
    mov [w14], w11
    rcall g
    ulnk
    return
g:  push w9
    pop w12
    return
__StackError: mov #0x1F00, w15
    clr INTCON1
    inc w10, w10
    mov #lo16(next), w0
    push w0
    clr w0
    push w0
    retfie)";
  CoreBench translated(text, {}, true);
  expect_alike(text, translated);
  // of 24 places some are deep enough, some are not
  EXPECT_GT(translated.w(9), 100);
  EXPECT_GT(translated.w(10), 100);
}

}  // namespace
