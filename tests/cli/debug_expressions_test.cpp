// SPDX-License-Identifier: MIT
// twinpuck debug computes as the program does: each expression is computed by both, on the chip.
#include "tests/cli/debug_fixture.h"

namespace {

class DebugExpressions : public cli_test::Debug {};
INSTANTIATE_TEST_SUITE_P(, DebugExpressions, ::testing::Values("sim", "dspic"), cli_test::hal_name);

constexpr const char* kVariables = R"(#include <p30F6014A.h>
typedef unsigned char u8;
typedef struct { int x, y; } point;
enum state { STOP, RUN = 5, BACK = -2 };
enum colour { RED, GREEN = 40000u };
struct node { int value; struct node *next; unsigned three : 3; int four : 4; unsigned all : 16; };
struct wide { unsigned long twenty : 20; long signed_twenty : 20; };
union both { long l; u8 bytes[4]; };
volatile int i = -3, k = 300, zero, least = -32767 - 1;
volatile unsigned u = 0, v = 65535u;
volatile long l = -100000;
volatile unsigned long ul = 3000000000ul;
volatile long long ll = -5000000000LL;
volatile char c = -1;
volatile u8 b = 250;
volatile short s = 12345;
volatile float f = 1.5f, third = 0.33333333f;
volatile double d = -2.75;
volatile long double ld = 1e9;
volatile enum state st = BACK;
volatile enum colour col = GREEN;
volatile point points[3] = {{1, 2}, {-3, 4}, {5, -6}};
struct node nodes[3] = {{5, &nodes[1], 5, -3, 40000u}, {-7, &nodes[2], 7, 7, 1}, {9, 0, 0, 0, 0}};
volatile struct wide w = {0xFFFFF, -5};
volatile union both un = {0x04030201};
int table[3][4] = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, -12}};
struct node *volatile n = nodes;
int *volatile p = &table[1][2];
u8 *volatile q = (u8 *)&table[0][1];
const char *volatile text = "robot";
void *volatile raw = &nodes[1];
)";

/// Of whole numbers and pointers.
const std::vector<std::string> kWhole{
    // the examples of the bug, widths and signs
    "u - 1 > 5", "k * 200", "k * 200L", "(long)k * 200", "k * 200u", "-1 < 1u", "i < u", "i < v", "i < ul",
    "l < u", "l < ul", "ll < ul", "c < u", "b + 10", "(u8)(b + 10)", "b << 8", "b << 7", "c << 4", "~b", "~c",
    "~u", "-u", "-b", "-v", "-least", "least - 1", "least / -1", "v + 1", "v * v", "s * 3", "s + s + s",
    "k * k", "ul + ul", "ul * 2", "l * l", "ll * 3", "u - v", "(int)v", "(char)k", "(signed char)200",
    "(unsigned char)-1", "(unsigned long)-1", "(long)u - 1", "(unsigned)i", "(long)(unsigned)i",
    "(long long)ul",
    // divisions, rests, shifts
    "-7 / 2", "-7 % 2", "i / 2", "i % 2", "k / i", "k % i", "v / 2", "v % 10", "l / 7", "l % 7", "ul / 7",
    "ul % 7", "ll / 7", "ll % 7", "i / 2u", "i >> 1", "v >> 1", "l >> 3", "ul >> 3", "ll >> 3", "1 << 15",
    "1L << 20", "1u << 15", "k << 7", "l << 7", "-1 >> 15", "b >> 1 << 1",
    // bits, logic, precedence
    "k & 0xF", "k | 1", "k ^ v", "!k", "!!k", "!zero", "k && zero", "k || zero", "zero && (1 / zero)",
    "k || (1 / zero)", "k & 12 == 12", "1 + 2 * 3 - 4 / 2 % 3", "1 | 2 ^ 3 & 4", "i < k == 1",
    "k > 3 ? 10 : 20", "zero ? 1 / zero : 7", "k ? i : u", "zero ? l : b", "2 - 1 - 1", "16 / 4 / 2",
    "1 << 2 << 3", "- - 3", "~ ~ 3", "+b",
    // constants
    "32767", "32768", "65535", "65536", "0x7FFF", "0x8000", "0xFFFF", "0x10000", "0x80000000", "2147483647",
    "077", "0b1010", "10u", "10l", "10ul", "70000u", "'a'", "'\\n'", "'\\0'", "'\\\\'", "'\\xFF'", "'a' + 1",
    // floats made whole, and compared
    "(int)d", "(int)f", "(long)ld", "f > 1", "f == 1.5", "d < f", "third * 3 == 1", "third == 0.33333333f",
    "!f", "f && d", "(int)(f * 2)", "(long)(d * 1000)", "f > i", "f > ul", "1.5 > 1", "0.1 == 0.1f",
    "k / 1000.0 < 1",
    // enums, structs, arrays, unions, bit-fields
    "st", "st == BACK", "st < 0", "RUN + 1", "col", "col == GREEN", "col > 0", "points[1].x * points[2].y",
    "nodes[0].three - 6", "nodes[0].three", "nodes[0].four * 2", "-nodes[0].all", "nodes[0].all + 30000",
    "w.twenty", "w.signed_twenty", "w.twenty + 1", "w.signed_twenty * 2", "w.twenty << 4",
    "un.bytes[1] + un.bytes[3]", "un.l", "table[1][2] - table[2][3]", "table[zero + 1][k - 299]",
    "points[points[0].x].y",
    // pointers
    "n->value", "n->next->value", "n->next->next->value", "n->next->next->next == 0", "*p", "p[1]", "p[-1]",
    "*(p + 1)", "*p + 1", "q[0] + q[2]", "*(int *)q", "*(q + 2)", "text[0]", "text[4] - 'a'", "*text",
    "&nodes[2] - nodes", "&nodes[1] == raw", "(struct node *)raw - n", "((struct node *)raw)->value",
    "p - &table[0][0]", "p > &table[0][0]", "p == &table[1][2]", "!p", "p && n",
    "&points[1].y - &points[0].x", "*&k", "*(u8 *)&un.l", "(int)(p + 1) - (int)p",
    "(int)&nodes[1] - (int)&nodes[0]", "(unsigned)(q + 1) - (unsigned)q", "(*n).value", "(&nodes[1])->three",
    "*table[2]", "*(*(table + 1) + 1)",
    // sizes
    "sizeof(int)", "sizeof(long)", "sizeof(long long)", "sizeof(char)", "sizeof(float)", "sizeof(double)",
    "sizeof(long double)", "sizeof(int *)", "sizeof nodes", "sizeof nodes[0]", "sizeof(struct node)",
    "sizeof(point)", "sizeof(u8)", "sizeof k", "sizeof(k + 1L)", "sizeof(b + b)", "sizeof 'a'", "sizeof 1.0",
    "sizeof table / sizeof table[0]", "sizeof(enum state)", "sizeof *n", "sizeof(int) - 3 > 0"};
const std::vector<std::string> kReal{"f * 2",    "f / 3",        "third * 3",   "third + d",  "d * k",
                                     "k / 7.0",  "f + i",        "1e3 + third", "0.1 + 0.2",  "f ? d : i",
                                     "-d",       "(float)k / 3", "l * 0.001",   "ul * 1.0",   "(double)b / 7",
                                     "1 / 3.0f", "100000 * f",   "ld * 2",      "1.0 / 3 * 3"};

// C has no size of a bit-field
bool has_size(const std::string& expression) {
  for (const char* field : {"nodes[0].three", "w.twenty", "w.signed_twenty", "(&nodes[1])->three"})
    if (expression == field) return false;
  return true;
}

TEST_P(DebugExpressions, each_is_what_the_program_computes) {
  std::string program = kVariables, commands = "break done\nc\n";
  program += "long long whole[" + std::to_string(kWhole.size()) + "];\nlong double real[" +
             std::to_string(kReal.size()) + "];\nunsigned char wholes[" + std::to_string(kWhole.size()) +
             "], reals[" + std::to_string(kReal.size()) + "];\n";
  program += "__attribute__((noinline)) void done(void) { LATA = 1; }\nint main(void) {\n";
  const auto add = [&](const std::vector<std::string>& all, const std::string& name,
                       const std::string& type) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string at = "[" + std::to_string(i) + "]";
      const std::string value = "(" + type + ")(" + all[i] + ")", size = "sizeof(" + all[i] + ")";
      program += "  " + name + at + " = " + value + ";\n";
      commands += "print " + name + at + " == " + value + "\n";
      if (!has_size(all[i])) continue;
      program += "  " + name + "s" + at + " = " + size + ";\n";
      commands += "print " + name + "s" + at + " == " + size + "\n";
    }
  };
  add(kWhole, "whole", "long long");
  add(kReal, "real", "long double");
  program += "  while (1) done();\n}\n";
  build(program);
  const std::string said = debug(commands);
  std::size_t right = 0, at = 0;
  for (std::size_t line = 0; (line = said.find("> print ", at)) != std::string::npos;) {
    const std::size_t end = said.find('\n', line), answer = said.find('\n', end + 1);
    const std::string told = said.substr(end + 1, answer - end - 1);
    EXPECT_EQ(told.substr(told.size() - std::min<std::size_t>(told.size(), 10)), " = 1 (0x1)") << told;
    right += told.size() > 10;
    at = answer;
  }
  EXPECT_GT(right, 2 * 200u);
}

TEST_P(DebugExpressions, conditions_stop_where_the_program_would) {
  build(R"(#include <p30F6014A.h>
volatile unsigned u = 3;
volatile int k = 100;
volatile float level = 0;
__attribute__((noinline)) void work(int n) { LATA = n; }
int main(void) {
  int n = 0;
  while (1) { work(n++); u--; k += 100; level += 0.25f; }
}
)");
  const auto stops_at = [&](const std::string& condition) {
    const std::string said = debug("break work if " + condition + "\nc\nprint n\n", "--for 0.01");
    const std::size_t at = said.find("\nn = ");
    return at == std::string::npos ? said : said.substr(at + 5, said.find(' ', at + 5) - at - 5);
  };
  EXPECT_EQ(stops_at("u - 1 > 5"), "3");    // u is 0: 0 - 1 is 65535
  EXPECT_EQ(stops_at("k * 200 < 0"), "1");  // 200 * 200 is -25536
  EXPECT_EQ(stops_at("(long)k * 200 > 70000"), "3");
  EXPECT_EQ(stops_at("level"), "1");  // a quarter is not nothing
  EXPECT_EQ(stops_at("level > 0.6 && n % 2"), "3");
  EXPECT_EQ(stops_at("n == 2 ? 1 : 0"), "2");
  EXPECT_EQ(stops_at("(unsigned char)(n + 253) == 0"), "3");
  EXPECT_EQ(stops_at("10 / n == 5"), "0");  // what cannot be told stops
}

TEST_P(DebugExpressions, set_converts_as_an_assignment_does) {
  build(kVariables +
        std::string("int main(void) { while (1) LATA = k + b + c + (int)f + (int)d + nodes[0].value + "
                    "w.twenty + *p + s + u + (int)ld; }\n"));
  expect_in_order(
      debug("break main\nc\nset k = 70000\nset b = 300\nset c = 200\nset f = 2.25\nset d = k\nset k = -1.9\n"
            "set nodes[0].four = 7 + 2\nset w.twenty = -1\nset p[1] = -2\nset ld = 0.1\nset u = -1\nset p = "
            "&table[0][3]\n"
            "print *p\nset nodes = 3\nset k + 1 = 2\n"),
      {"k = 4464 (0x1170)", "b = 44 (0x2c)", "c = -56 (0xc8)", "f = 2.25", "d = 4464", "k = -1 (0xffff)",
       "nodes[0].four = -7 (0x9)", "w.twenty = 1048575 (0xfffff)", "p[1] = -2 (0xfffe)", "ld = 0.1",
       "u = 65535 (0xffff)", "p = 0x", "*p = 4 (0x4)", "got 'nodes', expected a variable of up to 8 bytes",
       "got 'k + 1', expected a variable of up to 8 bytes"});
}

// two files and two functions have variables of one name; _Bool holds 0 or 1
TEST_P(DebugExpressions, names_go_by_their_file_or_function) {
  write("mine/other.c", "static volatile int count = 7;\nint other(void) { return count; }\n");
  build(R"(#include <stdbool.h>
static volatile int count = 3;
volatile int zero;
volatile bool is_set;
struct { int a[8]; } big;
int other(void);
__attribute__((noinline)) int tick(void) { static volatile int count = 11; return ++count; }
__attribute__((noinline)) int away(int local) { volatile int kept = local; return kept; }
int main(void) { while (1) zero = 0 * (count + other() + tick() + is_set + big.a[7] + away(5)); }
)");
  expect_in_order(
      debug("break main\nc\nprint main.c:count\nprint other.c:count\nprint tick:count\nprint tick:count * 2 "
            "+ main.c:count\n"
            "print zero?other.c:count:main.c:count\nprint nosuch.c:count\nset other.c:count = 8\nprint "
            "other.c:count\n"
            "set is_set = 5\nset is_set = 0.25\nset is_set = 0\nprint (_Bool)6 + 1\nprint kept\nwatch "
            "big\nwatch big.a[7]\n"),
      {"main.c:count = 3 (0x3)", "other.c:count = 7 (0x7)", "tick:count = 11 (0xb)",
       "tick:count * 2 + main.c:count = 25 (0x19)", "zero?other.c:count:main.c:count = 3 (0x3)",
       "unknown symbol 'nosuch'", "other.c:count = 8 (0x8)", "other.c:count = 8 (0x8)", "is_set = 1 (0x1)",
       "is_set = 1 (0x1)", "is_set = 0 (0x0)", "(_Bool)6 + 1 = 2 (0x2)",
       "unknown symbol 'kept' here, expected one that is known where the program stands; away() has one",
       "got 'big' of 16 bytes, expected at most 8; watch a part of it", "watchpoint 2 on big.a[7]"});
}

// each command, and all that it says
TEST_P(DebugExpressions, mistakes_are_named) {
  build(kVariables + std::string("int main(void) { while (1) LATA = k + nodes[0].value; }\n"));
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"print k +", "a value is missing"},
      {"print *********p", "got '*********p', expected at most 8 [ or * within one another"},
      {"print ********p", "got '**p', expected a pointer to something of a known type"},
      {"print table[table[table[table[table[table[table[table[table[0]]]]]]]]]",
       "got 'table[table[table[table[table[table[table[table[table[0]]]]]]]]]', expected at most 8 [ or * "
       "within one another"},
      {"print (k", "')' is missing"},
      {"print k)", "unexpected ')'"},
      {"print 5 / 0", "division by zero"},
      {"print 3 = 4", "unexpected '= 4'"},
      {"print nodes + n->x", "got 'n->x', no member 'x' in 'node'"},
      {"print nodes[0] + 1", "got 'nodes[0] + 1', expected numbers or pointers beside '+'"},
      {"print k[0]", "got 'k[0]', expected a pointer to something of a known type"},
      {"print k.x", "got 'k.x', no member 'x' in it"},
      {"print nodes[0].", "got 'nodes[0].', expected a member's name behind it"},
      {"print n->", "got 'n->', expected a member's name behind it"},
      {"print 'a", "a ' is missing"},
      {"print '", "a character is missing"},
      {"print 12abc", "'12abc' is no number"},
      {"print 0b", "'0b' is no number"},
      {"print 0x", "'0x' is no number"},
      {"print *k", "got '*k', expected a pointer to something of a known type"},
      {"print main(3)", "unexpected '(3)'"},
      {"print f % 2", "got 'f % 2', expected whole numbers beside '%'"},
      {"print &3", "got '&3', expected something that has an address here"},
      {"print &nodes[0].three", "got '&nodes[0].three', expected something that has an address here"},
      {"print (struct none *)k",
       "unknown symbol 'struct', expected a variable of the image that is known here"},
      {"print (point)k", "got '(point)k', expected a number or a pointer, not a struct"},
      {"print m ? nodes[0] : 1",
       "unknown symbol 'm', expected a variable of the image that is known here; did you mean 'i'?"},
      {"print zero ? nodes[0] : 1", "zero ? nodes[0] : 1 = 1 (0x1)"},
      {"print k ? 1", "':' is missing"},
      {"print nodes[1", "']' is missing"},
      {"print nodes[f]", "got 'nodes[f]', expected a whole number in [ ]"},
      {"print *raw", "got '*raw', expected a pointer to something of a known type"},
      {"print raw[1]", "got 'raw[1]', expected a pointer to something of a known type"},
      {"print raw + 1", "raw + 1 = 0x084b"},
      {"print n + n", "got 'n + n', expected numbers beside '+'"},
      {"print n * 2", "got 'n * 2', expected numbers beside '*'"},
      {"print f << 1", "got 'f << 1', expected whole numbers beside '<<'"},
      {"print f & 1", "got 'f & 1', expected whole numbers beside '&'"},
      {"print ~f", "a number is missing behind the ~"},
      {"print -n", "a number is missing behind the -"},
      {"print !nodes[0]", "got '!nodes[0]', expected a number or a pointer, not a struct"},
      {"print nodes[0] == nodes[1]", "got 'nodes[0] == nodes[1]', expected numbers or pointers beside '=='"},
      {"print sizeof nodes[0].three", "got 'sizeof nodes[0].three', but a bit-field has no size"},
      {"print sizeof raw[0]", "got 'raw[0]', expected a pointer to something of a known type"},
      {"print nodes[0].nothing", "got 'nodes[0].nothing', no member 'nothing' in 'node'"},
      {"print k->x", "got 'k->x', expected a pointer to something of a known type"},
      {"print 1e", "'1e' is no number"},
      {"print 08", "'08' is no number"},
      {"print k 3", "unexpected '3'"},
      {"print", "a value is missing"},
      {"print $k",
       "unknown symbol '$k', expected a variable of the image that is known here; did you mean 'k'?"},
      {"print @", "unexpected '@'"},
      {"goto", "goto: expected a time such as 1.5s, or a cycle"},
      {"goto x", "goto: got 'x', expected a time such as 1.5s, or a cycle"},
      {"goto 1.5", "goto: got '1.5', expected a time such as 1.5s, or a cycle"},
      {"print 18446744073709551615", "18446744073709551615 = 18446744073709551615 (0xffffffffffffffff)"},
      {"print 18446744073709551616",
       "got '18446744073709551616', expected a whole number of 64 bits at most"},
      {"print 0x10000000000000000ul",
       "got '0x10000000000000000ul', expected a whole number of 64 bits at most"},
      {"goto 5m", "goto: got '5m', expected a time such as 1.5s, or a cycle"},
      {"goto -1", "goto: got '-1', expected a time such as 1.5s, or a cycle"},
      {"goto 1e15", "goto: got '1e15', expected a time such as 1.5s, or a cycle"},
      {"trace", "trace: got '', expected a file that can be written"},
      {"trace /nonexistent/x 3", "trace: got '/nonexistent/x', expected a file that can be written"},
      {"trace t.txt 0", "trace: got '0', expected a number of instructions from 1 to 10000000"},
      {"trace t.txt 3x", "trace: got '3x', expected a number of instructions from 1 to 10000000"},
      {"trace t.txt 99999999999",
       "trace: got '99999999999', expected a number of instructions from 1 to 10000000"},
      {"trace t.txt 10000001", "trace: got '10000001', expected a number of instructions from 1 to 10000000"},
      {"dis nosuch",
       "dis: got 'nosuch', expected a function, file:line, or an address of code such as 0x1a0; as a "
       "function, it is "
       "not in the program"},
      {"dis 3x",
       "dis: got '3x', expected a function, file:line, or an address of code such as 0x1a0; as a function, "
       "it is "
       "not in the program"},
      {"dis main 0", "dis: got '0', expected a number of instructions from 1 to 1000"},
      {"dis 0", "dis: got '0', expected a number of instructions from 1 to 1000"},
      {"dis 1001", "dis: got '1001', expected a number of instructions from 1 to 1000"},
      {"list main", "list: got 'main', expected a line from 1 to 1000000"},
      {"list -1", "list: got '-1', expected a line from 1 to 1000000"},
      {"x 0x800 many", "x: got 'many', expected a number of words from 1 to 4096"},
      {"x 0x800 4097", "x: got '4097', expected a number of words from 1 to 4096"},
      {"next twice", "next: got 'twice', expected a number of times from 1 to 1000000"},
      {"si 0", "si: got '0', expected a number of times from 1 to 1000000"},
      {"continue 5 times", "continue: got '5 times', expected a number of times from 1 to 1000000"},
      {"rc 1000001", "rc: got '1000001', expected a number of times from 1 to 1000000"},
      {"info", "got 'info ', expected info break, interrupts or world"},
      {"info regs", "got 'info regs', expected info break, interrupts or world"},
      {"set", "expected NAME = EXPRESSION"},
      {"set k", "expected NAME = EXPRESSION"},
      {"set 3 = 4", "got '3', expected a variable of up to 8 bytes or a register"},
      {"set nosuch = 1", "got 'nosuch', expected a variable of up to 8 bytes or a register"},
      {"delete 7", "there is no breakpoint 7"},
      {"delete x", "there is no breakpoint x"},
      {"watch nosuch", "got 'nosuch', expected a variable, a register or *address"},
      {"watch k + 1", "got 'k + 1', expected a variable, a register or *address"},
      {"watch k if m",
       "unknown symbol 'm', expected a variable of the image that is known here; did you mean 'i'?"},
      {"break nosuch",
       "got 'nosuch', expected a function, file:line, or an address of code such as 0x1a0; as a function, it "
       "is not in the program"},
      {"break main.c:9999", "got 'main.c:9999', expected a line with code in a file of the program"},
      {"break main if k +", "condition: a value is missing"},
      {"frobnicate", "unknown command 'frobnicate'; help lists them"},
      {"x nosuch", "unknown symbol 'nosuch', expected a variable of the image that is known here"},
      {"up 2", "up: got 2, expected a level of backtrace, 0 to 1"},
      {"frame 9", "frame: got 9, expected a level of backtrace, 0 to 1"}};
  std::string commands = "break main\nc\n";
  for (const auto& [command, answer] : rows) commands += command + "\n";
  const std::string said = debug(commands + "info break\n") + "\n";
  for (const auto& [command, answer] : rows)
    EXPECT_NE(said.find("\n> " + command + "\n" + answer + "\n> "), std::string::npos)
        << command << ": expected " << answer << ", got "
        << said.substr(std::min(said.size(), said.find("\n> " + command + "\n")), 200);
  EXPECT_FALSE(cli_test::fs::exists("t.txt")) << "what was refused has emptied a file";
}

TEST_P(DebugExpressions, a_step_by_lines_from_the_beginning_goes_to_main) {
  build(cli_test::kProgram);
  for (const char* step : {"next", "n", "step"})
    expect_in_order(debug(std::string("where\n") + step + "\nnext\nback\n"),
                    {"cycle 0: 0x000000", std::string("> ") + step, "main() (main.c:24)", "> next",
                     "main() (main.c:25)"});
  // breakpoints before it stop, and it is gone when it was not reached
  expect_in_order(
      debug("break main\nnext\ninfo break\nnext\n"),
      {"> next\nbreakpoint 1", "main() (main.c:24)", "1 break main, 1 times", "main() (main.c:25)"});
  // not in main() or below: there next is a line's
  expect_in_order(debug("break weigh\nc\nnext\n"), {"weigh() (main.c:14)", "> next", "weigh() (main.c:1"});
}

}  // namespace
