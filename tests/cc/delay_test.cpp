// SPDX-License-Identifier: MIT
// Loops that only pass time, as firmware writes them: whatever the counter, the bound and the level, they
// take it, and the counter ends where it should.
#include <gtest/gtest.h>

#include "fake_host.h"

using namespace fake;

namespace {

struct Delay {
  const char* name;
  const char* text;    // file scope and main
  long long rounds;    // innermost rounds
  double least, most;  // cycles per round from -O1 on
  const char* console = "";
};

const Delay kDelays[] = {
    {"int", "int main(void) { int i; for (i = 0; i < 30000; i++); return 0; }", 30000, 3, 6},
    {"unsigned", "int main(void) { unsigned i; for (i = 0; i < 60000; i++) ; return 0; }", 60000, 3, 6},
    {"unsigned char", "int main(void) { unsigned char i; for (i = 0; i < 250; i++) {} return 0; }", 250, 3,
     7},
    {"long", "int main(void) { long t; for (t = 0; t < 100000; t++); return 0; }", 100000, 4, 7.5},
    {"unsigned long", "int main(void) { unsigned long t; for (t = 100000; t > 0; t--); return 0; }", 100000,
     4, 7.5},
    {"long nop", "int main(void) { long t; for (t = 0; t < 100000; t++) asm(\"nop\"); return 0; }", 100000, 5,
     8},
    {"three nops",
     "#define NOP() {__asm__ volatile (\"nop\");}\nint main(void) { int t; for (t = 0; t < 1000; t++) { "
     "NOP(); NOP(); NOP(); }"
     " return 0; }",
     1000, 6, 9},
    {"while down", "volatile unsigned v = 5000; int main(void) { unsigned n = v; while (n--); return 0; }",
     5000, 3, 6},
    {"while long down", "volatile long v = 50000; int main(void) { long n = v; while (n--) ; return 0; }",
     50000, 4, 8},
    {"do while", "volatile int v = 5000; int main(void) { int n = v; do { n--; } while (n); return 0; }",
     5000, 3, 6},
    {"variable bound",
     "volatile int v = 7000; int main(void) { int i, n = v; for (i = 0; i < n; i++); return 0; }", 7000, 3,
     6},
    {"variable long bound",
     "volatile long v = 70000; int main(void) { long i, n = v; for (i = 0; i < n; i++); return 0; }", 70000,
     4, 8},
    {"argument",
     "void wait(long n) { long i; for (i = 0; i < n; i++); }\nint main(void) { wait(3000); wait(4000); "
     "return 0; }",
     7000, 4, 8},
    {"static twice",
     "static void wait(unsigned int n) { unsigned int i; for (i = 0; i < n; i++) asm volatile(\"nop\"); }\n"
     "int main(void) { wait(3000); wait(4000); return 0; }",
     7000, 4, 7},
    {"constant twice",
     "void wait(void) { long i; for (i = 0; i < 5000; i++); }\nint main(void) { wait(); wait(); return 0; }",
     10000, 4, 8},
    {"nested constant",
     "int main(void) { int i, j; for (i = 0; i < 100; i++) for (j = 0; j < 200; j++); return 0; }", 20000, 3,
     6},
    {"nested long",
     "int main(void) { long i, j; for (i = 0; i < 100; i++) { for (j = 0; j < 200; j++) { } } return 0; }",
     20000, 4, 8},
    {"nested variable",
     "void wait(unsigned ms) { unsigned i, j; for (i = 0; i < ms; i++) for (j = 0; j < 800; j++); }\n"
     "int main(void) { wait(10); wait(15); return 0; }",
     20000, 3, 6},
    {"nested product",
     "volatile int a = 100, b = 150; int main(void) { int i, j, n = a, m = b; for (i = 0; i < n; i++) for (j "
     "= 0; j < m; j++);"
     " return 0; }",
     15000, 3, 6},
    {"triangle", "int main(void) { int i, j; for (i = 0; i < 200; i++) for (j = 0; j < i; j++); return 0; }",
     19900, 3, 7},
    {"while nested",
     "int main(void) { unsigned i = 100, j; while (i--) { j = 200; while (j--); } return 0; }", 20000, 3, 6},
    {"three deep",
     "int main(void) { int i, j, k; for (i = 0; i < 10; i++) for (j = 0; j < 20; j++) for (k = 0; k < 100; "
     "k++); return 0; }",
     20000, 3, 6},
    {"counter read",
     "#include <stdio.h>\nint main(void) { long t; for (t = 0; t < 100000; t += 2); printf(\"%ld\", t); "
     "return 0; }",
     50000, 4, 8, "100000"},
    {"counters read",
     "#include <stdio.h>\nvolatile int v = 50; int main(void) { int i, j, n = v; for (i = 0; i < n; i++) for "
     "(j = 0; j < 100; j++);"
     " printf(\"%d %d\", i, j); return 0; }",
     5000, 3, 7, "50 100"},
    {"global counter", "int t; int main(void) { for (t = 0; t < 5000; t++); return t != 5000; }", 5000, 3, 9},
    {"volatile long",
     "#include <stdio.h>\nint main(void) { volatile long i; for (i = 0; i < 5000; i++); printf(\"%ld\", i); "
     "return 0; }",
     5000, 6, 16, "5000"},
    {"volatile int",
     "#include <stdio.h>\nvoid wait(unsigned n) { volatile unsigned i; for (i = 0; i < n; i++); "
     "printf(\"%u\", i); }\n"
     "int main(void) { wait(5000); return 0; }",
     5000, 4, 12, "5000"},
    {"volatile down",
     "#include <stdio.h>\nint main(void) { volatile unsigned i = 5000; while (i--); printf(\"%u\", i); "
     "return 0; }",
     5000, 4, 12, "65535"},
    {"volatile twice",
     "int led; int main(void) { volatile long i; for (i = 0; i < 4000; i++); led = 1; for (i = 0; i < 1000; "
     "i++); return 0; }",
     5000, 9, 16},
    {"volatile nop",
     "void wait(long n) { volatile long i; for (i = 0; i < n; i++) asm(\"nop\"); }\nint main(void) { "
     "wait(5000); return 0; }",
     5000, 6, 16},
};

}  // namespace

TEST(delay, every_way_of_waiting_takes_its_time) {
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"})
    for (const Delay& d : kDelays) {
      auto run = run_c(d.text, level);
      double each = double(run.cycles) / double(d.rounds);
      bool plain = std::string(level) == "-O0";
      // printf and start-up are in the sum: a tenth of a round at these counts
      EXPECT_GE(each, d.least) << d.name << " " << level;
      EXPECT_LE(each, plain ? 20 : d.most * 1.15) << d.name << " " << level;
      EXPECT_EQ(run.console, d.console) << d.name << " " << level;
      EXPECT_EQ(run.end, "return") << d.name << " " << level;
    }
}

TEST(delay, a_volatile_counter_is_jumped_over_too) {
  for (const char* level : {"-O1", "-O2"}) {
    auto run = run_c(
        "#include <stdio.h>\nvoid wait(long n) { volatile long i; for (i = 0; i < n; i++); printf(\"%ld \", "
        "i); }\n"
        "int main(void) { volatile unsigned a, b; wait(700000); for (a = 0; a < 5; a++) for (b = 9000; b > "
        "0; b--) "
        "asm(\"nop\"); printf(\"%u %u\", a, b); return 0; }",
        level);
    EXPECT_EQ(run.console, "700000 5 0") << level;
    ASSERT_EQ(run.delays.size(), 6u) << level;
    EXPECT_EQ(run.delays[0].first, 700000) << level;
    EXPECT_GE(run.delays[0].second, 9) << level;
    EXPECT_EQ(run.delays[1].first, 9000) << level;
    EXPECT_GE(run.delays[1].second, 6) << level;
  }
}
