// SPDX-License-Identifier: MIT
// Translated code against the interpreter: random programs.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dspic30/core/instruction_table.h"
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
using bench::Draw;
using dspic::Insn;
using dspic::Operand;

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

// number of places where translated code began. PointersChange: now and then other registers are modulo
// and bit-reversed pointers
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
  return other.cpu->cpu().table().translated();
}

unsigned programs(unsigned usual) {
  const char* const wanted = std::getenv("TWINPUCK_TRANSLATION_PROGRAMS");  // more than a test's time allows
  return wanted ? static_cast<unsigned>(std::atoi(wanted)) : usual;
}

TEST(TranslationOfRandomPrograms, run_alike) {
  int translated = 0;
  for (std::uint32_t seed = 1; seed <= programs(60) && !HasFailure(); ++seed) translated += compare(seed);
  EXPECT_GT(translated, 60);
}

TEST(TranslationOfRandomPrograms, run_alike_while_pointers_change) {
  int translated = 0;
  for (std::uint32_t seed = 1001; seed <= 1000 + programs(40) && !HasFailure(); ++seed)
    translated += compare(seed, Programs::PointersChange);
  EXPECT_GT(translated, 40);
}

TEST(TranslationOfRandomPrograms, run_alike_while_they_read_constants) {
  int translated = 0;
  for (std::uint32_t seed = 2001; seed <= 2000 + programs(40) && !HasFailure(); ++seed)
    translated += compare(seed, Programs::ReadConstants);
  EXPECT_GT(translated, 40);
}

TEST(TranslationOfRandomPrograms, run_alike_while_they_call_functions) {
  int translated = 0;
  for (std::uint32_t seed = 3001; seed <= 3000 + programs(60) && !HasFailure(); ++seed)
    translated += compare(seed, Programs::CallFunctions);
  EXPECT_GT(translated, 60);
}

}  // namespace
