// SPDX-License-Identifier: MIT
// The chip's compiler, looked at as text: what must be one instruction is one, arguments travel where XC16's
// do, handlers keep what they use.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "compiler/cache/object_cache.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

/// Instructions of one function, a line each, without labels, directives and blanks.
std::string code_of(const std::string& source, const std::string& function,
                    const std::string& level = "-O1") {
  const fs::path work = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "chip_code";
  fs::create_directories(work);
  std::ofstream(work / "x.c") << "#include <p30F6014A.h>\n" << source;
  const std::string root = TWINPUCK_SOURCE_DIR;
  const auto run = cc::run_process({std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc", level, "-S", "-c",
                                    (work / "x.c").string(), "-I" + root + "/firmware/include", "-I",
                                    root + "/firmware/libc/include", "-o", (work / "x.s").string()});
  if (run.status != 0) return run.output;
  std::ifstream in(work / "x.s");
  std::string code;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line == "_" + function + ":") inside = true;
    if (line.rfind(".Lfunc_end", 0) == 0) inside = false;
    if (!inside || line.empty() || line[0] != '\t') continue;
    if (line[1] == '.' && line.rfind("\t.pword", 0) != 0) continue;  // .pword: of inline assembler
    code += std::regex_replace(line.substr(1), std::regex("\t"), " ") + "\n";
  }
  return code;
}

TEST(ChipCode, bit_of_register_is_set_cleared_and_toggled_by_one_instruction) {
  const char* source = R"(
void set(void) { LATAbits.LATA6 = 1; }
void clear(void) { IFS0bits.T1IF = 0; }
void toggle(void) { LATAbits.LATA12 ^= 1; }
void wait(void) { while (!IFS0bits.T1IF) ; }
void mask(void) { LATD |= 0x8000; })";
  // LATA 0x2C4 = 708, IFS0 0x084 = 132, LATD 0x2D6 = 726
  EXPECT_EQ(code_of(source, "set"), "bset 708, #6\nreturn\n");
  EXPECT_EQ(code_of(source, "set", "-O0"), "bset 708, #6\nreturn\n");
  EXPECT_EQ(code_of(source, "clear"), "bclr 132, #3\nreturn\n");
  EXPECT_EQ(code_of(source, "clear", "-O0"), "bclr 132, #3\nreturn\n");
  EXPECT_EQ(code_of(source, "toggle"), "btg 708, #12\nreturn\n");
  EXPECT_EQ(code_of(source, "wait"), "btst 132, #3\nbra z, .LBB3_1\nreturn\n");
  EXPECT_EQ(code_of(source, "mask"), "bset 726, #15\nreturn\n");
}

TEST(ChipCode, arguments_fill_gaps_as_with_xc16) {
  // a W0, b W3:W2, c W1: the long takes an even pair, and c comes back for the gap
  const char* source = R"(
int gap(int a, long b, int c) { return c; }
long pair(int a, long b) { return b; }
struct three { int v[3]; };
int of_struct(int a, struct three s, int c) { return s.v[2] + c; }
int ninth(int a, int b, int c, int d, int e, int f, int g, int h, int i, int j) { return j; })";
  EXPECT_EQ(code_of(source, "gap"), "mov w1, w0\nreturn\n");
  EXPECT_EQ(code_of(source, "pair"), "mov w3, w1\nmov w2, w0\nreturn\n");
  EXPECT_NE(code_of(source, "of_struct").find("add w3, w4, w0"), std::string::npos)
      << code_of(source, "of_struct");
  // i lies nearest to the return address, j below it: W14 - 2 (W14) - 4 (return) - 2 (i) = -8 + 2
  EXPECT_NE(code_of(source, "ninth").find("mov [w14-10], w0"), std::string::npos) << code_of(source, "ninth");
}

TEST(ChipCode, last_named_argument_before_dots_and_all_behind_it_travel_on_the_stack) {
  // as XC16's own code: format in memory below the return address, buffer in W0
  const char* source = R"(
int first(char *to, const char *format, ...) { return *format; }
extern int print(char *to, const char *format, ...);
void call(char *p) { print(p, (const char *)0x1234, 7); })";
  EXPECT_EQ(code_of(source, "first"), "lnk #0\nmov [w14-8], w0\nse [w0], w0\nulnk\nreturn\n");
  const std::string call = code_of(source, "call");
  EXPECT_NE(call.find("mov #4660, w"), std::string::npos) << call;
  EXPECT_EQ(call.find("mov #4660, w1\ncall"), std::string::npos) << call;
  EXPECT_NE(call.find("add #4, w15"), std::string::npos) << call;
  EXPECT_NE(call.find("sub #4, w15"), std::string::npos) << call;
}

// what XC16 1.22 makes of the same functions
TEST(ChipCode, struct_comes_back_where_w0_points) {
  const char* source = R"(
struct one { int v; };
struct five { int v[5]; };
extern struct five b;
struct one small(int k) { struct one r; r.v = k; return r; }
struct five large(void) { return b; })";
  EXPECT_EQ(code_of(source, "small"), "mov w1, [w0]\nreturn\n");
  EXPECT_NE(code_of(source, "large").find("[w0"), std::string::npos);
}

TEST(ChipCode, struct_of_4_or_8_bytes_travels_as_a_number_of_that_size) {
  const char* source = R"(
struct c4 { char a[4]; };
struct i2 { int v[2]; };
struct i3 { int v[3]; };
struct i4 { int v[4]; };
int bytes(int z, struct c4 p) { return p.a[2]; }
int pair(int z, struct i2 p) { return p.v[1]; }
int three(int z, struct i3 p) { return p.v[2]; }
int four(int z, struct i4 p) { return p.v[0]; }
int gap(int z, struct i2 p, int k) { return p.v[1] + k; })";
  EXPECT_NE(code_of(source, "bytes").find("w2"), std::string::npos);          // chars: from W1 on
  EXPECT_NE(code_of(source, "pair").find("mov w3, w0"), std::string::npos);   // W3:W2
  EXPECT_NE(code_of(source, "three").find("mov w3, w0"), std::string::npos);  // W1 to W3
  EXPECT_NE(code_of(source, "four").find("mov w4, w0"), std::string::npos);   // W4 to W7
  EXPECT_NE(code_of(source, "gap").find("add w3, w1, w0"), std::string::npos);
}

// seen in XC16's assembler text
TEST(ChipCode, struct_with_an_array_or_struct_of_odd_size_begins_anywhere) {
  const char* source = R"(
struct i3 { int v[3]; };
struct array { int v[3]; int last; };
struct inner { struct i3 v; int last; };
struct deep { struct array v; };
struct pairs { char a[4]; int b, last; };
union either { int v; char all[8]; };
struct other { union either u; };
int array(int z, struct array p, int k) { return p.last + k; }
int inner(int z, struct inner p, int k) { return p.last + k; }
int deep(int z, struct deep p, int k) { return p.v.last + k; }
int pairs(int z, struct pairs p, int k) { return p.last + k; }
int either(int z, struct other p, int k) { return p.u.v + k; }
extern int far(int, struct array, int);
int call(struct array *p) { return far(1, *p, 2); })";
  for (const char* odd : {"array", "inner", "deep"})  // W1 to W4
    EXPECT_NE(code_of(source, odd).find("add w4, w5, w0"), std::string::npos) << code_of(source, odd);
  EXPECT_NE(code_of(source, "pairs").find("add w7, w1, w0"), std::string::npos) << code_of(source, "pairs");
  EXPECT_NE(code_of(source, "either").find("add w4, w1, w0"), std::string::npos) << code_of(source, "either");
  EXPECT_NE(code_of(source, "call").find("mov #2, w5"), std::string::npos) << code_of(source, "call");
}

TEST(ChipCode, char_is_extended_by_who_reads_it) {
  const char* source = R"(
extern char got(char c);
int taken(char c) { return c; }
char given(int x) { return x; }
int asked(char *p) { return got(p[0]); })";
  EXPECT_EQ(code_of(source, "taken"), "se w0, w0\nreturn\n");
  EXPECT_EQ(code_of(source, "given"), "return\n");
  const std::string asked = code_of(source, "asked");
  EXPECT_LT(asked.find("rcall _got"), asked.find("se w0, w0")) << asked;
}

TEST(ChipCode, handler_keeps_what_it_uses_and_returns_by_retfie) {
  const char* source = R"(
int ticks, other, table[100];
void __attribute__((interrupt, no_auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; ticks++; }
void __attribute__((__interrupt__, __auto_psv__)) _T2Interrupt(void) { ticks++; }
void __attribute__((interrupt(__save__(ticks, other)), shadow, no_auto_psv)) _T3Interrupt(void) { ticks = other; }
void _ISR _T4Interrupt(void) { ticks = table[ticks] / other; })";
  EXPECT_EQ(code_of(source, "_T1Interrupt"), "bclr 132, #3\ninc _ticks\nretfie\n");
  // PSVPAG is 0x34 = 52
  EXPECT_EQ(code_of(source, "_T2Interrupt"),
            "push 52\npush w0\nmov #__const_psvpage, w0\nmov w0, 52\ninc _ticks\npop w0\npop 52\nretfie\n");
  EXPECT_EQ(code_of(source, "_T3Interrupt"),
            "push.s\npush _ticks\npush _other\nmov _other, w0\nmov w0, _ticks\npop _other\npop "
            "_ticks\npop.s\nretfie\n");
  // a division counts in RCOUNT, 0x36 = 54
  const std::string divides = code_of(source, "_T4Interrupt");
  EXPECT_EQ(divides.rfind("push 54\n", 0), 0u) << divides;
  EXPECT_NE(divides.find("repeat #17\ndiv.sw"), std::string::npos) << divides;
  EXPECT_NE(divides.find("pop 54\nretfie\n"), std::string::npos) << divides;
}

TEST(ChipCode, only_small_and_near_variables_are_taken_for_near) {
  const char* source = R"(
int small, big[100], near_one[100] __attribute__((near)), far_one __attribute__((far));
void a(void) { small++; }
void b(void) { big[3]++; }
void c(void) { near_one[3]++; }
void d(void) { far_one++; })";
  EXPECT_EQ(code_of(source, "a"), "inc _small\nreturn\n");
  EXPECT_EQ(code_of(source, "b").find("inc _big"), std::string::npos);
  EXPECT_EQ(code_of(source, "c"), "inc _near_one+6\nreturn\n");
  EXPECT_EQ(code_of(source, "d").find("inc _far_one"), std::string::npos);
}

TEST(ChipCode, inline_assembler_is_checked_by_the_instruction_table) {
  // DISI #5 is 0xFC0005
  const std::string good = code_of("void f(void) { __asm__ volatile(\"disi #5\"); }", "f");
  EXPECT_NE(good.find(".pword 16515077"), std::string::npos) << good;
  const fs::path work = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "chip_code";
  std::ofstream(work / "bad.c") << "void f(void) { __asm__ volatile(\"mov #70000, w0\"); }";
  const auto run = cc::run_process({std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc", "-c",
                                    (work / "bad.c").string(), "-o", (work / "bad.o").string()});
  EXPECT_NE(run.status, 0);
  EXPECT_EQ(run.output,
            (work / "bad.c").string() +
                ":1:33: error: 70000: got 0x11170, expected -0x8000 to 0xFFFF; in asm(\"mov #70000, w0\")\n");
}

}  // namespace
