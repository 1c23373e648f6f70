// SPDX-License-Identifier: MIT
// --sanitize: what programs do to memory, told by line and variable under both HALs; and programs that do
// right, of which nothing is told.
#include "tests/chip/hal_flight.h"

namespace {

struct Case {
  const char* name;
  const char* says;     // part of what is told; empty: the program does right
  const char* program;  // the line at fault ends in HERE
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const std::string kHead =
    "#include <p30F6014A.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n"
    "#include <motor_led/e_init_port.h>\n#include <uart/e_uart_char.h>\n"
    "volatile int n, one = 1, out; int *volatile p; char *volatile c;\n";

const Case kCases[] = {
    // what nobody wrote
    {"unwritten_local", "x is read, and nobody has written it; a branch depends on it",
     "int f(int a) { int x; if (a) x = 1;\n if (x) return 4; /* HERE */\n return 3; }\n"
     "int main(void) { out = f(n); while (1); }"},
    {"unwritten_sum", "sum is read, and nobody has written it",
     "int main(void) { int i, sum; for (i = 0; i < 3; i++)\n sum += i; /* HERE */\n if (sum > 5) out = 1; "
     "while (1); }"},
    {"unwritten_element", "k is read, and nobody has written it",
     "int main(void) { int k[4]; k[0] = k[1] = 2; p = k;\n if (p[3 * one]) out = 1; /* HERE */\n while (1); "
     "}"},
    {"unwritten_heap", "a heap block is read, and nobody has written it",
     "int main(void) { c = malloc(8); c[0] = 1;\n if (c[5]) out = 1; /* HERE */\n while (1); }"},
    {"unwritten_index", "an address is made of it",
     "int t[4], *q = t; int main(void) { int k[2]; p = k;\n out = q[p[1] & 3]; /* HERE */\n while (1); }"},
    {"unwritten_sent", "it goes to a register of the chip",
     "int main(void) { int k[2]; p = k;\n PORTB = p[1]; /* HERE */\n while (1); }"},
    {"unwritten_persistent", "kept is read, and nobody has written it",
     "int kept __attribute__((persistent)); int main(void) {\n if (kept) out = 1; /* HERE */\n while (1); }"},
    {"unwritten_half", "a branch depends on it",
     "int main(void) { int k[2], x; p = k; x = p[1]; "
     "asm volatile(\"mov.b #5, %0\" : \"+r\"(x)); if (x & 0x100) out = 1; /* HERE */\n while (1); }"},
    {"written_half", "",
     "int main(void) { int k[2], x; p = k; x = p[1]; asm volatile(\"mov.b #5, %0\" : \"+r\"(x));\n"
     " if (x & 0x10) out = 1;\n while (1); }"},
    {"copies_of_what_nobody_wrote", "",
     "struct s { char a; int b; char d[3]; } all[2]; void take(struct s v) { all[1] = v; }\n"
     "int main(void) { struct s one_of, two; one_of.a = 1; one_of.b = 2; two = one_of; take(two);\n"
     "if (all[1].b == 2) out = all[1].a; while (1); }"},
    {"bit_fields_one_by_one", "",
     "struct f { unsigned a : 3, b : 5, d : 1; }; void set(struct f *v) { v->b = 7; v->d = 1; }\n"
     "int main(void) { struct f v; set(&v); if (v.b == 7 && v.d) out = 1; v.a = 2; if (v.a) out = 2; "
     "while (1); }"},
    {"start_values", "",
     "int zero[3]; static long five = 5; const int table[2] = {1, 2};\n"
     "int main(void) { static char text[4]; if (zero[2] == 0 && five == 5 && text[one] == 0) out = "
     "table[one]; while (1); }"},
    // beyond an object
    {"global_read", "read out of bounds of a: got byte 9, expected 0 to 7",
     "int a[4]; int sum(int *q, int m) { int s = 0; while (m--)\n s += *q++; return s; } /* HERE */\n"
     "int main(void) { out = sum(a, 5); while (1); }"},
    {"global_write", "write out of bounds of a: got byte 4, expected 0 to 3",
     "char a[4]; int main(void) { c = a;\n c[4 * one] = 1; /* HERE */\n while (1); }"},
    {"static_write", "write out of bounds of kept",
     "int main(void) { static int kept[3]; p = kept;\n p[3 * one] = 1; /* HERE */\n while (1); }"},
    {"local_write", "write out of bounds of the local variable k: got byte 7, expected 0 to 5",
     "void fill(int *q, int m) { while (m--)\n q[m] = 1; } /* HERE */\n"
     "int main(void) { int k[3]; fill(k, 4); out = k[0]; while (1); }"},
    {"local_below", "write out of bounds of the local variable k: got byte -2",
     "int main(void) { int k[3]; p = k;\n p[-one] = 1; /* HERE */\n while (1); }"},
    {"index_of_an_array", "array index out of bounds",
     "int t[4]; int main(void) { n = 4;\n out = t[n]; /* HERE */\n while (1); }"},
    {"heap_read", "read out of the bounds of a heap block: got byte 4, expected 0 to 3",
     "int main(void) { c = malloc(4);\n out = c[4]; /* HERE */\n while (1); }"},
    {"heap_write", "write out of the bounds of a heap block: got byte 5, expected 0 to 4",
     "int main(void) { c = malloc(5);\n c[5] = 1; /* HERE */\n while (1); }"},
    {"all_within", "",
     "int a[4], b[4]; int sum(int *q, int m) { int s = 0; while (m--) s += *q++; return s; }\n"
     "void fill(int *q, int m) { while (m--) q[m] = m; }\n"
     "int main(void) { int k[3]; char *h = malloc(5); fill(a, 4); fill(b, 4); fill(k, 3); memset(h, 1, 5);\n"
     "out = sum(a, 4) + sum(k, 3) + h[4]; h = realloc(h, 12); h[11] = 2; out += h[4] + h[11]; free(h); "
     "while (1); }"},
    // what is gone
    {"freed_read", "use of freed heap memory: read",
     "int main(void) { c = malloc(4); c[0] = 1; free((void *)c);\n out = c[0]; /* HERE */\n while (1); }"},
    {"freed_write", "use of freed heap memory: write",
     "int main(void) { c = malloc(4); free((void *)c);\n c[1] = 1; /* HERE */\n while (1); }"},
    {"freed_twice", "free() of heap memory that is freed already",
     "int main(void) { c = malloc(4); free((void *)c);\n free((void *)c); /* HERE */\n while (1); }"},
    {"moved_away", "use of freed heap memory: read",
     "int main(void) { char *q; c = malloc(4); c[0] = 1; q = malloc(4); q[0] = 1; p = realloc((void *)c, "
     "40);\n"
     " out = c[0]; /* HERE */\n while (1); }"},
    {"grown_too_little", "read out of the bounds of a heap block: got byte 12, expected 0 to 11",
     "int main(void) { c = realloc(malloc(4), 12);\n out = c[12]; /* HERE */\n while (1); }"},
    {"freed_what_is_not_of_the_heap", "free() of what malloc() did not give",
     "int a[4]; int main(void) { c = malloc(4); p = a + 2;\n free((void *)p); /* HERE */\n while (1); }"},
    {"returned_read", "read beyond the top of the stack",
     "int *keep(void) { int v[3]; v[0] = 5; p = v; return p; }\n"
     "int main(void) { keep();\n out = *p; /* HERE */\n while (1); }"},
    {"returned_write", "write beyond the top of the stack",
     "void keep(void) { int v[3]; v[0] = 5; p = v; }\n"
     "int main(void) { keep();\n p[1] = 2; /* HERE */\n while (1); }"},
    {"passed_down", "",
     "int down(int *q, int m) { int v[3]; v[0] = *q + 1; return m ? down(v, m - 1) : v[0]; }\n"
     "int main(void) { int v[2]; v[0] = 1; out = down(v, 5); while (1); }"},
    // 16 bits
    {"addition", "integer overflow in an addition",
     "volatile int big = 32767; int main(void) {\n out = big + 1; /* HERE */\n while (1); }"},
    {"subtraction", "integer overflow in a subtraction",
     "volatile int big = -32767; int main(void) {\n out = big - 2; /* HERE */\n while (1); }"},
    {"multiplication", "integer overflow in a multiplication",
     "volatile int big = 300; int main(void) {\n out = big * big; /* HERE */\n while (1); }"},
    {"negation", "integer overflow in a negation",
     "volatile int big = -32767 - 1; int main(void) {\n out = -big; /* HERE */\n while (1); }"},
    {"shift", "shift by more than the width",
     "int main(void) { n = 16;\n out = 1 << n; /* HERE */\n while (1); }"},
    {"unsigned_wraps", "",
     "volatile unsigned big = 65535; volatile int some = 32000, four = 4; int main(void) { out = (int)(big + "
     "1); out = some + 700; "
     "out = 1 << (n + 14); big = big * big; out = 8000 * four; while (1); }"},
    // the library
    {"copy_too_long", "in memcpy(): write out of bounds of to",
     "char to[4], from[40]; int main(void) {\n memcpy(to, from, n + 5); /* HERE */\n while (1); }"},
    {"copy_from_too_short", "in memcpy(): read out of bounds of from",
     "char to[40], from[4]; int main(void) {\n memcpy(to, from, n + 5); /* HERE */\n while (1); }"},
    {"string_too_long", "in strcpy(): write out of bounds of the local variable to",
     "int main(void) { char to[4];\n strcpy(to, \"four\" + n); /* HERE */\n out = to[n]; while (1); }"},
    {"string_without_end", "read out of bounds of no_end",
     "char no_end[4]; int main(void) { memset(no_end, 1, 4);\n out = strlen(no_end); /* HERE */\n while (1); "
     "}"},
    {"printed_too_long", "write out of bounds of to",
     "char to[4]; int main(void) {\n sprintf(to, \"%d\", 1234 + n); /* HERE */\n while (1); }"},
    {"string_in_the_heap", "write out of the bounds of a heap block",
     "int main(void) { char *h = malloc(8 + n);\n strcpy(h, \"12345678\" + n); /* HERE */\n while (1); }"},
    {"strings_that_fit", "",
     "char all[40]; int order(const void *a, const void *b) { return *(int *)a - *(int *)b; }\n"
     "int main(void) { char five[5], line[80]; int k[4] = {4, 3, 2, 1}, a, b; char *end, *heap = malloc(6);\n"
     "memcpy(five, \"four\", 5); strcpy(heap, five); strcat(heap, \"5\"); strncpy(all, heap, sizeof all);\n"
     "sprintf(line, \"%d %ld %f %s %c %x\", 1, 2L, 3.5, five, 'c', 255);\n"
     "sscanf(\"12 34\", \"%d %d\", &a, &b); qsort(k, 4, sizeof k[0], order);\n"
     "a += (int)strtol(\"99\", &end, 10) + atoi(five) + (int)strlen(line) + k[0];\n"
     "memmove(all + 1, all, 39); memset(all, 0, sizeof all); strtok(line, \" \"); strstr(line, \"1\");\n"
     "free(heap); out = a + b; while (1); }"},
};

void run(twin::Twin& twin) {
  constexpr double kSeconds = 0.05;
  while (sim::to_seconds(twin.simulation().now()) < kSeconds) twin.simulation().step();
}

class MemoryCheckTest : public ::testing::TestWithParam<std::tuple<Case, const char*>> {};

TEST_P(MemoryCheckTest, is_told_by_line_and_name) {
  const auto& [c, hal] = GetParam();
  const std::string program = kHead + c.program + "\n";
  const std::size_t here = program.find("HERE");
  const auto line =
      here == std::string::npos
          ? 0
          : 1 + std::count(program.begin(), program.begin() + static_cast<std::ptrdiff_t>(here), '\n');
  for (const std::string level : {"-O0", "-O1", "-O2"}) {
    if (level == "-O2" && *c.says) continue;  // which leaves out stores that nobody looks at, and frames
    std::vector<std::string> problems;
    twin::Options options;
    options.hal = hal;
    options.optimisation = level;
    options.sanitize = true;
    const auto twin =
        twin::Twin::open(hal_test::world_with(std::string("memory-") + c.name, program), options, problems);
    ASSERT_TRUE(twin) << (problems.empty() ? "" : problems[0]);
    run(*twin);
    bool is_told = false;
    std::string all;
    for (const host::TrapReport& trap : twin->traps()) {
      all += trap.message + " at " + host::to_string(trap.place) + "\n";
      is_told |= trap.kind == host::kTrapSanitizer && trap.message.find(c.says) != std::string::npos &&
                 trap.place.line == line;
    }
    if (*c.says)
      EXPECT_TRUE(is_told) << level << ", line " << line << ": " << all;
    else
      EXPECT_EQ(all, "") << level;
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, MemoryCheckTest,
                         ::testing::Combine(::testing::ValuesIn(kCases), ::testing::Values("sim", "dspic")),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).name) + "_" + std::get<1>(info.param);
                         });

TEST(MemoryCheck, the_run_goes_on_and_a_place_is_told_once) {
  std::vector<std::string> problems;
  twin::Options options;
  options.sanitize = true;
  const auto twin = twin::Twin::open(
      hal_test::world_with("memory-goes-on", kHead + "int a[4]; int main(void) { p = a; while (1) { out++;\n "
                                                     "p[4 * one] = out; } }\n"),
      options, problems);
  ASSERT_TRUE(twin);
  run(*twin);
  EXPECT_EQ(twin->traps().size(), 1u);
  EXPECT_GT(twin->mind(0).runner()->cycles(), 600'000);
  const auto bytes = twin->mind(0).runner()->data().read_variable("out", 2);
  ASSERT_EQ(bytes.size(), 2u);
  EXPECT_NE(bytes[0] | bytes[1], 0);
}

}  // namespace
