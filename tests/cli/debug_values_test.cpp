// SPDX-License-Identifier: MIT
// twinpuck debug: values as C writes them, by the image's own debug information.
#include "tests/cli/debug_fixture.h"

namespace {

using cli_test::twinpuck;

class DebugValues : public cli_test::Debug {};
INSTANTIATE_TEST_SUITE_P(, DebugValues, ::testing::Values("sim", "dspic"), cli_test::hal_name);

constexpr const char* kTypes = R"(#include <p30F6014A.h>
struct motor { int speed; unsigned char on; unsigned mode : 3; unsigned rest : 5; };
volatile struct motor motors[2] = {{-300, 1, 5, 9}, {300, 0, 2, 1}};
volatile int table[2][3] = {{1, 2, 3}, {4, 5, -6}};
volatile float gain = 1.5f;

__attribute__((noinline)) int weigh(int n, volatile struct motor *m) {
  int s = n * m->speed;
  LATA = s + (int)gain;
  return s + LATB;
}

int main(void) {
  static int rounds;
  while (1) {
    rounds++;
    table[0][0] = weigh(rounds, &motors[1]);
  }
}
)";

TEST_P(DebugValues, variables_have_types_and_functions_have_locals) {
  build(kTypes);
  expect_in_order(
      debug(
          "break weigh\nc 2\nlocals\nprint motors\nprint motors[0].mode\nprint motors[1]\nprint table[1]\n"
          "print table[1][2]\nprint gain\nset motors[1].speed = 17\nprint motors[1].speed\nprint motors[2]\n"
          "print motors[1].colour\nprint nothing[1]\nfinish\nprint rounds\n"),
      {"> locals", "  n = 2 (0x2)\n", "  m = 0x0", "> print motors\n",
       "motors = {{speed = -300 (0xfed4), on = 1 (0x1), mode = 5 (0x5), rest = 9 (0x9)}, {speed = 300 "
       "(0x12c)",
       "motors[0].mode = 5 (0x5)",
       "motors[1] = {speed = 300 (0x12c), on = 0 (0x0), mode = 2 (0x2), rest = 1 (0x1)}",
       "table[1] = {4 (0x4), 5 (0x5), -6 (0xfffa)}", "table[1][2] = -6 (0xfffa)", "gain = 1.5",
       "motors[1].speed = 17 (0x11)", "motors[1].speed = 17 (0x11)",
       "got 'motors[2]', index 2, expected 0 to 1", "got 'motors[1].colour'",
       "expected a variable of the image", "rounds = 2 (0x2)"});
  // and so a trace knows them
  const auto traced = twinpuck("run maze --fw '*=" + program() + "' --for 0.01 --vcd '" + path("x.vcd") +
                               "' --vcd-signals '*:motors[1].speed'");
  EXPECT_EQ(traced.exit_code, 0) << traced.text;
  std::ifstream in(path("x.vcd"));
  const std::string vcd((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(vcd.find("b100101100 "), std::string::npos) << vcd;  // 300
}

// at each level of calls its own variables, kept in registers or on the stack, whatever the levels within have
// saved of them; and changes by their types
TEST_P(DebugValues, callers_have_their_own_variables) {
  for (const std::string opt : {"-O0", "-O1", "-O2"}) {
    const bool keeps_all = opt == "-O0";  // the optimiser needs neither the caller's argument nor its sum
    build(R"(#include <p30F6014A.h>
volatile int r; volatile float gain = -0.25f; volatile signed char c; struct { volatile int three : 3; } bits;
__attribute__((noinline)) int fact(int n) {
  if (n <= 1) { r = n; return 1; }
  return n * fact(n - 1);
}
__attribute__((noinline)) int work(int a, long b) {
  int k = a + 1;
  r = fact(4) + k;
  LATA = b >> 3;
  return k + r;
}
int main(void) {
  long big = 100000;
  for (int i = 42;; i++) {
    big += work(i, big);
    gain -= 0.25f; c = -1; bits.three = -2;
  }
}
)",
          opt);
    expect_in_order(
        debug("break fact if n == 1\nc\nprint n\nup\nprint n\nup 2\nlocals\ndown\nprint n\nframe 4\nprint "
              "a\nprint k\n"
              "set k = 77\nprint k\nup\nprint big\nlist\nprint n\nframe 99\nup x\nframe 0\nprint n\ndelete\n"
              "up 9\nwatch gain\nwatch c\nwatch bits.three\nc\nup\nc\nc\nc\n"),
        {"n = 1 ",
         "> up\n#1 0x",
         " fact() (main.c:5)\n5\t  return n * fact(n - 1);\n",
         "n = 2 ",
         "> up 2\n#3 0x",
         "  n = 4 ",
         "> down\n#2 0x",
         "n = 3 ",
         "> frame 4\n#4 0x",
         " work() (main.c:9)",
         keeps_all ? "a = 42 " : "> print a\n",
         "k = 43 ",
         "k = 77 ",
         "k = 77 ",
         "> up\n#5 0x",
         " main() (main.c:16)",
         keeps_all ? "big = 100000 " : "> print big\n",
         "16\t    big += work(i, big);",
         "> print n\n",
         "> frame 99\nframe: got 99, expected a level of backtrace, 0 to 6\n",
         "> up x\nup: got 'x', expected a level of backtrace, 0 to 6\n",
         "> frame 0\n#0 0x",
         "n = 1 ",
         "up: got 9, expected a level of backtrace, 0 to 6\n",
         "gain: -0.25 -> -0.5, by main() (main.c:17)",
         "c: 0 -> -1, by main() (main.c:17)",
         "bits.three: 0 -> -2, by main() (main.c:17)"});
  }
}

// what has no register lies in the frame, with arguments that found none; a function's breakpoint is behind
// what puts them there, so that its condition sees them
constexpr const char* kFrames = R"(#include <p30F6014A.h>
struct pair { long wide; char narrow; };
__attribute__((noinline)) void fill(int *p, struct pair *of, int n) {
  for (int i = 0; i < 4; i++) p[i] = 11 * (i + n);
  of->wide = 100000L * n;
  of->narrow = -n;
}
__attribute__((noinline)) int sum(long a, long b, long c, long d, int last) {
  int many[4];
  struct pair both;
  fill(many, &both, last);
  LATA = many[3] + both.narrow + (int)(a + b + c + d);
  return LATB;
}
int main(void) {
  int rounds[3] = {0, 0, 0};
  while (1) {
    rounds[1]++;
    rounds[2] = sum(1, 2, 3, 4, rounds[1]);
    rounds[0] = rounds[1] + rounds[2];
  }
}
)";

TEST_P(DebugValues, what_lies_in_frames_is_found_at_every_level) {
  for (const std::string level : {"-O0", "-O1", "-Os"}) {
    write("mine/main.c", kFrames);
    const auto built = twinpuck("build '" + path("mine") + "' --hal " + hal() + " --opt " + level + " -o '" +
                                program() + "'");
    ASSERT_EQ(built.exit_code, 0) << built.text;
    expect_in_order(
        debug("break sum if last == 3\nc\nprint last\nbreak main.c:13\nc\nprint many\nprint both\n"
              "set many[1] = 7\nprint many[1]\nprint last\nfinish\n"),
        {"last = 3 (0x3)", "many = {33 (0x21), 44 (0x2c), 55 (0x37), 66 (0x42)}",
         "both = {wide = 300000 (0x493e0), narrow = -3 (0xfd)}", "many[1] = 7 (0x7)", "many[1] = 7 (0x7)",
         "last = 3 (0x3)"});
  }
}

constexpr const char* kPointers = R"(#include <p30F6014A.h>
struct node { int value; struct node *next; const char *name; };
struct node nodes[3] = {{5, &nodes[1], "ab"}, {-7, &nodes[2], "cd"}, {9, 0, "ef"}};
int counts[4] = {10, 20, 30, 40};
int *volatile middle = &counts[1];
volatile float level = -2.75f;

__attribute__((noinline)) int visit(struct node *n, int round) {
  LATA = n->value + *middle + (int)level;
  return LATB + round;
}

int main(void) {
  int round = 0;
  while (1) {
    struct node *n;
    for (n = nodes; n; n = n->next) counts[3] += visit(n, round);
    round++;
  }
}
)";

// pointers are followed, and conditions see what the function sees
TEST_P(DebugValues, pointers_are_followed_and_conditions_know_locals) {
  build(kPointers);
  expect_in_order(
      debug("break visit if n->value == -7 && round == 2\nc\nprint round\nprint n->value\nprint *n\n"
            "print n->next->value\nprint n->name[1]\nprint *middle\nprint middle[1] + counts[round]\n"
            "print nodes[round - 1].value * 2\nprint -counts[0] * (*middle)\nprint level\nprint level + 1\n"
            "set n->next->value = 77\nprint nodes[2].value\nprint round->value\n"
            "print *round\nprint n->colour\nprint counts[9]\nprint *(n)\nprint n[\n"
            "break visit if nothing[2] > 1\nbreak main if n > 0\nwatch n->next->value\ninfo break\n"),
      {"round = 2 (0x2)",
       "n->value = -7 (0xfff9)",
       "*n = {value = -7 (0xfff9), next = 0x0",
       "n->next->value = 9 (0x9)",
       "n->name[1] = 100 (0x64)",
       "*middle = 20 (0x14)",
       "middle[1] + counts[round] = 60",
       "nodes[round - 1].value * 2 = -14",
       "-counts[0] * (*middle) = -200",
       "level = -2.75",
       "level + 1 = -1.75",
       "n->next->value = 77",
       "nodes[2].value = 77",
       "got 'round->value', expected a pointer",
       "got '*round', expected a pointer",
       "got 'n->colour', no member 'colour'",
       "got 'counts[9]', index 9, expected 0 to 3",
       "*(n) = {value = -7",
       "condition: ",
       "nothing",
       "n->next->value"});
}

}  // namespace
