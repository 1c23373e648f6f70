// SPDX-License-Identifier: MIT
// Traps of programs in C: handlers that clear their flags by the header's names, and stacks that overflow.
#include "tests/chip_cc/chip_program.h"

#include "dspic30/core/cpu.h"

namespace chip_cc {
namespace {

constexpr const char* kTraps = R"(
#include <p30F6014A.h>
volatile int oscillator, address, stack, math, sum;
volatile int zero, odd = 0x1001, beyond = 0x2F00;
void __attribute__((interrupt, no_auto_psv)) _OscillatorFail(void) { ++oscillator; INTCON1bits.OSCFAIL = 0; }
void __attribute__((interrupt, no_auto_psv)) _AddressError(void) { ++address; INTCON1bits.ADDRERR = 0; }
void __attribute__((interrupt, no_auto_psv)) _StackError(void) { ++stack; SPLIM += 400; INTCON1bits.STKERR = 0; }
void __attribute__((interrupt, no_auto_psv)) _MathError(void) { ++math; _MATHERR = 0; }
__attribute__((noinline)) int deep(int n) {
  volatile int room[8];
  room[n & 7] = n;
  return n ? deep(n - 1) + room[n & 7] : 0;
}
long bench_run(void) {
  const unsigned limit = SPLIM;
  INTCON1bits.OSCFAIL = 1;
  sum += *(volatile int *)odd;
  sum += *(volatile int *)beyond;
  sum += 5 / zero;
  sum += 5u % (unsigned)zero;
  SPLIM = WREG15 + 16;
  sum += deep(4);
  SPLIM = limit;
  return oscillator | address << 4 | math << 8 | stack << 12;
}
)";

TEST(TrapProgram, each_handler_that_clears_its_flag_is_entered_once_a_trap) {
  for (const char* level : {"-O0", "-O1"}) {
    ChipProgram p("traps", kTraps, level);
    ASSERT_TRUE(p.is_whole()) << p.error();
    EXPECT_EQ(p.run(1'000'000), 0x1221u) << level;
    EXPECT_EQ(p.sfr("INTCON1"), 0u) << level;
  }
}

// LLVM takes a division by 0 for something that never happens
TEST(TrapProgram, a_division_by_zero_traps_whatever_the_optimiser_knows) {
  const char* source = R"(
#include <p30F6014A.h>
volatile int math, zero;
volatile unsigned long none;
volatile long sum;
void __attribute__((interrupt, no_auto_psv)) _MathError(void) { ++math; INTCON1bits.MATHERR = 0; }
static int over(int a, int b) { return a / b; }
long bench_run(void) {
  int z = 0;
  sum += 5 / zero;
  sum += 5 / z;
  sum += 7u % (unsigned)z;
  sum += over((int)sum, z);
  sum += (int)(5 % none);  // two divisions of 16 bits
  return math;
}
)";
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
    ChipProgram p("zero", source, level);
    ASSERT_TRUE(p.is_whole()) << p.error();
    EXPECT_EQ(p.run(1'000'000), 6u) << level;
  }
}

// LLVM takes what C leaves undefined for something that never happens; XC16 compiles it as written
TEST(TrapProgram, what_is_undefined_stops_the_program_there) {
  const struct {
    const char* source;
    bool is_illegal;  // an illegal opcode; else an address error
  } cases[] = {
      {"long bench_run(void) { int *p; *p = 5; told = 1; return 0; }", true},
      {"__attribute__((noinline)) static void store(void) { int *p; *p = 5; }\n"
       "long bench_run(void) { store(); told = 1; return 0; }",
       true},
      {"long bench_run(void) { void (*f)(void); f(); told = 1; return 0; }", true},
      {"long bench_run(void) { char *p = \"abc\"; p[1] = 'x'; told = p[1]; return 0; }", false},
      {"static const int five = 5;\nlong bench_run(void) { *(int *)&five = 6; told = five; return 0; }",
       false},
      {"static void put(char *p, char c) { *p = c; }\n"
       "long bench_run(void) { put(\"abc\", 'x'); told = 1; return 0; }",
       false}};
  for (const auto& c : cases)
    for (const char* level : {"-O1", "-O2", "-Os"}) {
      SCOPED_TRACE(std::string(level) + ": " + c.source);
      ChipProgram p(
          "undefined",
          "#include <p30F6014A.h>\nvolatile int told, wrong;\n"
          "void __attribute__((interrupt, no_auto_psv)) _AddressError(void) { wrong = 1; for (;;) ; }\n" +
              std::string(c.source) + "\n",
          level);
      ASSERT_TRUE(p.is_whole()) << p.error();
      const auto reset = p.run_to_reset(20'000);
      EXPECT_EQ(reset, c.is_illegal ? std::optional(dspic::ResetKind::IllegalOpcode) : std::nullopt);
      EXPECT_EQ(p.peek(p.address_of("told"), 2), 0u);
      EXPECT_EQ(p.peek(p.address_of("wrong"), 2), c.is_illegal ? 0u : 1u);
    }
}

/// Of `bytes` of locals: once, or without end.
std::string recursion(unsigned bytes, bool without_end) {
  return "#include <p30F6014A.h>\n"
         "volatile int told, stop = " +
         std::to_string(!without_end) +
         ";\n"
         "void __attribute__((interrupt, no_auto_psv)) _StackError(void) {\n"
         "  INTCON1bits.STKERR = 0; ++told; for (;;) ; }\n"
         "void __attribute__((interrupt, no_auto_psv)) _AddressError(void) { told = 99; for (;;) ; }\n"
         "__attribute__((noinline)) int over(int n) {\n"
         "  volatile char room[" +
         std::to_string(bytes) +
         "]; unsigned i;\n"
         "  for (i = 0; i < sizeof room; ++i) room[i] = n;\n"
         "  return stop ? 0 : over(n + 1) + room[n & 1]; }\n"
         "long bench_run(void) { return over(0); }\n";
}

TEST(TrapProgram, an_overflow_of_the_stack_runs_its_handler_whatever_the_frame) {
  for (const unsigned bytes : {2u, 30u, 200u, 1000u, 3500u}) {
    SCOPED_TRACE(bytes);
    ChipProgram p("overflow", recursion(bytes, true));
    ASSERT_TRUE(p.is_whole()) << p.error();
    p.run_until("told");
    p.run_for(1000);
    EXPECT_EQ(p.peek(p.address_of("told"), 2), 1u);
    const unsigned end = p.sfr("SPLIM") + 2;
    EXPECT_LE(end + std::max(16u, bytes), dspic::Processor::kRamEnd);
    EXPECT_LE(p.processor().w(15), dspic::Processor::kRamEnd);
    // by whom
    const auto& trap = p.processor().cpu().latest_trap;
    ASSERT_TRUE(trap);
    EXPECT_EQ(trap->trap, dspic::Trap::StackError);
    const dspic::CodeMap::Function* const function = p.file().code.function_at(trap->pc);
    ASSERT_NE(function, nullptr);
    EXPECT_EQ(function->name, "over");
  }
}

TEST(TrapProgram, a_frame_that_fits_is_not_stopped_for_the_guard) {
  for (const unsigned bytes : {4000u, 7000u, 7800u}) {
    SCOPED_TRACE(bytes);
    ChipProgram p("fits", recursion(bytes, false));
    ASSERT_TRUE(p.is_whole()) << p.error();
    p.run();
    EXPECT_EQ(p.peek(p.address_of("told"), 2), 0u);
  }
}

}  // namespace
}  // namespace chip_cc
