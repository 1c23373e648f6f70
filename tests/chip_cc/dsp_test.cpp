// SPDX-License-Identifier: MIT
// Accumulators of the DSP unit in C, and XC16's letters for operands of assembler text. Expected values by
// hand, from the manual's descriptions of the instructions.
#include <gtest/gtest.h>

#include "tests/chip_cc/chip_program.h"

namespace chip_cc {
namespace {

const char* const kLevels[] = {"-O0", "-O1", "-O2", "-Os"};

/// Every level gives the same.
void expect_runs(const std::string& source, std::uint32_t expected) {
  for (const char* level : kLevels) {
    ChipProgram program("dsp", source, level);
    ASSERT_TRUE(program.is_whole()) << level << ": " << program.error();
    EXPECT_EQ(program.run(), expected) << level;
  }
}

// factors are integers, and what is stored is not limited
const std::string kIntegers = R"(
#include <p30F6014A.h>
static void integers(void) { CORCONbits.IF = 1; CORCONbits.SATDW = 0; }
)";

TEST(ChipDsp, a_sum_of_products_fetches_while_it_multiplies) {
  const std::string source = kIntegers + R"(
int xs[4] __attribute__((space(xmemory))) = {1000, -2000, 3000, 5};
int ys[4] __attribute__((space(ymemory))) = {4, 5, 6, 1};
__attribute__((noinline)) int product(void) {
  register int sum asm("A");
  int x, y, n, *xp = xs, *yp = ys;
  sum = __builtin_clr_prefetch(&xp, &x, 2, &yp, &y, 2, 0, 0);
  for (n = 0; n < 4; n++) sum = __builtin_mac(sum, x, y, &xp, &x, 2, &yp, &y, 2, 0, 0);
  sum = __builtin_sftac(sum, -16);
  return __builtin_sac(sum, 0) + (xp - xs) * 10000;
}
long bench_run(void) { integers(); return product(); })";
  // 4000 - 10000 + 18000 + 5, and five words fetched of each
  expect_runs(source, static_cast<std::uint32_t>(std::int16_t(12005 + 50000)));
}

TEST(ChipDsp, accumulators_are_added_subtracted_shifted_and_rounded) {
  const std::string source = kIntegers + R"(
__attribute__((noinline)) long both(int a, int b, int by) {
  register int p asm("A"), q asm("B");
  p = __builtin_lac(a, 2);            /* 400 -> 100 */
  q = __builtin_lac(b, -1);           /*  30 ->  60 */
  p = __builtin_add(p, 800, 3);       /* 200 */
  p = __builtin_addab(p, q);          /* 260 */
  q = __builtin_subab(q, p);          /* -200 */
  q = __builtin_sftac(q, by);         /* -25 */
  return __builtin_sac(p, 1) * 1000L + __builtin_sac(q, 0);
}
__attribute__((noinline)) long rounded(int a) {
  register int p asm("B") = __builtin_lac(a, 0);
  return __builtin_sacr(p, 2) * 1000L + __builtin_sac(p, 2);
}
long bench_run(void) { integers(); return both(400, 30, 3) == 129975 ? rounded(7) : -1; })";
  expect_runs(source, 2001);  // 7 / 4 is rounded to 2 or cut to 1
}

TEST(ChipDsp, products_with_signs_and_squares) {
  const std::string source = kIntegers + R"(
__attribute__((noinline)) int low(int shift, int a, int b, int square) {
  register int s asm("B");
  s = __builtin_mpy(a, b, 0, 0, 0, 0, 0, 0);                  /* 35 */
  s = __builtin_msc(s, a, a, 0, 0, 0, 0, 0, 0, 0, 0);         /* 10 */
  s = __builtin_mac(s, square, square, 0, 0, 0, 0, 0, 0, 0, 0); /* 131 */
  s = __builtin_sftac(s, shift);
  return __builtin_sac(s, 0);
}
__attribute__((noinline)) int negative(int a, int b) {
  register int s asm("A");
  s = __builtin_mpyn(a, b, 0, 0, 0, 0, 0, 0);
  s = __builtin_sftac(s, -16);
  return __builtin_sac(s, 0);
}
long bench_run(void) { integers(); return low(-16, 5, 7, -11) * 100L - negative(4, 6); })";
  expect_runs(source, 13124);
}

TEST(ChipDsp, distances_and_what_is_written_back) {
  const std::string source = kIntegers + R"(
int a[3] __attribute__((space(xmemory))) = {10, 7, 1};
int b[3] __attribute__((space(ymemory))) = {3, 9, 2};
__attribute__((noinline)) long far(int **x, int **y) {
  register int s asm("A"), other asm("B");
  int d, back, back2, v;
  s = __builtin_ed(6, x, 2, y, -2, &d);       /* 36, d = 10 - 9 */
  s = __builtin_edac(s, d, x, 2, y, 0, &d);   /* 37, d = 7 - 3 */
  s = __builtin_edac(s, d, x, 0, y, 0, &d);   /* 53, d = 1 - 3 */
  other = __builtin_lac(d, 0);
  s = __builtin_mac(s, 1, 1, x, &v, -4, 0, 0, 0, &back, other); /* 54, v = 1, back = -2 */
  s = __builtin_sftac(s, -16);
  __builtin_movsac(0, 0, 0, y, &d, 4, &back2, s);  /* d = 3, back2 = 54 */
  return back2 * 1000L + v * 100 + d * 10 + back;
}
long bench_run(void) {
  int *x = a, *y = b + 1;
  long sum;
  integers();
  sum = far(&x, &y);
  return x == a && y == b + 2 ? sum : -1;
})";
  expect_runs(source, 54 * 1000 + 100 + 30 - 2);
}

TEST(ChipDsp, bits_are_found_by_one_instruction) {
  const std::string source = R"(
volatile int v = 0x0012, n = -3;
long bench_run(void) { return __builtin_ff1l(v) * 10000L + __builtin_ff1r(v) * 100 - __builtin_fbcl(n); })";
  expect_runs(source, 12 * 10000 + 2 * 100 + 13);
}

TEST(ChipDsp, a_loop_of_products_takes_two_instructions) {
  const char* source = R"(
int xs[64] __attribute__((space(xmemory))), ys[64] __attribute__((space(ymemory)));
__attribute__((noinline)) int product(void) {
  register int sum asm("A");
  int x, y, n, *xp = xs, *yp = ys;
  sum = __builtin_clr_prefetch(&xp, &x, 2, &yp, &y, 2, 0, 0);
  for (n = 0; n < 64; n++) sum = __builtin_mac(sum, x, y, &xp, &x, 2, &yp, &y, 2, 0, 0);
  return __builtin_sac(sum, 0);
}
long bench_run(void) { return product(); })";
  dspic::Cycle cycles = 0;
  ChipProgram program("loop", source, "-O1");
  ASSERT_TRUE(program.is_whole()) << program.error();
  program.run_counting("product", cycles);
  EXPECT_LT(cycles, 64 * 4 + 20);  // MAC, DEC, BRA taken: 4 a round
}

TEST(ChipDsp, mistakes_are_named) {
  struct Case {
    const char* body;
    std::string message;  // behind "main.c:3:"
  };
  const std::string like_a_number =
      " is used like a number; only built-in functions of the DSP unit take it, __builtin_sac() and "
      "__builtin_sacr() give its value";
  const Case cases[] = {
      {"register int s asm(\"A\"); s = __builtin_clr(); return s + 1;",
       "77: error: accumulator A" + like_a_number},
      {"register int s asm(\"B\"); s = 5; return __builtin_sac(s, 0);",
       "51: error: accumulator B" + like_a_number},
      {"register int s asm(\"A\"); s = __builtin_clr(); s = __builtin_sac(s, 0); return 0;",
       "72: error: accumulator A" + like_a_number},
      {"int s = __builtin_clr(); return s;",
       "32: error: __builtin_clr: the result is in an accumulator, so it belongs into one: register int x "
       "asm(\"A\")"},
      {"return __builtin_sac(4, 0);",
       "31: error: __builtin_sac: argument 1: expected a variable in an accumulator: register int x "
       "asm(\"A\")"},
      {"register int s asm(\"A\"); s = __builtin_lac(1, 9); return __builtin_sac(s, 0);",
       "53: error: __builtin_lac: argument 2: got 9, expected -8 to 7"},
      {"register int s asm(\"A\"); s = __builtin_lac(1, v); return __builtin_sac(s, 0);",
       "53: error: __builtin_lac: argument 2: expected a constant"},
      {"register int s asm(\"A\"), t asm(\"B\"); t = __builtin_clr(); s = __builtin_add(t, 1, 0); return "
       "__builtin_sac(s, 0);",
       "86: error: __builtin_add: reads accumulator B and writes A; the instruction has one"},
      {"register int s asm(\"A\"); int x, *p = &v; s = __builtin_clr_prefetch(&p, &x, 3, 0, 0, 0, 0, 0); "
       "return __builtin_sac(s, 0);",
       "69: error: __builtin_clr_prefetch: argument 3: got 3, expected -6 to 6, even"},
      {"register int s asm(\"A\"); int* p = &v; s = __builtin_clr_prefetch(&p, 0, 2, 0, 0, 0, 0, 0); return "
       "__builtin_sac(s, 0);",
       "66: error: __builtin_clr_prefetch: a value that is fetched has no place: got a null pointer"},
      {"register int s asm(\"A\"); int x; s = __builtin_clr_prefetch(0, 0, 0, 0, 0, 0, &x, s); return "
       "__builtin_sac(s, 0);",
       "60: error: __builtin_clr_prefetch: what is written back is the other accumulator"},
      {"register int s asm(\"A\"); s = __builtin_clr(); s = __builtin_addab(s, s); return __builtin_sac(s, "
       "0);",
       "74: error: __builtin_addab: both arguments are accumulator A"},
      {"int r; asm(\"add %1, %2, %0\" : \"=d\"(r) : \"r\"(1), \"P\"(32)); return r;",
       "76: error: value '32' out of range for constraint 'P'"},
      {"int r; asm(\"mov #1, %0\" : \"=w\"(r)); return r;",
       "50: error: invalid output constraint '=w' in asm"},
  };
  for (const Case& c : cases) {
    const ChipProgram program("wrong", std::string("int v;\nlong bench_run(void) { ") + c.body + " }\n");
    EXPECT_FALSE(program.is_whole()) << c.body;
    EXPECT_EQ(program.error(), "main.c:3:" + c.message + "\n") << c.body;
  }
}

TEST(ChipAssemblerText, letters_name_classes_of_registers) {
  // each text fails to assemble, or computes something else, where an operand lies elsewhere
  const std::string source = R"(
__attribute__((noinline)) int fetched(int *a, int *b) {
  int x, y;
  asm volatile("clr A, [%2], %0, [%3], %1" : "=z"(x), "=z"(y) : "x"(a), "y"(b) : "memory");
  return x * 100 + y;
}
__attribute__((noinline)) int squared(int a) {
  int r;
  asm volatile("mpy %1*%1, A\n\tsftac A, #-16\n\tsac A, %0" : "=v"(r) : "t"(a));
  return r;
}
__attribute__((noinline)) int fixed(int a, int b, int c) {
  int r;
  asm("add %1, %2, %0\n\tadd w0, w1, w3\n\tsub %0, w3, %0\n\tadd %0, %3, %0\n\tadd %4, %0" : "=&d"(r)
      : "a"(a), "b"(b), "c"(c), "J"(1000) : "w3");
  return r;
}
int x __attribute__((space(xmemory))) = 12, y __attribute__((space(ymemory))) = 34;
long bench_run(void) {
  *(volatile unsigned *)0x44 |= 1;  /* CORCON: factors are integers */
  return fetched(&x, &y) * 100000L + squared(-30) * 100L + fixed(5, 6, 9) - 1000;
})";
  expect_runs(source, 1234 * 100000 + 900 * 100 + 9);
}

}  // namespace
}  // namespace chip_cc
