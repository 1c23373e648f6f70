// SPDX-License-Identifier: MIT
// Translated code against the interpreter: random programs, programs that write themselves, and what earlier
// runs left.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "dspic30/core/cpu.h"
#include "dspic30/core/instruction_table.h"
#include "dspic30/core/known_calls.h"
#include "dspic30/translate/stretch.h"
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
using bench::kFlashMacro;
using dspic::Insn;
using dspic::Operand;

struct Draw {
  std::uint32_t state;
  unsigned operator()(unsigned below) {
    state = state * 1664525u + 1013904223u;
    return static_cast<unsigned>((std::uint64_t{state} * below) >> 32);
  }
};

// W registers point into RAM, a timer interrupts, then comes the body. After a trap all that is set up anew,
// and the body is entered somewhere
constexpr const char* kFrame = R"(
__reset:
    mov #0x2700, w0
    mov w0, SPLIM
    nop
    mov #151, w0
    mov w0, PR1
    mov #0x8000, w0
    mov w0, T1CON
    bset IEC0, #T1IE
__AddressError:
__StackError:
__MathError:
    mov #0x1F00, w15
    clr INTCON1
    mov TMR1, w0
    and w0, #15, w0
    sl w0, w0
    mov #lo16(body), w1
    add w0, w1, w0
    push w0
    clr w0
    push w0
    mov #0x0900, w0
    mov #0x0A00, w1
    mov #0x0B04, w2
    mov #3, w3
    mov #0x0C00, w4
    mov #0x1800, w5
    mov #0xFFF0, w6
    mov #0x0D01, w7
    mov #0x0E00, w8
    mov #0x0F00, w9
    mov #0x1900, w10
    mov #0x1A00, w11
    mov #2, w12
    mov #0x1B00, w13
    mov #0x1C00, w14
    retfie
__T1Interrupt:
    push w0
    bclr IFS0, #T1IF
    mov 0x0910, w0
    inc w0, w0
    mov w0, 0x0910
    pop w0
    retfie
body:
)";
constexpr unsigned kBodyWords = 24;

// the window is open, on a page that differs from time to time, the EEPROM's among them, and some registers
// point into it
std::string with_constants(std::string frame) {
  frame.insert(frame.find("    retfie"), R"(    mov #0x24, w8
    mov w8, CORCON
    mov TMR1, w9
    and w9, #3, w9
    cp w9, #3
    bra nz, 1f
    mov #0xFF, w9
1:  mov w9, PSVPAG
    mov #0x8E00, w8
    mov #0x9F01, w9
    mov #0xFFFE, w11
)");
  return frame;
}

bool has(const dspic::Row& row, Operand kind) {
  return std::find(row.kinds.begin(), row.kinds.end(), kind) != row.kinds.end();
}

// an instruction at a word of the body: any row, any operands, but jumps stay in the body or in these words
// of it, mostly, and few things end it
std::uint32_t any_instruction(Draw& draw, unsigned at, unsigned first = 0, unsigned words = kBodyWords) {
  const auto& rows = dspic::instruction_rows();
  while (true) {
    const dspic::Row& row = rows[draw(static_cast<unsigned>(rows.size()))];
    if (row.words == 2 || row.id == Insn::Reset || row.id == Insn::Pwrsav_lit1) continue;
    dspic::Fields f;
    for (const dspic::Field& field : row.fields)
      f.*field.member = draw(dspic::field_limit(row, field.member) + 1);
    if (has(row, Operand::Branch)) {
      if (row.id == Insn::Rcall_Expr && draw(8)) continue;
      f.n = (first + draw(words) - at - 1) & 0xFFFF;
    }
    if (row.id == Insn::Repeat_lit14) f.k = draw(20);
    const bool jumps = row.id == Insn::Bra_Wn || row.id == Insn::Goto_Wn || row.id == Insn::Call_Wn ||
                       row.id == Insn::Rcall_Wn || row.id == Insn::Return || row.id == Insn::Retfie ||
                       row.id == Insn::Retlw_lit10_Wn;
    if (jumps && draw(30)) continue;
    // pointers point, and keep to RAM, mostly, and addresses are those of RAM
    if (has(row, Operand::File) && draw(8)) f.f = 0x900 + draw(0x100);
    if (has(row, Operand::FileWord)) f.f = draw(8) ? (0x900 + draw(0x100)) / 2 : f.f;
    if ((has(row, Operand::File) || has(row, Operand::FileWord)) && !draw(12))  // what handlers save
      f.f = (0x32 + 2 * draw(3)) / (has(row, Operand::FileWord) ? 2 : 1);
    if (has(row, Operand::FileBit) && draw(3)) f.f = 0x900 + draw(0x100);
    static constexpr unsigned kPointers[] = {1, 2, 4, 5, 8, 9, 10, 11, 13, 14}, kValues[] = {0, 3, 6, 7};
    if (row.id != Insn::Mov_D_Ws_Wnd && row.id != Insn::Mov_D_Wns_Wd && draw(16)) {
      if (f.p | f.g) f.s = kPointers[draw(10)];
      f.d = f.q | f.h ? kPointers[draw(10)] : kValues[draw(4)];
    }
    if (row.legal && !row.legal(f)) continue;
    const std::uint32_t word = dspic::encode(row, f);
    if (dspic::find_row(word) == &row) return word;
  }
}

// small functions behind the body, and ways to them; the body calls them, and they call those before them
constexpr unsigned kFunctions = 5, kFunctionWords = 7, kWaysStart = kBodyWords + kFunctions * kFunctionWords;

std::uint32_t rcall(unsigned at, unsigned to) { return 0x070000 | ((to - at - 1) & 0xFFFF); }
void put_pair(std::vector<std::uint32_t>& words, unsigned at, std::uint32_t first, unsigned address) {
  words[at] = first | (address & 0xFFFF);
  words[at + 1] = address >> 16;
}
void put_call(Draw& draw, std::vector<std::uint32_t>& words, unsigned at, unsigned last, unsigned body,
              unsigned functions) {
  const unsigned which = draw(functions), function = kBodyWords + which * kFunctionWords;
  const unsigned how = draw(3);
  if (how == 1 && at + 1 < last)
    put_pair(words, at, 0x020000, body + 2 * function);
  else
    words[at] = rcall(at, how == 2 ? kWaysStart + 2 * which : function);
}
std::vector<std::uint32_t> with_functions(Draw& draw, unsigned body) {
  std::vector<std::uint32_t> words(kWaysStart + 2 * kFunctions);
  for (unsigned i = 0; i + 1 < kBodyWords; ++i) words[i] = any_instruction(draw, i);
  words[kBodyWords - 1] = 0x370000 | ((0 - kBodyWords) & 0xFFFF);
  for (unsigned f = 0; f < kFunctions; ++f) {
    const unsigned first = kBodyWords + f * kFunctionWords, last = first + kFunctionWords - 1;
    for (unsigned i = first; i < last; ++i) words[i] = any_instruction(draw, i, first, kFunctionWords);
    words[last] = draw(4) ? 0x060000 : 0x050000 | draw(0x400) << 4 | draw(4);  // RETURN, RETLW
    if (f > 0) put_call(draw, words, first + draw(kFunctionWords - 1), last, body, f);
    put_pair(words, kWaysStart + 2 * f, 0x040000, body + 2 * first);
  }
  for (unsigned i = draw(4); i + 1 < kBodyWords; i += 2 + draw(6))
    put_call(draw, words, i, kBodyWords - 1, body, kFunctions);
  return words;
}

enum class Programs { Any, PointersChange, ReadConstants, CallFunctions };

// number of places where translated code began. PointersChange: now and then other registers are modulo and
// bit-reversed pointers
int compare(std::uint32_t seed, Programs kind = Programs::Any) {
  Draw draw{seed};
  const std::string frame = kind == Programs::ReadConstants ? with_constants(kFrame) : kFrame;
  CoreBench one(frame, {}, false), other(frame, {}, true);
  const unsigned body = one.symbol("body");
  std::vector<std::uint32_t> words;
  if (kind == Programs::CallFunctions) {
    words = with_functions(draw, body);
  } else {
    for (unsigned i = 0; i + 1 < kBodyWords; ++i) words.push_back(any_instruction(draw, i));
    words.push_back(0x370000 | ((0 - kBodyWords) & 0xFFFF));
  }
  for (unsigned i = 0; i < words.size(); ++i)
    for (CoreBench* b : {&one, &other}) b->program.write(body + 2 * i, words[i]);
  for (CoreBench* b : {&one, &other}) b->cpu->restart();
  for (Cycle end = 0; end < 12000; end += 1 + draw(draw(4) ? 700 : 5)) {
    if (kind == Programs::PointersChange && draw(6) == 0) {
      const unsigned modcon = draw(0x10000), xbrev = draw(2) << 15 | 1u << draw(6);
      for (CoreBench* b : {&one, &other}) {
        b->chip->write(bench::Bench::at("MODCON"), static_cast<std::uint16_t>(modcon), 16, b->cpu->now());
        b->chip->write(bench::Bench::at("XBREV"), static_cast<std::uint16_t>(xbrev), 16, b->cpu->now());
        b->chip->write(bench::Bench::at("XMODSRT"), 0x900, 16, b->cpu->now());
        b->chip->write(bench::Bench::at("XMODEND"), 0x91F, 16, b->cpu->now());
        b->chip->write(bench::Bench::at("YMODSRT"), 0x1900, 16, b->cpu->now());
        b->chip->write(bench::Bench::at("YMODEND"), 0x191F, 16, b->cpu->now());
      }
    }
    one.run(end);
    other.run(end);
    SCOPED_TRACE("seed " + std::to_string(seed) + " at " + std::to_string(end));
    EXPECT_EQ(one.cpu->now(), other.cpu->now());
    EXPECT_EQ(one.cpu->pc(), other.cpu->pc());
    for (int n = 0; n < 16; ++n) EXPECT_EQ(one.w(n), other.w(n)) << "W" << n;
    EXPECT_EQ(one.cpu->state_hash(), other.cpu->state_hash());
    if (testing::Test::HasFailure()) return 0;
  }
  EXPECT_EQ(one.chip->state_hash(one.cpu->now()), other.chip->state_hash(other.cpu->now()))
      << "seed " << seed;
  EXPECT_EQ(one.resets, other.resets);
  EXPECT_EQ(one.notes.all.size(), other.notes.all.size());
  return other.cpu->translated();
}

unsigned programs(unsigned usual) {
  const char* const wanted = std::getenv("TWINPUCK_TRANSLATION_PROGRAMS");  // more than a test's time allows
  return wanted ? static_cast<unsigned>(std::atoi(wanted)) : usual;
}

TEST(Translation, random_programs_run_alike) {
  int translated = 0;
  for (std::uint32_t seed = 1; seed <= programs(60) && !HasFailure(); ++seed) translated += compare(seed);
  EXPECT_GT(translated, 60);
}

TEST(Translation, random_programs_run_alike_while_pointers_change) {
  int translated = 0;
  for (std::uint32_t seed = 1001; seed <= 1000 + programs(40) && !HasFailure(); ++seed)
    translated += compare(seed, Programs::PointersChange);
  EXPECT_GT(translated, 40);
}

TEST(Translation, random_programs_run_alike_while_they_read_constants) {
  int translated = 0;
  for (std::uint32_t seed = 2001; seed <= 2000 + programs(40) && !HasFailure(); ++seed)
    translated += compare(seed, Programs::ReadConstants);
  EXPECT_GT(translated, 40);
}

TEST(Translation, random_programs_run_alike_while_they_call_functions) {
  int translated = 0;
  for (std::uint32_t seed = 3001; seed <= 3000 + programs(60) && !HasFailure(); ++seed)
    translated += compare(seed, Programs::CallFunctions);
  EXPECT_GT(translated, 60);
}

// one more cycle for a MOV, two for what computes; words of a page that is not the first, bytes of both
// halves
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
    EXPECT_EQ(b.cpu->translated() > 0, translated);
  }
}

// --- functions that are called -----------------------------------------------------------------------------

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
    EXPECT_EQ(b.cpu->translated() > 0, translated);
    EXPECT_EQ(b.w(1), 100u);
    EXPECT_EQ(b.w(2), 50u);
    EXPECT_EQ(b.w(3), 100u);
    EXPECT_EQ(b.w(15), 0x0810u + 4 + 4);  // RCALL's two words, then the trap's
  }
}

// --- functions of the host --------------------------------------------------------------------------------

/// Function 0 looks: W0 becomes the time in 64s, in 20 cycles, and stays so. Function 1 changes something: W0
/// and W1 are added up at 0x0900, and each seventh time the outlook is another. Function 2 waits until a
/// thousand's multiple.
struct Host final : dspic::HostCalls {
  std::vector<Cycle> calls;
  dspic::HostResult call(dspic::Cpu& cpu, unsigned index, Cycle at, bool again) override {
    if (!again) calls.push_back(at);
    if (index == 0) {
      cpu.w[0] = static_cast<std::uint16_t>(at >> 6);
      cpu.note_look((at >> 6) + 1 << 6);
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
  std::uint16_t read(unsigned, Cycle) override { return 0; }
  void write(unsigned, std::uint16_t, std::uint16_t, Cycle) override {}
  Cycle horizon(unsigned, Cycle) override { return dspic::kNever; }
  std::uint16_t peek(unsigned, Cycle) const override { return 0; }
  Cycle due() const override { return dspic::kNever; }
  std::uint64_t share_q32() const override { return calls.size() % 3 << 28; }
  void begin_handler(Cycle) override {}
  dspic::HandlerStep next_in_handler(Cycle) override { return {}; }
  void end_handler(Cycle) override {}
  int vector(int) const override { return dspic::kNoVector; }
  int priority() const override { return 4; }
  void hold_handler(int, bool, Cycle) override {}
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

// --- routines that are known by heart ----------------------------------------------------------------------

// W2 where W1 is odd, else W1; but where W1 is a multiple of 16 it is not known
dspic::KnownAnswer choice_of(std::uint64_t w0_to_w3) {
  const auto w1 = static_cast<std::uint16_t>(w0_to_w3 >> 16), w2 = static_cast<std::uint16_t>(w0_to_w3 >> 32);
  if (w1 % 16 == 0) return {};
  return {(w0_to_w3 & ~std::uint64_t{0xFFFF}) | (w1 & 1 ? w2 : w1), 6};
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
    clr w4
    clr w5
    clr w6
    clr w7
    clr w8
    clr w9
    clr w10
loop: mov w8, w2
    mov w9, w1
    call choice
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
    return)";
  const dspic::KnownRoutine routine{"_choice", 1, &choice_of, nullptr};
  Onlooker onlooker;
  CoreBench runs(text, {}, false), answers(text, {}, false), translated(text, {}, false);
  for (CoreBench* b : {&answers, &translated}) {
    auto calls = std::make_shared<dspic::KnownCalls>();
    calls->add(b->symbol("choice"), routine);
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
  EXPECT_GE(std::count_if(items.begin(), items.end(), [](const auto& item) { return item.routine; }), 2);
}

// two words that go round are worth it
TEST(Translation, short_loops_are_translated) {
  CoreBench b("__reset: mov #5000, w0\n1: dec w0, w0\n bra nz, 1b\nend: bra end");
  b.run(2 + 1 + 5000 * 3 - 1);
  EXPECT_EQ(b.cpu->pc(), b.symbol("end"));
  EXPECT_EQ(b.cpu->translated(), 1);
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
    EXPECT_EQ(b.cpu->translated() > 0, translated);
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
    EXPECT_EQ(b.cpu->translated() > 0, translated);
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
    EXPECT_EQ(b.cpu->translated() > 0, translated);
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
  EXPECT_GE(b.cpu->translated(), 2);  // the routine, and the loop around it
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
  EXPECT_GE(translated.cpu->translated(), 3);
}

// --- what earlier runs left -----------------------------------------------------------------------------

namespace fs = std::filesystem;

struct KeptTranslations : testing::Test {
  const fs::path folder = fs::temp_directory_path() / ("twinpuck_kept_" + std::to_string(getpid()));
  ~KeptTranslations() override { fs::remove_all(folder); }
  /// A run of its own; returns how much it compiled.
  int run(const fs::path& where) {
    dspic::translate::Translations translations(chip::translator_library(), where);
    CoreBench b(R"(__reset: mov #300, w10
1:  rcall routine
    dec w10, w10
    bra nz, 1b
end: bra end
routine: mov #0x0A00, w1
    inc [w1], [w1]
    add w4, #3, w4
    btsc w4, #0
    inc w5, w5
    return)",
                {}, false);
    b.cpu->set_translator(&translations);
    b.cpu->translate_all();
    EXPECT_TRUE(b.run_to("end"));
    EXPECT_GE(b.cpu->translated(), 1);
    EXPECT_EQ(b.word(0x0A00), 300u);
    EXPECT_EQ(b.w(4), 900u);
    EXPECT_EQ(b.w(5), 150u);
    return translations.compiled();
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) all.push_back(entry.path());
    return all;
  }
};

TEST_F(KeptTranslations, serve_the_next_run) {
  const int compiled = run(folder);
  EXPECT_GE(compiled, 1);
  EXPECT_EQ(files().size(), static_cast<std::size_t>(compiled));
  EXPECT_EQ(run(folder), 0);
}

TEST_F(KeptTranslations, are_made_anew_when_spoilt) {
  const int compiled = run(folder);
  for (const bool cut : {true, false}) {
    for (const fs::path& file : files()) {
      const auto size = fs::file_size(file);
      if (cut) {
        fs::resize_file(file, size / 2);
      } else {
        std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
        out.seekg(static_cast<std::streamoff>(size / 2));
        const char one = static_cast<char>(out.get() ^ 1);
        out.seekp(static_cast<std::streamoff>(size / 2));
        out.put(one);
      }
    }
    EXPECT_EQ(run(folder), compiled) << "cut " << cut;
    EXPECT_EQ(run(folder), 0);
  }
}

TEST_F(KeptTranslations, of_another_translator_are_removed) {
  run(folder);
  const fs::path old = folder / "0123456789abcdef";
  fs::create_directories(old);
  std::ofstream(old / "0000000000000000") << "of an older translator";
  EXPECT_EQ(run(folder), 0);
  EXPECT_FALSE(fs::exists(old));
}

TEST_F(KeptTranslations, are_not_kept_where_no_folder_can_be) {
  std::ofstream(folder) << "a file";
  EXPECT_GE(run(folder), 1);
  EXPECT_GE(run(folder), 1);
  EXPECT_GE(run({}), 1);
}

}  // namespace
