// SPDX-License-Identifier: MIT
// The language as the robot computes it: torture.c at every level, and the calls that cross files and widths.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/cc/bench.h"
#include "twinpuck_paths.h"

using namespace cc_test;

namespace {
std::string torture() {
  std::ifstream in(std::string(TWINPUCK_SOURCE_DIR) + "/tests/cc/torture.c");
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}
}  // namespace

TEST(language, two_hundred_expressions_have_the_robots_values) {
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
    const std::string printed = printed_by(torture(), level);
    EXPECT_EQ(printed.substr(0, 3), "ok ") << level << "\n" << printed;
    if (printed.size() > 3) {
      EXPECT_GE(std::stoi(printed.substr(3)), 200);
    }
  }
}

// gcc's rule: `long x : 20` has 20 bits in arithmetic, and becomes a long, signed, beside a long.
TEST(language, wide_bit_fields_compute_in_their_own_width) {
  const char* text =
      "#include <stdio.h>\n"
      "struct { unsigned long u : 20; long s : 20; unsigned long long w : 40; } x;\n"
      "volatile long minus3 = -3;\n"
      "int main(void) { long v[4] = {1, 2, 3, 4}, *p = v + 3; int i = -1;\n"
      "x.u = 0xFFFFF; x.s = 0x7FFFF; x.w = 0xFFFFFFFFFFull;\n"
      "printf(\"%ld %ld %ld \", (long)(x.u + 1), (long)(x.s + 1), (long)(x.w * x.w));\n"
      "printf(\"%ld %d %d \", (long)(x.u / minus3), x.u < -1l, (int)(p - v) + (x.u == i));\n"
      "x.u /= minus3; i /= x.u; printf(\"%ld %d %ld\", (long)x.u, i, v[x.w + 2]); return 0; }";
  // x.u = -349525 in 20 bits: 699051, so i = 1048575 / 699051; v[0xFFFFFFFFFF + 2 in 40 bits] is v[1]
  for (const char* level : {"-O0", "-O1", "-O2"})
    EXPECT_EQ(printed_by(text, level), "0 -524288 1 -349525 0 4 699051 1 2") << level;
}

TEST(language, variable_arguments_have_the_robots_widths) {
  const char* text =
      "#include <stdarg.h>\n#include <stdio.h>\n"
      "long sum(int n, ...) { va_list a, b; long s = 0; va_start(a, n); va_copy(b, a);\n"
      "  while (n--) { s += va_arg(a, int); s += va_arg(a, long); s += (long)va_arg(a, double); }\n"
      "  s += va_arg(b, int); va_end(a); va_end(b); return s; }\n"
      "int main(void) { printf(\"%ld\", sum(4, -1, 100000L, 1.5, 2, -3L, 2.5, 3, 4L, 3.5, (char)-4, 5L, "
      "4.5f)); return 0; }";
  for (const char* level : {"-O0", "-O1", "-O2"}) EXPECT_EQ(printed_by(text, level), "100015") << level;
}

TEST(language, structures_and_narrow_values_pass_between_files) {
  Folder folder;
  folder.file("prog/other.c",
              "struct s { char a; int b; long c; float d; }; struct s twice(struct s v) { v.a *= 2; v.b *= "
              "2; v.c *= 2; v.d *= 2; return v; }\n"
              "char narrow(char c, unsigned char u, int i) { return c + u + i; } float half(v) int v; { "
              "return v / 2.0; }\n");
  auto built = build(
      folder,
      "#include <stdio.h>\nstruct s { char a; int b; long c; float d; }; struct s twice(struct s v); char "
      "narrow(char, unsigned char, int); float half();\n"
      "int main(void) { struct s v = {100, 20000, 100000L, 1.25f}; v = twice(v);\n"
      "printf(\"%d %d %ld %.2f %d %.1f\", v.a, v.b, v.c, v.d, narrow(-100, 250, 1), half(7)); return 0; }");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(output_of(folder.image()), "-56 -25536 200000 2.50 -105 3.5");
}

// 64 bits as 16 and 32: the chip's trap, whichever way the division goes; a wide quotient was all ones
TEST(language, division_by_zero_traps_in_every_width) {
  const char* text =
      "#include <stdio.h>\n#include <p30F6014A.h>\n"
      "volatile int traps, i, small = 5;\nvolatile long l;\n"
      "volatile long long wide = -5000000000LL, z, q;\n"
      "void __attribute__((interrupt, no_auto_psv)) _MathError(void) { traps++; INTCON1bits.MATHERR = 0; }\n"
      "#define TRY(operation) traps = 0; operation; printf(\"%d\", traps > 0)\n"
      "int main(void) {\n"
      "TRY(i = small / (int)z); TRY(i = small % (unsigned)z); TRY(l = small / (long)z); printf(\" \");\n"
      "TRY(q = small / z); TRY(q = small % z); TRY(q = wide / z); TRY(q = wide % z); printf(\" \");\n"
      "TRY(q = 5u / (unsigned long long)z); TRY(q = 5u % (unsigned long long)z);\n"
      "TRY(q = (unsigned long long)wide / (unsigned long long)z);\n"
      "TRY(q = (unsigned long long)wide % (unsigned long long)z); printf(\" \");\n"
      "TRY(q = wide / small); TRY(q = 0 / wide); printf(\" %lld\", wide / 1000000000LL);\nreturn 0; }";
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"})
    EXPECT_EQ(printed_by(text, level), "111 1111 1111 00 -5") << level;
}
