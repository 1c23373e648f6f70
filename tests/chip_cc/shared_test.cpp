// SPDX-License-Identifier: MIT
// Programs that poll plain variables: what a handler writes, in whatever file and by whatever pointer, is
// read where it stands at every level, and the build names it once.
#include <algorithm>
#include <string>
#include <vector>

#include "compiler/cache/shared_variables.h"
#include "tests/chip_cc/chip_program.h"

namespace chip_cc {
namespace {

// a handler that comes each 2,000 cycles and calls work()
const std::string kTimer = R"(
#include <p30F6014A.h>
#include <string.h>
void work(void);
void __attribute__((interrupt, auto_psv)) _T4Interrupt(void) { IFS1bits.T4IF = 0; work(); }
static void start(void) { TMR4 = 0; PR4 = 2000; IFS1bits.T4IF = 0; IEC1bits.T4IE = 1; T4CON = 0x8000; }
)";

struct Polled {
  const char* what;
  const char* code;            // work(), and poll(), which ends when work() has run
  const char* variable;        // that the build names; "": none
  const char* elsewhere = "";  // a second file
};

const Polled kPolled[] = {
    {"a plain flag", "int flag; void work(void) { flag = 1; } void poll(void) { while (!flag); }", "flag"},
    {"of this file", "static int flag; void work(void) { flag = 1; } void poll(void) { while (!flag); }",
     "flag"},
    {"of a function",
     "static int *at; void work(void) { if (at) *at = 1; }"
     "void poll(void) { static int flag; at = &flag; while (!flag); }",
     "flag"},
    {"a char", "char flag; void work(void) { flag++; } void poll(void) { while (flag < 3); }", "flag"},
    {"a long", "long count; void work(void) { count++; } void poll(void) { while (count != 3L); }", "count"},
    {"a member",
     "struct { int a, b; } s; void work(void) { s.a = 0; } void poll(void) { s.a = 1; while (s.a); }", "s"},
    {"a bit-field",
     "struct { unsigned a : 1, b : 1; } s; void work(void) { s.b = 1; } void poll(void) { while (!s.b); }",
     "s"},
    {"a member of an element",
     "struct P { int x; struct { char c[3]; } in[2]; } p[3]; void work(void) { p[1].in[1].c[2] = 5; }"
     "void poll(void) { while (p[1].in[1].c[2] != 5); }",
     "p"},
    {"set before", "int flag; void work(void) { flag = 0; } void poll(void) { flag = 1; while (flag); }",
     "flag"},
    {"an element", "int a[4]; void work(void) { a[2] = 7; } void poll(void) { while (a[2] != 7); }", "a"},
    {"an element by index",
     "int a[4], n = 2; void work(void) { a[n] = 7; } void poll(void) { int i = n; while (a[i] != 7); }", "a"},
    {"with a limit",
     "int m; void work(void) { m = 1; } void wait(void) { long i; for (i = 100000; i; i--) if (m) return; "
     "for (;;); }"
     "void poll(void) { wait(); }",
     "m"},
    {"in do while", "int m; void work(void) { m++; } void poll(void) { int k; do { k = m; } while (k < 2); }",
     "m"},
    {"twice in a row",
     "int m; void work(void) { m++; } void poll(void) { for (;;) { int k = m; Nop(); if (m != k) return; } }",
     "m"},
    {"two flags", "int a, b; void work(void) { if (a) b = 1; a = 1; } void poll(void) { while (!(a && b)); }",
     "a"},
    {"written by who is called",
     "int flag; static void deeper(int n) { if (n) deeper(n - 1); else flag = 1; } void work(void) { "
     "deeper(3); }"
     "void poll(void) { while (!flag); }",
     "flag"},
    {"written through a parameter",
     "int flag; void set(int *p) { *p = 1; } void work(void) { set(&flag); } void poll(void) { while "
     "(!flag); }",
     "flag"},
    {"a struct written through a parameter",
     "struct S { int a[3]; } s; void set(struct S *p) { p->a[1] = 1; } void work(void) { set(&s); }"
     "void poll(void) { while (!s.a[1]); }",
     "s"},
    {"written through a pointer to a pointer",
     "int flag, *p = &flag, **pp = &p; void work(void) { **pp = 1; } void poll(void) { while (!flag); }",
     "flag"},
    {"copied into",
     "int a[3], b[3] = {1, 2, 3}; void work(void) { memcpy(a, b, sizeof a); } void poll(void) { while (a[2] "
     "!= 3); }",
     "a"},
    {"assigned as a struct",
     "struct S { int a[5]; } s, t = {{1, 2, 3, 4, 5}}; void work(void) { s = t; } void poll(void) { while "
     "(s.a[4] != 5); }",
     "s"},
    {"copied from as a struct",
     "struct S { int a[5]; } s; void work(void) { s.a[4] = 5; }"
     "void poll(void) { struct S c; do c = s; while (c.a[4] != 5); }",
     "s"},
    {"read through a parameter",
     "int flag; static void wait(int *p) { while (!*p); } void work(void) { flag = 1; } void poll(void) { "
     "wait(&flag); }",
     "flag"},
    {"a variable of a function",
     "int *at; void work(void) { if (at) *at = 1; } void poll(void) { int flag = 0; at = &flag; while "
     "(!flag); }",
     "flag"},
    {"through a function pointer in a table",
     "int flag; void set(void) { flag = 1; } void (*const table[])(void) = {set}; void work(void) { "
     "table[0](); }"
     "void poll(void) { while (!flag); }",
     "flag"},
    {"through a function pointer in a struct",
     "int flag; void set(int n) { flag = n; } struct { int k; void (*f)(int); } hook;"
     "void work(void) { if (hook.f) hook.f(1); } void poll(void) { hook.f = set; while (!flag); }",
     "flag"},
    {"by assembler text",
     "int flag; void work(void) { asm(\"inc _flag\"); } void poll(void) { while (!flag); }", "flag"},
    {"by assembler text through a pointer",
     "int flag, *at = &flag; void work(void) { asm volatile(\"mov _at, w0\\n mov #1, w1\\n mov w1, [w0]\" "
     "::: "
     "\"w0\", \"w1\"); }"
     "void poll(void) { while (!flag); }",
     "flag"},
    {"by assembler text through a member's pointer that it moved",
     "char line[4]; struct { int k; char *to; } s = {0, line}; char *next;"
     "void work(void) { asm volatile(\"mov _s+2, w0\\n mov w0, _next\"); if (next) *next = 1; }"
     "void poll(void) { while (!line[0]); }",
     "line"},
    {"by a handler that is one by its name alone",
     "int flag; void work(void) { } void _T5Interrupt(void) { flag = 1; IFS1bits.T5IF = 0; }"
     "void poll(void) { PR5 = 900; IEC1bits.T5IE = 1; T5CON = 0x8000; while (!flag); }",
     "flag"},
    {"by the address in an int",
     "int flag; unsigned where; void work(void) { if (where) *(int *)where = 1; }"
     "void poll(void) { where = (unsigned)&flag; while (!flag); }",
     "flag"},
    {"written in another file", "extern int flag; void poll(void) { while (!flag); }", "flag",
     "int flag; void work(void) { flag = 1; }"},
    {"read in another file", "int flag; void work(void) { flag = 1; }", "flag",
     "extern int flag; void poll(void) { while (!flag); }"},
    {"by pointer from another file",
     "int flag; void set(int *); void work(void) { set(&flag); } void poll(void) { while (!flag); }", "flag",
     "void set(int *p) { *p = 1; }"},
    {"by a pointer that another file keeps",
     "int flag; void keep(int *); void poll(void) { keep(&flag); while (!flag); }", "flag",
     "static int *kept; void keep(int *p) { kept = p; } void work(void) { if (kept) *kept = 1; }"},
    {"a local of this file by a pointer that another file keeps",
     "static int flag; void keep(int *); void poll(void) { keep(&flag); while (!flag); }", "flag",
     "static int *kept; void keep(int *p) { kept = p; } void work(void) { if (kept) *kept = 1; }"},
    {"handed to an agenda of the library",
     "#include <motor_led/advance_one_timer/e_agenda.h>\n"
     "int flag; void tick(void) { flag = 1; } void work(void) { }"
     "void poll(void) { e_activate_agenda(tick, 1); e_start_agendas_processing(); while (!flag); }",
     "flag"},
    {"handed to an agenda by a function of the program",
     "#include <motor_led/advance_one_timer/e_agenda.h>\n"
     "int flag; void tick(void) { flag = 1; } void work(void) { }"
     "static void begin(void (*f)(void)) { e_activate_agenda(f, 1); e_start_agendas_processing(); }"
     "void poll(void) { begin(tick); while (!flag); }",
     "flag"},
    {"one of two that end it",
     "int flag, other; void work(void) { flag = 1; } void poll(void) { while (!(other || flag)); }", "flag"},
    {"a loop that never ends polls it",
     "int flag, seen; void work(void) { flag = 1; } void poll(void) { while (1) { if (flag) break; seen = 2; "
     "} }",
     "flag"},
    {"what is copied is not waited for",
     "int scan[8], copy[8]; void work(void) { scan[3] = 1; }"
     "void poll(void) { int i; for (i = 0; i < 8; i++) copy[i] = scan[i]; }",
     ""},
    {"nor is what is compared",
     "int scan[8], high; void work(void) { scan[3] = 1; }"
     "void poll(void) { int i; for (i = 0; i < 8; i++) if (scan[i] > high) high = scan[i]; }",
     ""},
    {"nor what is added up",
     "int level; long sum; void work(void) { level = 1; }"
     "void poll(void) { int i; for (i = 0; i < 8; i++) sum += level; }",
     ""},
    {"volatile needs no word",
     "volatile int flag; void work(void) { flag = 1; } void poll(void) { while (!flag); }", ""},
    {"nor does what a call may change",
     "int flag; void work(void) { flag = 1; } void poll(void) { while (!flag) start_again(); }", "",
     "void start_again(void) { }"},
};

TEST(ChipShared, what_a_handler_writes_is_read_where_it_stands_at_every_level) {
  int number = 0;
  for (const Polled& p : kPolled) {
    // -O0 and -Os ask the same of fewer
    const bool is_whole_row = number++ % 4 == 0;
    for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
      if (!is_whole_row && (level == std::string("-O0") || level == std::string("-Os"))) continue;
      SCOPED_TRACE(std::string(p.what) + " " + level);
      ChipProgram program("shared",
                          kTimer + "void start_again(void); void poll(void);\n" + p.code +
                              "\nlong bench_run(void) { start(); poll(); return 1; }",
                          level,
                          *p.elsewhere ? std::vector<std::string>{p.elsewhere} : std::vector<std::string>{});
      ASSERT_TRUE(program.is_whole()) << program.error();
      EXPECT_EQ(program.run(300'000), 1u);
      // named once, with its line, but at -O0, where XC16 reads it each time as well
      std::vector<std::string> told;
      for (const std::string& warning : program.warnings())
        if (warning.find("is not volatile") != std::string::npos) told.push_back(warning);
      const bool is_named = *p.variable && level != std::string("-O0");
      ASSERT_EQ(told.empty(), !is_named) << (told.empty() ? "" : told[0]);
      if (!is_named) continue;
      EXPECT_EQ(std::count_if(told.begin(), told.end(),
                              [&](const std::string& w) {
                                return w.find("'" + std::string(p.variable) + "' is written by ") !=
                                       std::string::npos;
                              }),
                1)
          << told[0];
      EXPECT_NE(told[0].find(".c:"), std::string::npos);
    }
  }
}

// a handler, a test and a debugger see what main()'s loop counts, though it never comes to an end
TEST(ChipShared, what_an_endless_loop_writes_is_seen_at_every_level) {
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
    SCOPED_TRACE(level);
    ChipProgram program("endless", kTimer + R"(
      volatile int flag;
      int seen, sum, by_pointer, *at = &by_pointer, inner, told;
      static struct { int a, b[2]; } s;
      void work(void) { flag = 1; if (s.b[1] > 2) told = s.b[1]; }
      long bench_run(void) {
        start();
        while (1) {
          int i;
          while (!flag);
          flag = 0;
          seen++;
          s.b[1]++;
          *at = seen;
          for (i = 0; i < 3; i++) { inner += 2; sum += inner; }
        }
      })",
                        level);
    ASSERT_TRUE(program.is_whole()) << program.error();
    // the timer comes each 2,001 cycles: 24 times
    program.run_for(50'000);
    const auto value = [&](const char* name) { return program.peek(program.address_of(name), 2); };
    EXPECT_EQ(value("seen"), 24u);
    EXPECT_EQ(value("by_pointer"), 24u);
    EXPECT_EQ(value("inner"), 144u);
    EXPECT_EQ(value("sum"), 72u * 73u);  // 2 + 4 + ... + 144
    EXPECT_GE(value("told"), 22u);
  }
}

TEST(ChipShared, what_no_handler_writes_is_left_to_the_optimiser) {
  // a table of functions that main() alone calls, and a helper that both call with pointers of their own
  ChipProgram program("unshared", kTimer + R"(
    int mine, theirs, calls;
    void add(int *p) { *p += 1; }
    void work(void) { theirs = 1; }
    void count(void) { calls++; }
    void (*table[2])(void) = {count, count};
    __attribute__((noinline)) int read_twice(void) { int a = mine; return a + mine + calls + calls; }
    long bench_run(void) { start(); add(&mine); table[mine](); return read_twice(); }
  )");
  ASSERT_TRUE(program.is_whole()) << program.error();
  EXPECT_EQ(program.run(), 4u);
  dspic::Cycle own = 0;
  ChipProgram again(
      "unshared",
      "int mine = 1, calls = 1;"
      "__attribute__((noinline)) int read_twice(void) { int a = mine; return a + mine + calls + calls; }"
      "long bench_run(void) { return read_twice(); }");
  again.run_counting("read_twice", own);
  dspic::Cycle with_handler = 0;
  ChipProgram third("unshared", kTimer + R"(
    int mine = 1, theirs, calls = 1;
    void work(void) { theirs = 1; }
    __attribute__((noinline)) int read_twice(void) { int a = mine; return a + mine + calls + calls; }
    long bench_run(void) { return read_twice(); }
  )");
  third.run_counting("read_twice", with_handler);
  EXPECT_EQ(with_handler, own);
}

}  // namespace
}  // namespace chip_cc
