// SPDX-License-Identifier: MIT
// Translated code against the interpreter: constants, calls, pointers, programs that write themselves.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "dspic30/core/cpu.h"
#include "dspic30/core/known_calls.h"
#include "dspic30/translate/stretch.h"
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
using bench::Draw;
using bench::kFlashMacro;

// one more cycle for a MOV, two for what computes; words of a page that is not the first,
// bytes of both halves
TEST(Translation, constants_through_the_window_are_read_in_a_stretch) {
  for (const bool translated : {false, true}) {
    CoreBench b(R"(__reset: bset CORCON, #PSV
    mov #psvpage(table), w0
    mov w0, PSVPAG
    mov #100, w5
    clr w6
    clr w7
loop: mov #psvoffset(table), w1
    mov.d [w1], w8
    mov [w1++], w2
    add w6, [w1++], w6
    mov.b [w1++], w3
    ze w3, w3
    mov.b [w1], w4
    ze w4, w4
    add w7, w2, w7
    add w7, w3, w7
    add w7, w4, w7
    dec w5, w5
    bra nz, loop
end: bra end
    .section .table, code, address(0x12340)
table: .pword 0xAB0102
    .pword 0x000003
    .pword 0x120504)",
                {}, translated);
    EXPECT_TRUE(b.run_to("loop"));
    const Cycle start = b.cpu->now();
    ASSERT_TRUE(b.run_to("end"));
    EXPECT_EQ(b.w(6), 300u);
    EXPECT_EQ(b.w(7), (100u * (0x0102 + 4 + 5)) & 0xFFFF);
    // thirteen instructions, two of MOV.D, one stall behind MOV of W1, BRA; a read of MOV costs 1, of ADD 2
    EXPECT_EQ(b.cpu->now() - start, 100 * (13 + 1 + 1 + 1 + 1 + 1 + 2 + 1 + 1) - 1);
    EXPECT_EQ(b.w(8), 0x0102u);
    EXPECT_EQ(b.w(9), 3u);
    EXPECT_EQ(b.cpu->cpu().table().translated() > 0, translated);
  }
}

// --- functions that are called

/// Keeps what was translated together, by the address where it begins.
struct Onlooker final : dspic::Translator {
  std::map<unsigned, std::vector<dspic::translate::Item>> stretches;
  dspic::translate::Translations translations{chip::translator_library(), {}};
  dspic::Translation translate(const dspic::Cpu& cpu, const dspic::Decoded* head, bool only_ready) override {
    stretches[cpu.address_of(head)] = dspic::translate::stretch(cpu, head);
    return translations.translate(cpu, head, only_ready);
  }
};

// a function within a function, one by a handle, and one that ends in another: three cycles for a RETURN
TEST(Translation, short_functions_become_part_of_the_loop_that_calls_them) {
  const std::string text = R"(__reset: mov #100, w5
    mov #3, w0
loop: rcall outer
    call far
    dec w5, w5
    bra nz, loop
end: bra end
outer: rcall inner
    inc w2, w2
    return
inner: inc w1, w1
    btsc w1, #0
    inc w3, w3
    retlw #7, w4
    .section .far, code, address(0x9000)
far: goto farther
    .section .farther, code, address(0x9800)
farther: add w6, w4, w6
    bra inner)";
  Onlooker onlooker;
  CoreBench plain(text, {}, false), b(text, {}, false);
  b.cpu->set_translator(&onlooker);
  b.cpu->translate_all();
  for (CoreBench* which : {&plain, &b}) {
    EXPECT_TRUE(which->run_to("loop"));
    const Cycle start = which->cpu->now();
    EXPECT_TRUE(which->run_to("end", 10000));
    // calls 2 each, returns 3 each; BTSC over INC or not takes as long
    const Cycle inner = 1 + 2 + 3, outer = 2 + inner + 1 + 3, far = 2 + 2 + 1 + 2 + inner;
    EXPECT_EQ(which->cpu->now() - start, 100 * (2 + outer + far + 1 + 2) - 1);
    EXPECT_EQ(which->w(1), 200u);
    EXPECT_EQ(which->w(2), 100u);
    EXPECT_EQ(which->w(3), 100u);
    EXPECT_EQ(which->w(6), 700u);
    EXPECT_EQ(which->w(15), 0x800u);
  }
  EXPECT_EQ(plain.cpu->state_hash(), b.cpu->state_hash());
  std::set<int> frames;
  for (const auto& item : onlooker.stretches[b.symbol("loop")]) frames.insert(item.frame);
  EXPECT_EQ(frames.size(), 4u);  // the loop, outer, inner, far with all it jumps to
}

// a function may return to where it was not called from; and its call may break the stack's limit
TEST(Translation, a_function_returns_where_the_stack_says) {
  for (const bool translated : {false, true}) {
    CoreBench b(R"(__reset: mov #0x0810, w0
    mov w0, SPLIM
    nop
    mov #100, w5
loop: rcall function
    inc w2, w2
    inc w3, w3
    dec w5, w5
    bra nz, loop
    mov #0x0810, w15
    bra loop
end: bra end
function: inc w1, w1
    dec2 w15, w15
    btsc w5, #0
    inc2 [--w15], [w15++]
    inc2 w15, w15
    return
__StackError: bra __StackError)",
                {}, translated);
    EXPECT_TRUE(b.run_to("__StackError", 10000));
    EXPECT_EQ(b.cpu->cpu().table().translated() > 0, translated);
    EXPECT_EQ(b.w(1), 100u);
    EXPECT_EQ(b.w(2), 50u);
    EXPECT_EQ(b.w(3), 100u);
    EXPECT_EQ(b.w(15), 0x0810u + 4 + 4);  // RCALL's two words, then the trap's
  }
}

// --- functions of the host

/// Function 0 looks: W0 becomes the time in 64s, in 20 cycles, and stays so. Function 1 changes something:
/// W0 and W1 are added up at 0x0900, and each seventh time the outlook is another. Function 2 waits until
/// a thousand's multiple.
struct Host final : dspic::HostCalls {
  std::vector<Cycle> calls;
  dspic::HostResult call(dspic::Cpu& cpu, unsigned index, Cycle at, bool again) override {
    if (!again) calls.push_back(at);
    if (index == 0) {
      cpu.w[0] = static_cast<std::uint16_t>(at >> 6);
      cpu.note_look(((at >> 6) + 1) << 6);
      return dspic::HostResult::done(20);
    }
    if (index == 2) {
      const Cycle until = (at + 999) / 1000 * 1000;
      return at < until ? dspic::HostResult::waits(until) : dspic::HostResult::done(5);
    }
    cpu.write16(0x0900, cpu.read16(0x0900) + cpu.w[0] + cpu.w[1]);
    cpu.w[0] = static_cast<std::uint16_t>(calls.size());
    cpu.note_effect();
    if (calls.size() % 7 == 0) cpu.host_changed();
    return dspic::HostResult::done(33);
  }
  std::vector<std::pair<unsigned, Cycle>> reads;
  std::uint16_t read(unsigned address, Cycle at) override {
    reads.emplace_back(address, at);
    return static_cast<std::uint16_t>(at / 3 + address);
  }
  void write(unsigned, std::uint16_t, std::uint16_t, Cycle) override {}
  Cycle horizon(unsigned, Cycle) override { return dspic::kNever; }
  std::uint16_t peek(unsigned, Cycle) const override { return 0; }
  Cycle due() const override { return dspic::kNever; }
  std::uint64_t share_q32() const override { return calls.size() % 3 << 28; }
  std::int64_t take_owed_q32() const override { return 0; }
  void begin_handler(Cycle) override {}
  dspic::HandlerStep next_in_handler(Cycle) override { return {}; }
  void end_handler(Cycle) override {}
  int vector(int) const override { return dspic::kNoVector; }
  void hold_handler(int, bool, bool, Cycle) override {}
  Cycle source_event(int, Cycle) const override { return dspic::kNever; }
  Cycle pending_cycles() const override { return 1; }
  std::uint16_t saved_registers() const override { return 0; }
  int saved_words() const override { return 0; }
  void reset(Cycle) override {}
};

// calls of the host stand in a loop as any instruction does, and it goes on behind them
TEST(Translation, functions_of_the_host_are_called_from_within_a_stretch) {
  const std::string text = R"(__reset: mov #0x2700, w0
    mov w0, SPLIM
    nop
    mov #99, w0
    mov w0, PR1
    mov #0x8000, w0
    mov w0, T1CON
    bset IEC0, #T1IE
    mov #0x0A00, w8
    clr w9
    clr w7
loop: rcall query
    xor w9, w0, w9
    add w9, #3, w9
    mov w9, w1
    call change
    mov w0, [w8]
    add w9, [w8], w9
    btsc w9, #5
    rcall wait
    inc w7, w7
    bra loop
__T1Interrupt: bclr IFS0, #T1IF
    inc 0x0904
    retfie
query: nop
    nop
change: nop
    nop
wait: nop
    nop)";
  Host hosts[2];
  CoreBench benches[2] = {CoreBench(text, {}, false), CoreBench(text, {}, false)};
  Onlooker onlooker;
  for (int i = 0; i < 2; ++i) {
    CoreBench& b = benches[i];
    unsigned index = 0;
    for (const char* name : {"query", "change", "wait"}) {  // a GOTO beyond the flash
      b.program.write(b.symbol(name), 0x040000 + 2 * index++);
      b.program.write(b.symbol(name) + 2, 0x40);
    }
    b.cpu = std::make_unique<dspic::Processor>(*b.chip, b.program, nullptr, &hosts[i]);
    if (i == 0) continue;
    b.cpu->set_translator(&onlooker);
    b.cpu->translate_all();
  }
  Draw draw{7};
  for (Cycle end = 0; end < 100000; end += 1 + draw(draw(3) ? 3000 : 60)) {
    for (CoreBench& b : benches) b.run(end);
    ASSERT_EQ(benches[0].cpu->now(), benches[1].cpu->now());
    ASSERT_EQ(benches[0].cpu->pc(), benches[1].cpu->pc());
    ASSERT_EQ(benches[0].cpu->state_hash(), benches[1].cpu->state_hash());
  }
  EXPECT_EQ(hosts[0].calls, hosts[1].calls);
  EXPECT_GT(hosts[0].calls.size(), 300u);
  EXPECT_GT(benches[1].word(0x0904), 500u);
  const auto& items = onlooker.stretches[benches[1].symbol("loop")];
  // the third one was not met yet when the loop was translated
  EXPECT_EQ(std::count_if(items.begin(), items.end(), [](const auto& item) { return item.is_host; }), 2);
  EXPECT_EQ(items.size(), 10u);
}

// what counts as waited is the same when a wait's loop was translated before it was known as one
TEST(Translation, waits_are_counted_as_interpreted) {
  const std::string text = R"(__reset: mov #0x2700, w0
    mov w0, SPLIM
    mov #899, w0
    mov w0, PR1
    mov #0x8000, w0
    mov w0, T1CON
    bset IEC0, #T1IE
    clr w3
turn: clr 0x0904
    mov #65, w0
loop: mov 0x0904, w1
    cp w1, w0
    bra ltu, loop
    inc w3, w3
    mov #37, w2
work: dec w2, w2
    bra nz, work
    bra turn
__T1Interrupt: bclr IFS0, #T1IF
    inc 0x0904
    retfie)";
  Onlooker onlooker;
  CoreBench first(text, {}, false), ready(text, {}, false), plain(text, {}, false);
  first.cpu->set_translator(&onlooker);
  first.cpu->translate_all();
  first.run(100000);
  ready.cpu->set_translator(&onlooker);
  for (Cycle end = 50000; end < 2000000; end += 50000) {
    for (CoreBench* b : {&ready, &plain}) b->run(end);
    ASSERT_EQ(ready.cpu->now(), plain.cpu->now());
    ASSERT_EQ(ready.cpu->idle(end), plain.cpu->idle(end)) << end;
  }
  EXPECT_GT(ready.cpu->cpu().table().translated(), 0);
}

// what the host serves is read in the middle, words and bytes, at the same cycles
TEST(Translation, served_variables_are_read_within_a_stretch) {
  const std::string text = R"(__reset: mov #0x2700, w0
    mov w0, SPLIM
    nop
    mov #0x0A00, w15
    mov #99, w0
    mov w0, PR1
    mov #0x8000, w0
    mov w0, T1CON
    bset IEC0, #T1IE
    mov #0x0804, w10
    mov #0x0906, w11
    clr w3
    clr w5
    clr w7
loop: mov [w10++], w2
    add w2, w3, w3
    mov.b [w10-1], w4
    ze w4, w4
    mov [--w10], w6
    add w4, w5, w5
    add w6, w5, [w11]
    inc w7, w7
    bra loop
__T1Interrupt: bclr IFS0, #T1IF
    inc 0x0904
    retfie)";
  Host hosts[2];
  CoreBench benches[2] = {CoreBench(text, {}, false), CoreBench(text, {}, false)};
  Onlooker onlooker;
  for (int i = 0; i < 2; ++i) {
    CoreBench& b = benches[i];
    b.cpu = std::make_unique<dspic::Processor>(*b.chip, b.program, nullptr, &hosts[i], 0x0900);
    if (i == 0) continue;
    b.cpu->set_translator(&onlooker);
    b.cpu->translate_all();
  }
  Draw draw{11};
  for (Cycle end = 0; end < 100000; end += 1 + draw(draw(3) ? 3000 : 60)) {
    for (CoreBench& b : benches) b.run(end);
    ASSERT_EQ(benches[0].cpu->now(), benches[1].cpu->now());
    ASSERT_EQ(benches[0].cpu->state_hash(), benches[1].cpu->state_hash());
  }
  EXPECT_EQ(hosts[0].reads, hosts[1].reads);
  EXPECT_GT(hosts[0].reads.size(), 10000u);
  EXPECT_EQ(onlooker.stretches[benches[1].symbol("loop")].size(), 9u);
}

// --- routines that are known by heart

// W2 where W1 is odd, else W1; but where W1 is a multiple of 16 it is not known
dspic::KnownAnswer choice_of(std::uint64_t w0_to_w3) {
  const auto w1 = static_cast<std::uint16_t>(w0_to_w3 >> 16), w2 = static_cast<std::uint16_t>(w0_to_w3 >> 32);
  if (w1 % 16 == 0) return {};
  return {(w0_to_w3 & ~std::uint64_t{0xFFFF}) | (w1 & 1 ? w2 : w1), 6};
}

// W1:W0 plus W5:W4, the low word at 0x0910 too, and the flags
int tally(dspic::Cpu& cpu, std::int64_t limit) {
  if (limit < 6) return 0;
  cpu.w[0] = static_cast<std::uint16_t>(cpu.add<false, false>(cpu.w[0], cpu.w[4], 0));
  cpu.w[1] = static_cast<std::uint16_t>(cpu.add<false, true>(cpu.w[1], cpu.w[5], cpu.flag_c()));
  cpu.write16(0x0910, cpu.w[0]);
  return 6;
}

// the answer is asked for in the loop, by a handle too; where the time is short, a loop of the chip ends
// somewhere, or RCOUNT is none, the routine runs
TEST(Translation, known_routines_are_answered_within_a_stretch) {
  const std::string text = R"(__reset: mov #0x2700, w0
    mov w0, SPLIM
    mov #99, w0
    mov w0, PR1
    mov #0x8000, w0
    mov w0, T1CON
    bset IEC0, #T1IE
    clr w2
    clr w3
    mov #0x9123, w4
    mov #0x8001, w5
    clr w6
    clr w7
    clr w8
    clr w9
    clr w10
loop: mov w8, w2
    mov w9, w1
    call choice
    mov w0, w8
    mov w9, w1
    call tally
    addc w10, w1, w10
    add 0x0910, wreg
    mov w0, w8
    add w9, #5, w9
    mov w9, w1
    call handle
    add w10, w0, w10
    do #2, last
    call choice
last: add w10, w0, w10
    bra loop
__T1Interrupt: bclr IFS0, #T1IF
    inc 0x0904
    retfie
handle: goto choice
    .section .choice, code, address(0x4000)
choice: mov w1, w0      ; no flags: after an answer they are as before, too
    btsc w1, #0
    mov w2, w0
    return
tally: add w0, w4, w0
    addc w1, w5, w1
    mov w0, 0x0910
    return)";
  const dspic::KnownRoutine choice{"_choice", 1, &choice_of, nullptr}, tally_{"_tally", 2, nullptr, &tally};
  Onlooker onlooker;
  CoreBench runs(text, {}, false), answers(text, {}, false), translated(text, {}, false);
  for (CoreBench* b : {&answers, &translated}) {
    auto calls = std::make_shared<dspic::KnownCalls>();
    calls->add(b->symbol("choice"), choice);
    calls->add(b->symbol("tally"), tally_);
    b->cpu->know(calls);
  }
  translated.cpu->set_translator(&onlooker);
  translated.cpu->translate_all();
  Draw draw{3};
  for (Cycle end = 0; end < 60000; end += 1 + draw(draw(3) ? 3000 : 40)) {
    for (CoreBench* b : {&runs, &answers, &translated}) b->run(end);
    for (CoreBench* b : {&answers, &translated}) {
      ASSERT_EQ(b->cpu->now(), runs.cpu->now()) << end;
      ASSERT_EQ(b->cpu->pc(), runs.cpu->pc()) << end;
      ASSERT_EQ(b->cpu->state_hash(), runs.cpu->state_hash()) << end;
    }
  }
  const auto& items = onlooker.stretches[translated.symbol("loop")];
  EXPECT_GE(
      std::count_if(items.begin(), items.end(), [](const auto& item) { return item.routine != nullptr; }), 3);
}

// two words that go round are worth it
TEST(Translation, short_loops_are_translated) {
  CoreBench b("__reset: mov #5000, w0\n1: dec w0, w0\n bra nz, 1b\nend: bra end");
  b.run(2 + 1 + 5000 * 3 - 1);
  EXPECT_EQ(b.cpu->pc(), b.symbol("end"));
  EXPECT_EQ(b.cpu->cpu().table().translated(), 1);
}

// a FIR loop as people write it: its first word reads through a modulo pointer, so the stretch that begins
// there must not take itself for that word's own function
TEST(Translation, a_loop_may_begin_with_a_modulo_pointer) {
  for (const bool translated : {false, true}) {
    CoreBench b(R"(__reset: mov #0x0900, w8
    mov #0x0900, w0
    mov w0, XMODSRT
    mov #0x0907, w0
    mov w0, XMODEND
    mov #0x80F8, w0
    mov w0, MODCON
    nop
    mov #0x8F08, w3
    clr w2
    mov #1000, w5
loop: mov [w8++], w1
    add w1, w2, w2
    dec w5, w5
    bra nz, loop
    clr MODCON
    mov #1000, w5
    mov #loop, w6
again: mov [w8], w1
    add w1, w2, w2
    dec w5, w5
    bra nz, again
end: bra end)",
                {}, translated);
    for (unsigned i = 0; i < 4; ++i) b.cpu->set_ram(0x900 + 2 * i, static_cast<std::uint8_t>(1 + i));
    b.run(100000);
    ASSERT_EQ(b.cpu->pc(), b.symbol("end"));
    EXPECT_EQ(b.w(2), 250u * 10 + 1000 * 1);
    EXPECT_EQ(b.w(8), 0x900u);
    EXPECT_EQ(b.cpu->cpu().table().translated() > 0, translated);
  }
}

// a stretch ends with a jump through a register that was a modulo pointer, and becomes one again: its word is
// decoded anew then, while the stretch stays
TEST(Translation, a_jump_through_a_pointer_that_changes_its_kind_goes_where_it_leads) {
  for (const bool translated : {false, true}) {
    CoreBench b(R"(__reset: mov #0x0900, w9
    mov #50, w10
    mov #0x80F8, w7
    clr w6
next: mov w7, MODCON
    nop
    mov #20, w5
loop: inc w1, w1
    inc w2, w2
    mov #handle(back), w8
    goto w8
    inc w3, w3
back: dec w5, w5
    bra nz, loop
    btg w7, #15
    dec w10, w10
    bra nz, next
end: bra end)",
                {}, translated);
    b.run(100000);
    ASSERT_EQ(b.cpu->pc(), b.symbol("end"));
    EXPECT_EQ(b.w(1), 1000u);
    EXPECT_EQ(b.w(2), 1000u);
    EXPECT_EQ(b.w(3), 0u);
    EXPECT_EQ(b.cpu->cpu().table().translated() > 0, translated);
  }
}

// TBLPAG and PSVPAG have eight bits, RCOUNT fourteen
TEST(Translation, what_handlers_save_keeps_the_bits_that_exist) {
  for (const bool translated : {false, true}) {
    CoreBench b(R"(__reset: mov #200, w10
1:  setm w0
    mov w0, TBLPAG
    mov w0, PSVPAG
    mov w0, RCOUNT
    push TBLPAG
    push PSVPAG
    push RCOUNT
    pop w3
    pop w2
    pop w1
    clr TBLPAG
    mov TBLPAG, w4
    dec w10, w10
    bra nz, 1b
end: bra end)",
                {}, translated);
    b.run_to("end");
    EXPECT_EQ(b.cpu->cpu().table().translated() > 0, translated);
    EXPECT_EQ(b.w(1), 0x00FF);
    EXPECT_EQ(b.w(2), 0x00FF);
    EXPECT_EQ(b.w(3), 0x3FFF);
    EXPECT_EQ(b.w(4), 0);
  }
}

// a routine runs translated, is written anew by the program, and runs as it is now
TEST(Translation, self_written_code_is_translated_anew) {
  CoreBench b(kFlashMacro + R"(__reset: clr w9
    mov #50, w10
1:  rcall routine
    add w9, w5, w9
    dec w10, w10
    bra nz, 1b
written: clr TBLPAG
    mov #routine, w1
    mov w1, NVMADR
    clr NVMADRU
    go 0x4041
    mov #0x0075, w2         ; mov #7, w5
    mov #0x0020, w3
    tblwtl w2, [w1]
    tblwth w3, [w1++]
    mov #0x0000, w2         ; return
    mov #0x06, w3
    tblwtl w2, [w1]
    tblwth w3, [w1]
    go 0x4001
    mov #50, w10
1:  rcall routine
    add w9, w5, w9
    dec w10, w10
    bra nz, 1b
end: bra end
    .section .routine, code, address(0x1000)
routine: mov #1, w5
    inc w4, w4
    inc w4, w4
    return)");
  b.run(400);
  EXPECT_GE(b.cpu->cpu().table().translated(), 2);  // the routine, and the loop around it
  b.run(100000);
  EXPECT_EQ(b.cpu->pc(), b.symbol("end"));
  EXPECT_EQ(b.w(4), 100u);
  EXPECT_EQ(b.w(9), 50u + 7 * 50u);
}

// a stretch has 48 words at most; where it ends the next one begins, with the stall that it meets there
TEST(Translation, goes_on_behind_a_long_stretch) {
  constexpr int kLines = 120, kRounds = 30;
  std::string text = "__reset: mov #30, w10\n1:\n";
  for (int i = 0; i < kLines; ++i) text += i % 2 ? "    mov [w4], w5\n" : "    mov #0x0A00, w4\n";
  text += "    inc w9, w9\n    dec w10, w10\n    bra nz, 1b\nend: bra end\n";  // two words count: no wait
  CoreBench plain(text, {}, false), translated(text, {}, true);
  constexpr Cycle kStart = 2 + 1, kEach = kLines + kLines / 2 + 2 + 2;  // every second line stalls
  for (CoreBench* b : {&plain, &translated}) {
    b->run(kStart + (kRounds - 1) * kEach);
    EXPECT_EQ(b->cpu->pc(), b->symbol("__reset") + 2);
    EXPECT_EQ(b->w(10), 1u);
  }
  EXPECT_GE(translated.cpu->cpu().table().translated(), 3);
}

}  // namespace
