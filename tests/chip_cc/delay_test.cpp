// SPDX-License-Identifier: MIT
// Loops by which programs wait: cycles a round beside XC16's. A round is what a thousand further rounds take.
#include <cmath>
#include <cstdio>
#include <string>

#include "tests/chip_cc/chip_program.h"

namespace chip_cc {
namespace {

// A round of XC16's at -O1 and -O0. Counted by hand in what its compiler makes of the loop (gcc 4.5.1 with
// the sources of XC16, as published); two of them are measured besides: delay_nop and delay_nested in
// xc16-cycles (505 and 714, 429 and 866 cycles) are the rows of n < m with a nop and of i and j here. M:
// rounds.
struct DelayRow {
  const char* code;  // void wait(T m), or with M
  const char* type;  // of m
  int optimised, plain;
  int least = 1000;  // rounds
};

const DelayRow kDelays[] = {
    {"int n; for (n = 0; n < M; n++);", "int", 3, 6},
    {"int n; for (n = M; n > 0; n--);", "int", 3, 5},
    {"unsigned n; for (n = 0; n < M; n++);", "unsigned", 3, 6},
    {"int n = M; while (n > 0) n--;", "int", 3, 5},
    {"int n; for (n = 0; n < m; n++);", "int", 4, 6},
    {"int n; for (n = 1; n != m; n++);", "int", 4, 6},
    {"int n; for (n = 0; n <= m; n++);", "int", 4, 6},
    {"int n; for (n = m; n < 5000; n++);", "int", -4, -6},
    {"while (m--);", "int", 4, 10},
    {"while (m--);", "unsigned", 4, 10},
    {"while (m--) asm(\"nop\");", "int", 4, 11},
    {"while (m > 0) m--;", "int", 3, 5},
    {"do ; while (--m);", "unsigned", 3, 5},
    {"int n; for (n = 0; n < m; n++) asm(\"nop\");", "int", 5, 7},
    {"unsigned n; for (n = m; n > 0; n--) asm(\"nop\");", "unsigned", 4, 6},
    {"int n; for (n = m; n >= 0; n--) { asm(\"nop\"); asm(\"nop\"); }", "int", 6, 7},
    {"long n; for (n = M; n > 0; n--);", "long", 4, 11},
    {"long n; for (n = 0; n < M; n++);", "long", 4, 12},
    {"long n; for (n = 0; n != m; n++);", "long", 6, 13},
    {"long n; for (n = 0; n < m; n++) asm(\"nop\");", "long", 7, 14},
    {"unsigned long n; for (n = 0; n <= m; n++);", "unsigned long", 6, 13},
    {"long n; for (n = m; n; n--) asm(\"nop\");", "long", 5, 12},
    {"long n; for (n = m; n >= 0; n--);", "long", 6, 11},
    {"while (m--);", "long", 6, 14},
    {"while (m--) asm(\"nop\");", "unsigned long", 5, 15},
    {"unsigned long n; for (n = M; n > 0; --n) { asm(\"nop\"); asm(\"nop\"); asm(\"nop\"); }",
     "unsigned long", 7, 14},
    {"unsigned i, j; for (i = 0; i < m; i++) for (j = 0; j < 25; j++) asm(\"nop\");", "unsigned", 105, 212,
     20},
    {"unsigned char n; for (n = 0; n < M; n++) asm(\"nop\");", "unsigned char", 4, 7, 100},
    {"while (m--);", "unsigned char", 4, 8, 100},
    {"volatile int n; for (n = 0; n < M; n++);", "int", 7, 8},
    {"volatile long n; for (n = 0; n < M; n++);", "long", 12, 14},
    {"limit = m; { int n; for (n = 0; n < limit; n++); }", "int", 4, 6},
    {"called(m);", "int", 5, 7},
};

/// All of them, each as a function of its own; M and m of all are `times` as many rounds.
std::string all_delays(int times) {
  std::string source =
      "int limit; int __attribute__((persistent)) which;\n"
      "static void called(int m) { int n; for (n = 0; n < m; n++) asm(\"nop\"); }\n"
      "void other(void) { called(3); called(4); }\n";
  std::string calls;
  int number = 0;
  for (const DelayRow& row : kDelays) {
    const std::string n = std::to_string(number++), rounds = std::to_string(row.least * times);
    source += "#undef M\n#define M " + rounds + "\n__attribute__((noinline)) void wait_" + n + "(" +
              row.type + " m) { " + row.code + " }\nvolatile " + row.type + " given_" + n + " = " + rounds +
              ";\n";
    calls += "case " + n + ": wait_" + n + "(given_" + n + "); break; ";
  }
  return source + "long bench_run(void) { switch (which) { " + calls + "} return 1; }\n";
}

/// Cycles a round.
double round_of(int number, const std::string& level) {
  double cycles[2];
  for (int more : {0, 1}) {
    // compiled once, from the cache then
    ChipProgram program("delays" + std::to_string(more), all_delays(1 + more), level);
    EXPECT_TRUE(program.is_whole()) << program.error();
    if (!program.is_whole()) return 0;
    program.poke(program.address_of("which"), std::uint64_t(number), 2);
    dspic::Cycle own = 0;
    program.run_counting("wait_" + std::to_string(number), own, true);
    cycles[more] = double(own);
  }
  return (cycles[1] - cycles[0]) / kDelays[number].least;
}

TEST(ChipDelays, a_round_takes_what_xc16_s_takes) {
  constexpr double kMostOptimised = 0.10, kMostPlain = 0.25;
  for (int number = 0; number < int(std::size(kDelays)); ++number)
    for (const bool optimised : {true, false}) {
      const DelayRow& row = kDelays[number];
      const double wanted = optimised ? row.optimised : row.plain;
      const double got = round_of(number, optimised ? "-O1" : "-O0");
      std::printf("%-90s %s %6.2f, XC16 %g\n", row.code, optimised ? "-O1" : "-O0", got, wanted);
      EXPECT_LE(std::abs(got / wanted - 1), optimised ? kMostOptimised : kMostPlain)
          << row.type << " m: " << row.code << (optimised ? " -O1" : " -O0");
    }
}

}  // namespace
}  // namespace chip_cc
