// SPDX-License-Identifier: MIT
// Time: budget, polling loops, delay loops, registers, assembler, divisions by zero.
#include <gtest/gtest.h>

#include "fake_host.h"
#include "hal_sim/cc/cost_params.h"

using namespace fake;

TEST(time, endless_empty_loop_polls_each_round) {
  auto run = run_c("int main(void) { while (1); }", "-O1", 5);
  EXPECT_EQ(run.end, "poll");
  EXPECT_EQ(run.polls, 5);
}

TEST(time, polled_flag_without_volatile_is_read_each_round) {
  for (const char* level : {"-O0", "-O1", "-O2"}) {
    Folder folder;
    auto built = build(folder,
                       "static int flag; void _T1Interrupt(void) { flag = 1; }\n"
                       "int main(void) { while (!flag); return 0; }",
                       level);
    ASSERT_TRUE(built.ok) << text_of(built);
    Image image(folder.path / "prog.so");
    ASSERT_EQ(image.error, "");
    auto run = image.run(10, [&](int n) {
      if (n == 3) image->vectors[3]();
    });
    EXPECT_EQ(run.end, "return") << level;
    EXPECT_EQ(run.polls, 3) << level;
  }
}

TEST(time, a_loop_that_counts_or_stores_is_not_idle) {
  auto run =
      run_c("volatile int flag; int n; int main(void) { while (!flag) { n++; if (n == 100) return 0; } }");
  EXPECT_EQ(run.end, "return");
  EXPECT_EQ(run.polls, 0);
}

TEST(time, storing_the_same_value_again_changes_nothing) {
  auto run =
      run_c("volatile int flag; int seen; int main(void) { while (1) { seen = flag; if (seen) return 1; } }",
            "-O1", 3);
  EXPECT_EQ(run.end, "poll");
}

TEST(time, poll_safe_functions_may_stand_in_a_waiting_loop) {
  auto run = run_c(
      "volatile int flag; static int ready(int what) { int local[3]; local[what & 1] = flag; return local[0] "
      "+ what; }\n"
      "int main(void) { while (!ready(0)); return 0; }",
      "-O0", 2);
  EXPECT_EQ(run.end, "poll");
}

TEST(time, counted_delay_becomes_one_call) {
  auto run = run_c("int main(void) { long i; for (i = 0; i < 100000; i++) asm(\"nop\"); return 0; }");
  ASSERT_EQ(run.delays.size(), 1u);
  EXPECT_EQ(run.delays[0].first, 100000);
  EXPECT_GE(run.delays[0].second, 3);
  EXPECT_LE(run.delays[0].second, 9);
}

TEST(time, empty_delay_leaves_the_final_counter) {
  auto run = run_c(
      "#include <stdio.h>\nint main(void) { unsigned int i, n = 4000; volatile unsigned int m = 300;\n"
      "  { unsigned int end = m; for (i = 0; i < end; i++); } printf(\"%u \", i); while (n--); "
      "printf(\"%u\", n); return 0; }");
  EXPECT_EQ(run.console, "300 65535");
  ASSERT_EQ(run.delays.size(), 2u);
  EXPECT_EQ(run.delays[0].first, 300);
  EXPECT_EQ(run.delays[1].first, 4000);
}

TEST(time, delay_is_kept_at_every_level) {
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
    auto run = run_c(
        "int main(void) { int i, j; for (i = 0; i < 10; i++) for (j = 0; j < 1000; j++); return 0; }", level);
    EXPECT_GT(run.cycles, 20000) << level;
    EXPECT_LT(run.cycles, 300000) << level;
  }
}

TEST(time, budget_is_charged_in_small_parts) {
  // straight code: one block, thousands of cycles; the host must get control on the way, at most one library
  // routine (a float division is the longest here) late
  const double one_call[] = {cc::kFloatDiv, 0, cc::kLongDivide};
  const char* steps[] = {"x = x * 1.5f + y / x;", "n = n * 3 + m; m = m ^ (n >> 2);",
                         "l = l / (n | 1) + l % 7;"};
  for (const char* level : {"-O0", "-O1", "-O2"})
    for (int kind = 0; kind < 3; ++kind) {
      std::string body;
      for (int i = 0; i < 60; ++i) body += steps[kind];
      Folder folder;
      auto built = build(folder,
                         "volatile float in = 2; volatile int num = 77; volatile long big = 123456789; float "
                         "out; long sum;\n"
                         "int main(void) { float x = in, y = in; int n = num, m = num; long l = big; " +
                             body + " out = x; sum = l + n + m; return 0; }",
                         level);
      ASSERT_TRUE(built.ok) << text_of(built);
      Image image(folder.path / "prog.so");
      event_interval = 1;
      auto run = image.run();
      event_interval = 0;
      EXPECT_EQ(run.end, "return");
      EXPECT_GT(run.cycles, 60 * 4) << level << " " << kind;
      EXPECT_LE(double(run.latest), 150 + one_call[kind]) << level << " " << kind;
      EXPECT_GE(run.events * (150 + one_call[kind]), double(run.cycles)) << level << " " << kind;
    }
}

TEST(time, division_by_zero_traps_whatever_the_optimiser_knows) {
  for (const char* level : {"-O0", "-O1", "-O2"}) {
    EXPECT_EQ(run_c("volatile int z; int main(void) { return 5 / z; }", level).end, "trap 1") << level;
    EXPECT_EQ(run_c("int main(void) { int z = 0; int r = 5 / z; return r; }", level).end, "trap 1") << level;
    EXPECT_EQ(run_c("volatile unsigned long z; int main(void) { return (int)(5 % z); }", level).end, "trap 1")
        << level;
  }
}

TEST(time, register_accesses_go_to_the_register_host) {
  const char* text =
      "extern volatile unsigned int LATA __asm__(\"tp_sfr_02C2\");\n"
      "typedef struct { unsigned LATA0:1; unsigned LATA1:1; unsigned :13; unsigned LATA15:1; } LATABITS;\n"
      "extern volatile LATABITS LATAbits __asm__(\"tp_sfr_02C2\");\n"
      "int main(void) { LATA = 0x1230; LATAbits.LATA1 = 1; LATAbits.LATA15 ^= 1; return LATAbits.LATA0; }";
  for (const char* level : {"-O0", "-O1", "-O2"}) {
    registers[0x2c2] = 0;
    auto run = run_c(text, level);
    EXPECT_EQ(registers[0x2c2], 0x9232) << level;
    EXPECT_EQ(run.accesses.front().address, 0x2c2);
    EXPECT_EQ(run.accesses.front().value, 0x1230);
    for (const auto& a : run.accesses) EXPECT_EQ(a.bits, 16);
  }
}

TEST(time, an_endless_loop_rests_if_nothing_stands_in_it) {
  for (const char* level : {"-O1", "-O2"}) {
    EXPECT_EQ(run_c("int main(void) { while (1); }", level, 3).rests, 3) << level;
    EXPECT_EQ(run_c("int main(void) { for (;;) asm(\"nop\"); }", level, 3).rests, 3) << level;
    auto asking = run_c("volatile int stop; int main(void) { while (!stop); return 0; }", level, 3);
    EXPECT_EQ(asking.polls, 3) << level;
    EXPECT_EQ(asking.rests, 0) << level;
    EXPECT_EQ(run_c("volatile int seen; int main(void) { while (1) seen; }", level, 3).rests, 0) << level;
  }
}

TEST(time, a_change_of_a_register_is_one_call_and_the_same_two_accesses) {
  const std::string head =
      "extern volatile unsigned int LATD __asm__(\"tp_sfr_02D6\"), IFS0 __asm__(\"tp_sfr_0084\");\n"
      "typedef struct { unsigned a:3; unsigned b:1; unsigned :12; } BITS;\n"
      "extern volatile BITS IFS0bits __asm__(\"tp_sfr_0084\");\n"
      "unsigned char phase = 0xA; unsigned word = 0x0F0F, seen;\n";
  struct Case {
    const char* text;
    long long before, after;  // of LATD
    int calls;
  };
  const Case cases[] = {{"LATD &= 0xFF00;", 0x1234, 0x1200, 1},
                        {"LATD |= 0x00F1;", 0x1234, 0x12F5, 1},
                        {"LATD ^= 0xFFFF;", 0x1234, 0xEDCB, 1},
                        {"LATD = (LATD & 0xFFF0) | phase;", 0x1234, 0x123A, 1},
                        {"LATD = (LATD & ~word) | (word & 0x3333);", 0x1234, 0x1333, 1},
                        {"LATD = ((LATD | word) ^ 0x8001) & 0x8FFF;", 0x1234, 0x8F3E, 1},
                        // sums are no such change; nor is a value that is used again, or written elsewhere
                        {"LATD += 1;", 0x1234, 0x1235, 0},
                        {"LATD = seen = LATD & 0x00FF;", 0x1234, 0x0034, 0},
                        {"LATD = IFS0 & 0xFFF0;", 0x1234, 0x5670, 0}};
  for (const Case& c : cases) {
    registers[0x2d6] = static_cast<uint16_t>(c.before);
    registers[0x84] = 0x5678;
    auto run = run_c(head + "int main(void) { " + c.text + " return 0; }");
    EXPECT_EQ(registers[0x2d6], c.after) << c.text;
    EXPECT_EQ(run.modified, c.calls) << c.text;
    ASSERT_EQ(run.accesses.size(), 2u) << c.text;
    EXPECT_FALSE(run.accesses[0].is_write) << c.text;
    EXPECT_TRUE(run.accesses[1].is_write) << c.text;
  }
  registers[0x84] = 0x5678;
  EXPECT_EQ(run_c(head + "int main(void) { IFS0bits.b = 0; return 0; }").modified, 1);
  EXPECT_EQ(registers[0x84], 0x5670);
}

TEST(time, polling_a_register_bit_is_idle) {
  registers[0x84] = 0;
  auto run = run_c(
      "extern volatile struct { unsigned a:3; unsigned T1IF:1; unsigned :12; } IFS0bits "
      "__asm__(\"tp_sfr_0084\");\n"
      "int main(void) { while (!IFS0bits.T1IF); return 0; }",
      "-O1", 4);
  EXPECT_EQ(run.end, "poll");
}

TEST(time, address_of_a_register_is_refused_by_name) {
  Folder folder;
  auto built =
      build(folder,
            "extern volatile unsigned int LATA __asm__(\"tp_sfr_02C2\");\nvolatile unsigned int *p;\n"
            "int main(void) { p = &LATA; return 0; }");
  EXPECT_FALSE(built.ok);
  EXPECT_NE(text_of(built).find("main.c:3"), std::string::npos) << text_of(built);
  EXPECT_NE(text_of(built).find("register LATA"), std::string::npos) << text_of(built);
}

TEST(time, known_assembler_is_understood) {
  auto run = run_c(
      "int main(void) { asm(\"nop\"); __asm__ volatile (\"disi #0x3FFF\"); asm volatile(\"CLRWDT\"); "
      "__asm__(\"pwrsav #1\");\n"
      "asm(\"pwrsav #0\"); __asm__ volatile (\"reset\"); return 0; }");
  EXPECT_EQ(run.end, "reset");
  EXPECT_EQ(run.calls, (std::vector<std::string>{"disi 16383", "clrwdt", "idle", "sleep"}));
}

TEST(time, other_assembler_is_refused_with_its_text_and_line) {
  Folder folder;
  auto built = build(folder, "int main(void) {\n  asm(\"add w0, w1, w2\");\n  return 0; }");
  EXPECT_FALSE(built.ok);
  EXPECT_NE(text_of(built).find("main.c:2"), std::string::npos) << text_of(built);
  EXPECT_NE(text_of(built).find("add w0, w1, w2"), std::string::npos) << text_of(built);
}
