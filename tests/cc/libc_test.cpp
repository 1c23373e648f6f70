// SPDX-License-Identifier: MIT
// The firmware's C library: formats with 16-bit int, strings, numbers, heap, mathematics, leaving.
#include <gtest/gtest.h>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <sstream>
#include <tuple>
#include <vector>

#include "tests/cc/bench.h"

using namespace cc_test;

namespace {
std::string printed(const std::string& body, const std::string& level = "-O1") {
  return printed_by(
      "#include <stdio.h>\n#include <string.h>\n#include <stdlib.h>\n#include <math.h>\n#include "
      "<ctype.h>\n#include <setjmp.h>\n#include <errno.h>\n#include <limits.h>\n"
      "jmp_buf where; int order(const void *a, const void *b) { return *(const int *)a - *(const int "
      "*)b; }\n"
      "void jump(void) { longjmp(where, 7); }\n"
      "int main(void) {" +
          body + " return 0; }",
      level);
}

/// What one statement of a program prints.
struct Row {
  const char* statement;
  const char* expected;
};

/// All in one program, each in a line of its own.
template <int n>
void expect_lines(const Row (&rows)[n]) {
  std::string body;
  for (const Row& row : rows) body += std::string("{ ") + row.statement + " printf(\"\\n\"); }\n";
  std::istringstream lines(printed(body));
  for (const Row& row : rows) {
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, row.expected) << row.statement;
  }
}
}  // namespace

TEST(libc, printf_formats_integers_of_the_robots_width) {
  EXPECT_EQ(printed("printf(\"%d %u %x %ld %lu %lx\", -1, -1, -1, -1L, -1L, -1L);"),
            "-1 65535 ffff -1 4294967295 ffffffff");
  EXPECT_EQ(printed("printf(\"[%5d][%-5d][%05d][%+d][% d][%.3d]\", 42, 42, 42, 42, 42, 7);"),
            "[   42][42   ][00042][+42][ 42][007]");
  EXPECT_EQ(printed("printf(\"%c%s%%%.2s|%5s|%-5s|%*d\", 'a', \"bc\", \"defg\", \"h\", \"i\", 4, 5);"),
            "abc%de|    h|i    |   5");
  EXPECT_EQ(printed("printf(\"%#x %#o %X %o %lld\", 255, 8, 0xBEEF, 8, 5000000000LL);"),
            "0xff 010 BEEF 10 5000000000");
  EXPECT_EQ(printed("printf(\"%d %ld\", -32767 - 1, -2147483647L - 1);", "-O0"), "-32768 -2147483648");
}

TEST(libc, printf_formats_floats) {
  EXPECT_EQ(printed("printf(\"%f %.2f %8.3f|%-8.1f|%.0f\", 3.5, 2.345f, -1.5, 9.96, 2.5);"),
            "3.500000 2.35   -1.500|10.0    |2");
  // exact halves go to the even digit
  EXPECT_EQ(printed("printf(\"%.1f %.1f %.2f %.0f %.0f\", 0.25, 0.75, 0.125, 1.5, 0.5);"),
            "0.2 0.8 0.12 2 0");
  EXPECT_EQ(printed("printf(\"%e %.2E %g %g %g %g\", 12345.0, 0.00123, 100000.0, 1000000.0, 0.0001, 0.5);"),
            "1.234500e+04 1.23E-03 100000 1e+06 0.0001 0.5");
  EXPECT_EQ(printed("printf(\"%f %g %e\", 0.0, 0.0, 0.0);"), "0.000000 0 0.000000e+00");
}

TEST(libc, printf_takes_and_stores_every_width) {
  static const Row kRows[] = {
      {"printf(\"%Lf %d|%Lg %d|%Le %d\", 1.5L, 7, -1e300L, 8, 2.5e-300L, 9);",
       "1.500000 7|-1e+300 8|2.500000e-300 9"},
      {"printf(\"%hhx %hhd %hhu %hhd %hx\", 0x1234, 200, -1, -129, -1);", "34 -56 255 127 ffff"},
      {"signed char c[2] = {1, 2}; int n[2] = {1, 2}; long l; long long q; printf(\"ab%hhn%hnc%ln%lln\", c, "
       "n, "
       "&l, &q); printf(\" %d %d %d %d %ld %lld\", c[0], c[1], n[0], n[1], l, q);",
       "abc 2 2 2 2 3 3"},
      {"printf(\"%jd %zu %td %i\", 5LL, sizeof(long), (char *)8 - (char *)4, 2);", "5 4 4 2"},
      {"printf(\"%#5.3o|%#o|%#.0o|%#x|%.0d|\", 8, 0, 0, 0, 0);", "  010|0|0|0||"},
      {"printf(\"%.45d|%-47.45d|%48.45ld\", 5, -5, 5L);",
       "000000000000000000000000000000000000000000005|-000000000000000000000000000000000000000000005 |   "
       "000000000000000000000000000000000000000000005"},
  };
  expect_lines(kRows);
}

TEST(libc, printf_rounds_before_it_chooses_a_form) {
  static const Row kRows[] = {
      {"printf(\"%g %g %g %.3g\", 999999.5, 99999.5, 0.000099999999, 999.5);", "1e+06 99999.5 0.0001 1e+03"},
      {"printf(\"%#.0f %#.0e %#g %#.3g %.0f\", 3.0, 3.0, 0.0, 100.0, 3.0);", "3. 3.e+00 0.00000 100. 3"},
      {"printf(\"%.2f\", 3.4028234663852886e38);", "340282346638528859811704183484516925440.00"},
      {"printf(\"%f %#.0f %25.1f|%025.0f\", 1e18, 1e20, -1e20, 1e20);",
       "999999984306749440.000000 100000002004087734272.  "
       "-100000002004087734272.0|0000100000002004087734272"},
      {"printf(\"%.0Lf\", 0x1p200L);", "1606938044258990275541962092341162602522202993782792835301376"},
      {"printf(\"%G %E %F %F %g %+f %05F\", INFINITY, -INFINITY, NAN, INFINITY, NAN, INFINITY, -INFINITY);",
       "INF -INF NAN INF nan +inf  -INF"},
      {"printf(\"%.22f|%26.22f|%.20e|%#.20g|%.20g\", 0.5, 1.5, 0.5, 0.5, 0.5);",
       "0.5000000000000000000000|  "
       "1.5000000000000000000000|5.00000000000000000000e-01|0.50000000000000000000|"
       "0.5"},
      {"printf(\"%Lg %.3Le\", 4.9406564584124654e-324L, 1.7976931348623157e308L);",
       "4.94066e-324 1.798e+308"},
  };
  expect_lines(kRows);
}

// as the PC prints the same single-precision numbers
TEST(libc, printf_makes_the_digits_that_a_pc_makes) {
  const float values[] = {
      0.0f,      1.0f,    -1.5f,     0.1f,        123456.0f,           1234567.0f,    9.9999995f,
      999999.0f, 0.0005f, 0.000055f, 1e-10f,      1.17549435e-38f,     3.4028235e38f, 1e-45f,
      2.5f,      0.125f,  1e10f,     16777216.0f, 4503599627370496.0f, 8.5e17f,       0.05f};
  const char* const formats[] = {"%f",    "%.0f", "%.3f", "%.10f", "%e",   "%.0e", "%.3e",
                                 "%.12E", "%g",   "%.0g", "%.3G",  "%.9g", "%#g",  "%+012.2f"};
  for (const char* format : formats) {
    std::string program, wanted;
    for (const float value : values) {
      char text[120];
      std::snprintf(text, sizeof text, "printf(\"%s \", %aF);", format, static_cast<double>(value));
      program += text;
      std::snprintf(text, sizeof text, format, static_cast<double>(value));
      wanted += text + std::string(" ");
    }
    EXPECT_EQ(printed(program), wanted) << format;
  }
}

TEST(libc, sprintf_and_friends_return_lengths) {
  EXPECT_EQ(printed("char b[8]; int n = snprintf(b, sizeof b, \"%s\", \"0123456789\"); printf(\"%d %s\", n, "
                    "b); puts(\"\"); putchar('x');"),
            "10 0123456\nx");
  EXPECT_EQ(printed("char b[20]; printf(\"%d\", sprintf(b, \"%d,%ld\", 12, 345678L));"), "9");
}

TEST(libc, sscanf_reads_the_robots_types) {
  EXPECT_EQ(printed("int a, h; long l; float f; char w[8], c; int n = sscanf(\"D,-12,70000 2.5 ff word!\", "
                    "\"%c,%d,%ld %f %x %4s\", &c, &a, &l, &f, &h, w);"
                    "printf(\"%d %c %d %ld %.1f %d %s\", n, c, a, l, f, h, w);"),
            "6 D -12 70000 2.5 255 word");
  EXPECT_EQ(printed("int a = 9; printf(\"%d %d\", sscanf(\"x\", \"%d\", &a), a);"), "0 9");
}

TEST(libc, sscanf_stores_every_width) {
  static const Row kRows[] = {
      {"long long q[4]; int n = sscanf(\"-5000000000 18446744073709551615 123456789ABCDEF0 0777777777777\", "
       "\"%lld %llu %llx %lli\", q, q + 1, q + 2, q + 3); printf(\"%d %lld %llu %llx %llo\", n, q[0], q[1], "
       "q[2], "
       "q[3]);",
       "4 -5000000000 18446744073709551615 123456789abcdef0 777777777777"},
      {"long double l[3]; int x, n = sscanf(\"1.5 -2e300 0x1p-900 7\", \"%Lf %Lg %Le %d\", l, l + 1, l + 2, "
       "&x); "
       "printf(\"%d %Lg %.3Lg %d %d\", n, l[0], l[1], l[2] == 0x1p-900L, x);",
       "4 1.5 -2e+300 1 7"},
      {"float f[5]; int n = sscanf(\"1 2.5 inf -3e1 0x.8\", \"%E %G %A %F %a\", f, f + 1, f + 2, f + 3, f + "
       "4); "
       "printf(\"%d %g %g %g %g %g\", n, f[0], f[1], f[2], f[3], f[4]);",
       "5 1 2.5 inf -30 0.5"},
      {"signed char c[2] = {9, 9}; int h, n = sscanf(\"-2 70000\", \"%hhd %hd\", c, &h); printf(\"%d %d %d "
       "%d\", n, "
       "c[0], c[1], h);",
       "2 -2 9 4464"},
      {"signed char c[2] = {9, 9}; int i; long l; long long q; int n = sscanf(\"12 34\", \"%*d%hhn "
       "%n%*d%ln%lln\", "
       "c, &i, &l, &q); printf(\"%d %d %d %d %ld %lld\", n, c[0], c[1], i, l, q);",
       "0 2 9 3 5 5"},
      {"char a[4], b[4], c[4]; int n = sscanf(\"]a-zq\", \"%2[]a]%2[^z]%[z-]\", a, b, c); printf(\"%d %s %s "
       "%s\", n, "
       "a, b, c);",
       "3 ]a - z"},
      {"int a, b; int n = sscanf(\"1234 0x12\", \"%2d%d %3i\", &a, &b, &b); printf(\"%d %d %d\", n, a, b);",
       "3 12 1"},
      {"int n, x = 5; float f; n = sscanf(\"0000000000000000000000000000000000000000000000000000000012 "
       "1.00000000000000000000000000000000000000000000000000001\", \"%d %f\", &x, &f); printf(\"%d %d %g\", "
       "n, x, f);",
       "2 12 1"},
      {"int a, n = sscanf(\"50 %7\", \"%*d%%%d\", &a); printf(\"%d %d\", n, a);", "1 7"},
  };
  expect_lines(kRows);
}

// C99 7.19.6.7: EOF where the input ends before the first conversion; a wrong character is no end
TEST(libc, sscanf_tells_an_end_from_a_mistake) {
  static const Row kRows[] = {
      {"char b[9]; printf(\"%d %d %d %d\", sscanf(\"\", \"%s\", b), sscanf(\"  \", \"%s\", b), sscanf(\"\", "
       "\"%c\", "
       "b), sscanf(\"\", \"%[a]\", b));",
       "-1 -1 -1 -1"},
      {"int a; printf(\"%d %d %d %d\", sscanf(\"\", \"x%d\", &a), sscanf(\"x\", \"x%d\", &a), sscanf(\"y\", "
       "\"x%d\", &a), sscanf(\"x-\", \"x%d\", &a));",
       "-1 -1 0 0"},
      {"int a; float f; printf(\"%d %d %d\", sscanf(\"\", \"%f\", &f), sscanf(\"5\", \"%d%d\", &a, &a), "
       "sscanf(\"5 z\", \"%d%d\", &a, &a));",
       "-1 1 1"},
      {"char b[9]; printf(\"%d %d\", sscanf(\"b\", \"%[a]\", b), sscanf(\"ab\", \"%3c\", b));", "0 -1"},
      {"printf(\"%d\", sscanf(\"\", \"\"));", "0"},
  };
  expect_lines(kRows);
}

TEST(libc, strings_and_memory_work_with_16_bit_lengths) {
  EXPECT_EQ(printed("char b[20] = \"abc\"; strcat(b, \"def\"); strncpy(b + 10, \"xy\", 4); printf(\"%s %d %d "
                    "%d %s %s\", b, strlen(b), strcmp(\"a\", \"b\") < 0,"
                    "memcmp(\"ab\", \"ac\", 2) < 0, strchr(b, 'd'), strstr(b, \"cd\"));"),
            "abcdef 6 1 1 def cdef");
  EXPECT_EQ(printed("char b[6]; int n = 5; memset(b, 'z', n); b[5] = 0; memmove(b + 1, b, 3); b[0] = 'q'; "
                    "memcpy(b + 3, \"kl\", (unsigned)(n - 3)); printf(\"%s\", b);"),
            "qzzkl");
  EXPECT_EQ(printed("char s[] = \"a,b;c\"; char *p = strtok(s, \",;\"); while (p) { printf(\"<%s>\", p); p = "
                    "strtok(0, \",;\"); }"),
            "<a><b><c>");
}

TEST(libc, memcpy_works_without_a_prototype) {
  EXPECT_EQ(printed_by("int puts(); char a[4], b[4] = \"xyz\"; int main() { memcpy(a, b, sizeof a); puts(a); "
                       "return 0; }"),
            "xyz\n");
}

TEST(libc, numbers_are_converted) {
  EXPECT_EQ(
      printed(
          "char *e; printf(\"%d %ld %ld %ld %s %.2f %d %ld\", atoi(\" -42x\"), atol(\"70000\"), "
          "strtol(\"0x1F\", 0, 0), strtol(\"777z\", &e, 8), e, atof(\"-1.25e1\"), abs(-5), labs(-70000L));"),
      "-42 70000 31 511 z -12.50 5 70000");
  // what follows a number is left
  EXPECT_EQ(
      printed("char *e, *f, *g; double x = strtod(\"1e\", &e) + strtod(\"2.5e+z\", &f) + strtod(\".\", &g); "
              "printf(\"%.1f %s %s %s\", x, e, f, g);"),
      "3.5 e e+z .");
}

// C99 7.20.1.4: the nearest value that there is, ERANGE, and all digits are taken
TEST(libc, whole_numbers_out_of_range_are_the_nearest_and_say_so) {
  static const Row kRows[] = {
      {"char *e; errno = 0; printf(\"%ld\", strtol(\"2147483647x\", &e, 10)); printf(\" %d %s\", errno, e);",
       "2147483647 0 x"},
      {"char *e; errno = 0; printf(\"%ld\", strtol(\"2147483648x\", &e, 10)); printf(\" %d %s\", errno, e);",
       "2147483647 34 x"},
      {"char *e; errno = 0; printf(\"%ld\", strtol(\"-2147483648x\", &e, 10)); printf(\" %d %s\", errno, e);",
       "-2147483648 0 x"},
      {"char *e; errno = 0; printf(\"%ld\", strtol(\" -2147483649x\", &e, 10)); printf(\" %d %s\", errno, "
       "e);",
       "-2147483648 34 x"},
      {"char *e; errno = 0; printf(\"%ld\", strtol(\"zzzzzzzz z\", &e, 36)); printf(\" %d%s\", errno, e);",
       "2147483647 34 z"},
      {"char *e; errno = 0; printf(\"%lu\", strtoul(\"4294967295x\", &e, 0)); printf(\" %d %s\", errno, e);",
       "4294967295 0 x"},
      {"char *e; errno = 0; printf(\"%lu\", strtoul(\"0x1FFFFFFFFx\", &e, 0)); printf(\" %d %s\", errno, e);",
       "4294967295 34 x"},
      {"char *e; errno = 0; printf(\"%lu\", strtoul(\"-1x\", &e, 0)); printf(\" %d %s\", errno, e);",
       "4294967295 0 x"},
      {"char *e; errno = 0; printf(\"%lld\", strtoll(\"9223372036854775807x\", &e, 10)); printf(\" %d %s\", "
       "errno, e);",
       "9223372036854775807 0 x"},
      {"char *e; errno = 0; printf(\"%lld\", strtoll(\"9223372036854775808x\", &e, 10)); printf(\" %d %s\", "
       "errno, e);",
       "9223372036854775807 34 x"},
      {"char *e; errno = 0; printf(\"%lld\", strtoll(\"-99999999999999999999x\", &e, 10)); printf(\" %d "
       "%s\", "
       "errno, e);",
       "-9223372036854775808 34 x"},
      {"char *e; errno = 0; printf(\"%llu\", strtoull(\"18446744073709551615x\", &e, 10)); printf(\" %d "
       "%s\", "
       "errno, e);",
       "18446744073709551615 0 x"},
      {"char *e; errno = 0; printf(\"%llu\", strtoull(\"18446744073709551616x\", &e, 10)); printf(\" %d "
       "%s\", "
       "errno, e);",
       "18446744073709551615 34 x"},
      {"printf(\"%ld %ld %lld\", atol(\"99999999999\"), atol(\"-99999999999\"), atoll(\"5000000000\"));",
       "2147483647 -2147483648 5000000000"},
      {"char *e; printf(\"%ld \", strtol(\"0xg\", &e, 16)); printf(\"%s\", e);", "0 xg"},
      {"const char *s = \" +\"; char *e; strtol(s, &e, 10); printf(\"%d\", e == s);", "1"},
      {"lldiv_t d = lldiv(-5000000001LL, 2); printf(\"%lld %lld %lld\", d.quot, d.rem, llabs(d.quot));",
       "-2500000000 -1 2500000000"},
  };
  expect_lines(kRows);
}

// C99 7.20.1.3; an exponent of nine digits took a multiplication a unit, for minutes
TEST(libc, floating_point_is_read_in_every_form) {
  static const Row kRows[] = {
      {"char *e; errno = 0; printf(\"%g\", strtod(\"0e999999999z\", &e)); printf(\" %d %s\", errno, e);",
       "0 0 z"},
      {"char *e; errno = 0; printf(\"%g\", strtod(\"1e999999999z\", &e)); printf(\" %d %s\", errno, e);",
       "inf 34 z"},
      {"char *e; errno = 0; printf(\"%g\", strtod(\"-1e39z\", &e)); printf(\" %d %s\", errno, e);",
       "-inf 34 z"},
      {"char *e; errno = 0; printf(\"%g\", strtod(\"-1e-99999999999z\", &e)); printf(\" %d %s\", errno, e);",
       "-0 34 z"},
      {"errno = 0; printf(\"%d\", strtold(\"1e300\", 0) / 1e300L - 1 < 1e-15L && strtold(\"1e300\", 0) > "
       "9.99999999999999e299L); printf(\" %d\", errno);",
       "1 0"},
      {"errno = 0; printf(\"%d\", strtold(\"1e309\", 0) == (long double)INFINITY); printf(\" %d\", errno);",
       "1 34"},
      {"errno = 0; printf(\"%d\", strtold(\"5e-324\", 0) > 0); printf(\" %d\", errno);", "1 0"},
      {"printf(\"%d\", strtold(\"0.1\", 0) == 0.1L && strtold(\"1e22\", 0) == 1e22L);", "1"},
      {"printf(\"%d\", strtof(\"3.4028235e38\", 0) == 0x1.fffffep127f && strtof(\"1e-45\", 0) == 0x1p-149f);",
       "1"},
      // halfway between two floats: to the even one
      {"printf(\"%.0f %.0f\", strtod(\"16777217\", 0), strtod(\"16777219\", 0));", "16777216 16777220"},
      {"printf(\"%g\", strtod(\"1000000000000000000000000000000000000000000e-42\", 0));", "1"},
      {"char *e; printf(\"%g\", strtod(\" -INF!\", &e)); printf(\"%s\", e);", "-inf!"},
      {"char *e; printf(\"%g\", strtod(\"infinit\", &e)); printf(\" %s\", e);", "inf init"},
      {"char *e; printf(\"%g\", strtod(\"Infinity.\", &e)); printf(\" %s\", e);", "inf ."},
      {"char *e; printf(\"%g\", strtod(\"nan(a_1).\", &e)); printf(\" %s\", e);", "nan ."},
      {"char *e; printf(\"%g\", strtod(\"NaN(a-1)\", &e)); printf(\" %s\", e);", "nan (a-1)"},
      {"char *e; printf(\"%g\", strtod(\"0x1.8p3z\", &e)); printf(\" %s\", e);", "12 z"},
      {"char *e; printf(\"%g\", strtod(\"-0X.8P-1\", &e)); printf(\" <%s>\", e);", "-0.25 <>"},
      {"char *e; printf(\"%g\", strtod(\"0x1e2\", &e)); printf(\" <%s>\", e);", "482 <>"},
      {"char *e; printf(\"%g\", strtod(\"0x.p1\", &e)); printf(\" %s\", e);", "0 x.p1"},
      {"char *e; printf(\"%g\", strtod(\"0x1p\", &e)); printf(\" %s\", e);", "1 p"},
      {"char *e; printf(\"%g\", strtod(\"1e+\", &e)); printf(\" %s\", e);", "1 e+"},
      {"const char *s = \" -in\"; char *e; strtod(s, &e); printf(\"%d\", e == s);", "1"},
  };
  expect_lines(kRows);
}

// the linker leaves 512 bytes for it
TEST(libc, heap_gives_and_takes) {
  EXPECT_EQ(printed("int i, ok = 1; char *p[4]; for (i = 0; i < 200; i++) { p[0] = malloc(100); p[1] = "
                    "malloc(100); p[2] = calloc(10, 4);"
                    "if (!p[0] || !p[1] || !p[2] || p[2][39]) ok = 0; free(p[1]); p[0] = realloc(p[0], 150); "
                    "if (!p[0]) ok = 0; free(p[0]); free(p[2]); }"
                    "printf(\"%d %d\", ok, malloc(600) == 0);"),
            "1 1");
}

TEST(libc, sorting_random_and_jumps) {
  EXPECT_EQ(printed("int t[6] = {5, -3, 9, 0, 9, -7}, i; qsort(t, 6, sizeof(int), order); for (i = 0; i < 6; "
                    "i++) printf(\"%d \", t[i]);"),
            "-7 -3 0 5 9 9 ");
  // by the place where it stands; 7, -8 and 10 stand nowhere
  EXPECT_EQ(
      printed(
          "int t[5] = {-7, -3, 0, 5, 9}, keys[8] = {-7, -3, 0, 5, 9, 7, -8, 10}, i; for (i = 0; i < 8; i++) "
          "{ "
          "int *p = bsearch(&keys[i], t, 5, sizeof(int), order); printf(\"%d \", p ? (int)(p - t) : -1); }"),
      "0 1 2 3 4 -1 -1 -1 ");
  EXPECT_EQ(printed("srand(3); printf(\"%d\", rand());"),
            "17747");  // (3 * 1103515245 + 12345) / 65536 % 32768
  EXPECT_EQ(printed("int n = setjmp(where); if (n == 0) jump(); printf(\"%d\", n);"), "7");
}

// halves go to the even neighbour, and what is beside them up or down: as the PC rounds
TEST(libc, a_long_double_is_rounded_to_the_nearest_float) {
  const double values[] = {0x1.000001p0,
                           0x1.000003p0,
                           0x1.0000010000001p0,
                           0x1.000000fffffffp0,
                           0x1.000002p0,
                           -0x1.000001p0,
                           0x1.ffffffp0,
                           0x1.fffffep127,
                           0x1.ffffffp127,
                           0x1.000001p-126,
                           0x1.800003p-127,
                           0x1.000001p-149,
                           0x1p-150,
                           0x1.8p-149,
                           0x1p-151};
  std::string program = "long double v[] = {", wanted;
  for (const double value : values) {
    char text[48];
    std::snprintf(text, sizeof text, "%aL, ", value);
    program += text;
    const auto rounded = static_cast<float>(value);
    std::uint32_t bits;
    std::memcpy(&bits, &rounded, sizeof bits);
    std::snprintf(text, sizeof text, "%lx ", static_cast<unsigned long>(bits));
    wanted += text;
  }
  EXPECT_EQ(
      printed(program + "}; unsigned i; for (i = 0; i < sizeof v / sizeof *v; i++) { float f = (float)v[i]; "
                        "unsigned long u; memcpy(&u, &f, 4); printf(\"%lx \", u); }"),
      wanted);
}

TEST(libc, mathematics_is_single_precision_under_both_names) {
  EXPECT_EQ(printed("printf(\"%d %d %.4f %.4f %.4f\", (int)sizeof(sin(1.0)), sin(1.0) == sinf(1.0f), "
                    "sqrt(2.0), atan2(1.0, -1.0), pow(2.0, 0.5));"),
            "4 1 1.4142 2.3562 1.4142");
  EXPECT_EQ(printed("printf(\"%.1f %.1f %.1f %.1f %.2f %d\", floor(-1.5), ceil(1.2), fabs(-2.5), fmod(7.5, "
                    "2.0), hypot(3.0, 4.0), (int)round(2.5));"),
            "-2.0 2.0 2.5 1.5 5.00 3");
}

namespace {
/// The value of an expression of x[i] for each argument x[i], as the robot has it.
std::vector<float> values_of(const std::string& expression, const std::vector<float>& arguments) {
  std::string program = "volatile float x[] = {";
  for (const float x : arguments) {
    char text[48];
    std::snprintf(text, sizeof text, "%aF, ", static_cast<double>(x));
    program += text;
  }
  program +=
      "}; unsigned i; for (i = 0; i < sizeof x / sizeof *x; i++) { union { float f; unsigned long u; } v; "
      "v.f = " +
      expression + "; printf(\"%lx \", v.u); }";
  std::istringstream printed_bits(printed(program));
  std::vector<float> values;
  for (std::uint32_t bits; printed_bits >> std::hex >> bits;) {
    float value;
    std::memcpy(&value, &bits, sizeof value);
    values.push_back(value);
  }
  return values;
}

/// Each value is as near to that of the PC's double precision as so many units of its last place.
void expect_near(const std::string& expression, double (*yardstick)(double),
                 const std::vector<float>& arguments, double most) {
  const std::vector<float> values = values_of(expression, arguments);
  ASSERT_EQ(values.size(), arguments.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double right = yardstick(static_cast<double>(arguments[i]));
    const double unit = std::ldexp(1.0, std::ilogb(right) - 23);
    EXPECT_LE(std::fabs(static_cast<double>(values[i]) - right) / unit, most)
        << expression << " of " << arguments[i] << ": got " << values[i] << ", expected " << right;
  }
}
}  // namespace

// Multiples of pi/2 had been taken off in single precision: sin(3e8f) was -4855. The PC's double precision
// is the yardstick; 16367173 * 2^72 is the float that is nearest to a multiple of pi/2.
TEST(libc, angles_of_any_size_have_their_sine) {
  std::vector<float> arguments = {3e8f,         1e20f,       3.4028235e38f, 16367173 * 0x1p72f,
                                  1e5f,         1.57079637f, 4.712389f,     3.14159274f,
                                  0.785398185f, 100,         -8192,         1e-30f,
                                  -3e8f,        196608,      2.3561945f};
  std::uint32_t state = 1;
  for (int i = 0; i < 60; ++i) {
    state = state * 1664525 + 1013904223;
    const std::uint32_t bits = (state & 0x807FFFFF) | (120 + state / 7 % 135) << 23;
    float x;
    std::memcpy(&x, &bits, sizeof x);
    arguments.push_back(x);
  }
  const std::tuple<const char*, double (*)(double), double> kFunctions[] = {
      {"sin(x[i])", &std::sin, 2}, {"cosf(x[i])", &std::cos, 2}, {"tan(x[i])", &std::tan, 4}};
  for (const auto& [value, yardstick, most] : kFunctions) expect_near(value, yardstick, arguments, most);
}

// the PC's double precision is the yardstick; units of a float's last place
TEST(libc, functions_are_right_to_their_last_places) {
  struct Function {
    const char* value;
    double (*yardstick)(double);
    double least, most, units;
  };
  static const Function kFunctions[] = {
      {"expf(x[i])", &std::exp, -87, 88.7, 2},
      {"logf(x[i])", &std::log, 0.5, 2, 2},
      {"logf(x[i])", &std::log, 1e-38, 3e38, 2},
      {"log10f(x[i])", &std::log10, 1e-38, 3e38, 3},
      {"sinhf(x[i])", &std::sinh, -0.5, 0.5, 3},
      {"sinhf(x[i])", &std::sinh, -89, 89, 3},
      {"coshf(x[i])", &std::cosh, -89, 89, 3},
      {"tanhf(x[i])", &std::tanh, -10, 10, 5},
      {"asinf(x[i])", &std::asin, -1, 1, 3},
      {"acosf(x[i])", &std::acos, -1, 1, 3},
      {"atanf(x[i])", &std::atan, -9, 9, 2},
      {"atanf(x[i])", &std::atan, -1e6, 1e6, 2},
      {"sqrtf(x[i])", &std::sqrt, 0, 3e38, 0.5},
      {"atan2f(0.25f, x[i])", [](double x) { return std::atan2(0.25, x); }, -9, 9, 3},
      {"hypotf(0.25f, x[i])", [](double x) { return std::hypot(0.25, x); }, -9, 9, 3},
      {"fmodf(x[i], 0.3125f)", [](double x) { return std::fmod(x, 0.3125); }, -1e6, 1e6, 0},
      {"powf(1.75f, x[i])", [](double x) { return std::pow(1.75, x); }, -60, 60, 40},  // by e^(y ln x)
      {"powf(x[i], 7)", [](double x) { return std::pow(x, 7); }, -9, 9, 5}};
  std::mt19937 random(7);
  for (const Function& f : kFunctions) {
    std::vector<float> arguments;
    for (int i = 0; i < 80; ++i) {
      const double share = static_cast<double>(random()) / 0x1p32;
      arguments.push_back(static_cast<float>(f.least > 0 ? f.least * std::pow(f.most / f.least, share)
                                                         : f.least + (f.most - f.least) * share));
    }
    expect_near(f.value, f.yardstick, arguments, f.units);
  }
}

// values by hand: a float of 2^23 and more is whole, halves go away from 0 by round(), to the even by rint()
TEST(libc, mathematics_holds_at_the_ends_of_its_range) {
  static const Row kRows[] = {
      {"volatile float x[] = {8388609, 0.49999997f, -0.49999997f, 8388607.5f, -2.5f, 3e9f, -INFINITY}; int "
       "i; for (i "
       "= 0; i < 7; i++) printf(\"%.9g %.9g|\", round(x[i]), rint(x[i]));",
       "8388609 8388609|0 0|-0 -0|8388608 8388608|-3 -2|3e+09 3e+09|-inf -inf|"},
      {"volatile float x[] = {-0.3f, -0.0f, 8388607.5f, -3e9f}; int i; for (i = 0; i < 4; i++) printf(\"%.9g "
       "%.9g "
       "%.9g|\", floor(x[i]), ceil(x[i]), trunc(x[i]));",
       "-1 -0 -0|-0 -0 -0|8388607 8388608 8388607|-3e+09 -3e+09 -3e+09|"},
      // 1e-40f is 71362 * 2^-149, and 2^149 % 71362 = 6030
      {"volatile float x = 1, y = 1e-40f; printf(\"%d %g %g %g\", fmod(x, y) == 6030 * 0x1p-149f, fmod(-6.0f "
       "* y, "
       "y), fmod(-5.5f, 2), fmod(3, INFINITY));",
       "1 -0 -1.5 3"},
      {"volatile float x = 1e30f, y = 1e-30f; printf(\"%.6g %.6g %g %g %.9g\", hypot(x, x), hypot(y, -y), "
       "hypot(-INFINITY, NAN), hypot(3e38f, 3e38f), hypot(3, 4));",
       "1.41421e+30 1.41421e-30 inf inf 5"},
      {"double w; volatile float x[] = {-INFINITY, -1, -0.25f, 2.75f}; int i; for (i = 0; i < 4; i++) { "
       "double r = "
       "modf(x[i], &w); printf(\"%g %g|\", r, w); }",
       "-0 -inf|-0 -1|-0.25 -0|0.75 2|"},
      {"volatile float i = INFINITY; printf(\"%.5f %.5f %.5f %.5f %.5f\", atan2(i, i), atan2(i, -i), "
       "atan2(-i, i), "
       "atan2(-i, -i), atan2(1, -i));",
       "0.78540 2.35619 -0.78540 -2.35619 3.14159"},
      {"volatile float t = 2, z = -0.0f, i = INFINITY, m = -1; printf(\"%d %d %g %g %g %g %g %g\", pow(t, "
       "-149) == "
       "0x1p-149f, pow(10, -40.0f) > 9.9e-41f, pow(z, -3), pow(z, 1025), pow(m, i), pow(-i, 0.5f), pow(0, "
       "NAN), "
       "pow(-t, 3000001));",
       "1 1 -inf -0 1 inf nan -inf"},
      {"volatile float x = 89; printf(\"%.5g %.5g %.5g %g %g\", sinh(x), sinh(-x), cosh(x), exp(x), "
       "exp(-104.0f));",
       "2.2448e+38 -2.2448e+38 2.2448e+38 inf 0"},
      // one multiplication a unit of the exponent took a fifth of a second
      {"volatile float o = 1, z = 0; printf(\"%d %g %g %g %d %d\", ldexp(o, -149) == 0x1p-149f, ldexp(o, "
       "30000), "
       "ldexp(-z, 32767), ldexp(o, -32767), ldexp(0x1p-149f, 276) == 0x1p127f, ldexp(1.5f, -150) == "
       "0x1p-149f);",
       "1 inf -0 0 1 1"},
  };
  expect_lines(kRows);
}

TEST(libc, headers_of_the_standard_are_there) {
  EXPECT_EQ(
      printed_by(
          "#include <iso646.h>\n#include <locale.h>\n#include <limits.h>\n#include <stdio.h>\n#include "
          "<stdlib.h>\n#include <string.h>\n"
          "int main(void) { struct lconv *l = localeconv(); char b[4] = \"...\"; wchar_t w[4] = {1, 1, 1, "
          "1};\n"
          "printf(\"%s %s %s %d|\", setlocale(LC_ALL, \"\"), setlocale(LC_NUMERIC, 0), setlocale(LC_ALL, "
          "\"C\"), setlocale(LC_ALL, \"de_DE\") == 0);\n"
          "printf(\"<%s><%s><%s> %d %d|\", l->decimal_point, l->thousands_sep, l->negative_sign, "
          "l->int_frac_digits == CHAR_MAX, l->int_n_sign_posn == CHAR_MAX);\n"
          "printf(\"%d%d%d%d|\", 1 and not 0, 5 bitand 4 or 0, 5 xor 4, compl 0 not_eq 0);\n"
          "printf(\"%d %s %d|\", strxfrm(b, \"ab\", 4), b, strxfrm(0, \"abcdef\", 0));\n"
          "printf(\"%d %d %d %d %d|\", MB_CUR_MAX, mblen(\"a\", 2), mblen(\"\", 1), mblen(\"a\", 0), "
          "mblen(0, 1));\n"
          "printf(\"%d %d %d \", mbtowc(w, \"\\xE9\", 1), w[0], mbstowcs(w, \"xy\", 4));\n"
          "printf(\"%d %d %d %s\", w[1], wctomb(b, 300), wcstombs(b, w, 4), b); return 0; }"),
      "C C C 1|<.><><> 1 1|1111|2 ab 6|1 1 0 -1 0|1 233 2 121 -1 2 xy");
}

// each limit is the largest value of its type, which a wider number shows
TEST(libc, limits_are_those_of_the_types) {
  std::string program =
      "#include <inttypes.h>\n#include <stddef.h>\n#include <signal.h>\n#include <stdio.h>\n";
  const auto check = [&](const std::string& type, const std::string& limit, bool is_signed) {
    const std::string bits = "(8 * sizeof(" + type + ") - " + (is_signed ? "1" : "0") + ")";
    program += "_Static_assert(" + limit + "_MAX == (0xFFFFFFFFFFFFFFFFULL >> (64 - " + bits + ")), \"" +
               limit + "\");\n";
    if (is_signed)
      program +=
          "_Static_assert(" + limit + "_MIN == -(long long)" + limit + "_MAX - 1, \"" + limit + "\");\n";
  };
  for (const std::string kind : {"", "_least", "_fast"})
    for (const std::string bits : {"8", "16", "32", "64"}) {
      const std::string upper = (kind.empty() ? "" : kind == "_least" ? "_LEAST" : "_FAST") + bits;
      check("int" + kind + bits + "_t", "INT" + upper, true);
      check("uint" + kind + bits + "_t", "UINT" + upper, false);
    }
  for (const auto& [type, limit] :
       {std::pair("intmax_t", "INTMAX"), std::pair("intptr_t", "INTPTR"), std::pair("ptrdiff_t", "PTRDIFF"),
        std::pair("sig_atomic_t", "SIG_ATOMIC")})
    check(type, limit, true);
  for (const auto& [type, limit] : {std::pair("uintmax_t", "UINTMAX"), std::pair("uintptr_t", "UINTPTR"),
                                    std::pair("size_t", "SIZE"), std::pair("wchar_t", "WCHAR")})
    check(type, limit, false);
  EXPECT_EQ(
      printed_by(program + "#if INTPTR_MAX != 32767 || WCHAR_MIN != 0 || SIZE_MAX != 65535\n#error\n#endif\n"
                           "int main(void) { int8_t a; int32_t b; uint64_t c = UINTMAX_C(1) << 40;\n"
                           "int n = sscanf(\"-7 70000\", \"%\" SCNd8 \" %\" SCNi32, &a, &b);\n"
                           "printf(\"%d %\" PRId8 \" %\" PRId32 \" %\" PRIu64 \" %\" PRIXPTR, n, a, b, c, "
                           "(uintptr_t)255); return 0; }"),
      "2 -7 70000 1099511627776 FF");
}

// (1 + 2i)(3 - 4i) = 11 + 2i; (11 + 2i) / (3 - 4i) = 1 + 2i; parts of 2^600 have no square
TEST(libc, complex_numbers_are_multiplied_and_divided_in_both_widths) {
  for (const std::string type : {"float", "long double"}) {
    const std::string large = type == "float" ? "0x1p100f" : "0x1p600L";
    EXPECT_EQ(
        printed_by("#include <stdio.h>\nint main(void) { volatile " + type +
                   " _Complex a, b, r; __real__ a = 1, __imag__ a = 2, __real__ b = 3, __imag__ b = -4;\n"
                   "r = a * b; printf(\"%g %g \", (double)__real__ r, (double)__imag__ r);\n"
                   "r = r / b; printf(\"%g %g \", (double)__real__ r, (double)__imag__ r);\n"
                   "__real__ a = " +
                   large + ", __imag__ a = " + large +
                   "; r = a / a; printf(\"%g %g\", "
                   "(double)__real__ r, (double)__imag__ r); return 0; }"),
        "11 2 1 2 1 0")
        << type;
  }
}

// a program that has given up starts anew; the simulator tells why (tests/chip/endings_test.cpp)
TEST(libc, leaving_is_a_reset) {
  for (const char* last : {"exit(0);", "exit(3);", "abort();"})
    EXPECT_EQ(printed("printf(\"on\"); " + std::string(last) + " printf(\"off\");"), "on") << last;
  const std::string failed =
      printed_by("#include <assert.h>\nint main(void) { int x = 2;\n assert(x == 3); return 0; }");
  EXPECT_TRUE(wording::reads(failed, "…/prog/main.c:3: assert(x == 3) failed"));
}

TEST(libc, what_a_robot_does_not_have_is_refused_by_name_and_line) {
  const char* const kCases[][2] = {
      {"#include <time.h>\nlong t;\nint main(void) { mktime(0); return 0; }",
       "mktime(): got no definition, expected one in the program or the library; is a .c file missing from "
       "the folder, or the name misspelt?"},
      {"#include <stdio.h>\nint x;\nint main(void) { x = getchar(); return 0; }",
       "getchar(): an e-puck has no keyboard; e_getchar_uart1() of uart/e_uart_char.h reads UART 1"},
      {"#include <stdio.h>\nint x;\nint main(void) { scanf(\"%d\", &x); return 0; }",
       "scanf(): an e-puck has no keyboard; e_getchar_uart1() of uart/e_uart_char.h reads UART 1, sscanf() "
       "what "
       "it has read"},
      {"int x;\n\nint main(void) { sleep(1); return 0; }",
       "sleep(): an e-puck has no operating system; time passes in the robot's step"},
      {"int x;\n\nint main(void) { usleep(10); return 0; }",
       "usleep(): an e-puck has no operating system; time passes in the robot's step"},
      {"#include <stdio.h>\nint x;\nint main(void) { x = (int)fopen(\"a\", \"r\"); return 0; }",
       "fopen(): an e-puck has no files; printf() writes to UART 1"},
      {"int x;\n\nint main(void) { system(\"ls\"); return 0; }",
       "system(): an e-puck has no operating system; leave it out"},
      {"int x;\n\nint main(void) { getenv(\"A\"); return 0; }",
       "getenv(): an e-puck has no operating system; use its selector, getselector() of utility/utility.h"},
      {"int x;\n\nint main(void) { pthread_create(0, 0, 0, 0); return 0; }",
       "pthread_create(): got no definition, expected one in the program or the library; is a .c file "
       "missing from the folder, or the name misspelt?"}};
  for (const auto& c : kCases) {
    Folder folder;
    auto built = build(folder, c[0]);
    EXPECT_FALSE(built.ok) << c[1];
    EXPECT_EQ(built.errors.size(), 1u) << text_of(built);
    EXPECT_TRUE(reads(folder, text_of(built), std::string("@/prog/main.c:3: error: main() calls ") + c[1]));
  }
  for (const auto& [header, said] :
       {std::pair("unistd.h", "'unistd.h' file not found"),
        std::pair("pthread.h", "'pthread.h' file not found"),
        std::pair("windows.h", "'windows.h' file not found"),
        std::pair("sys/time.h",
                  "#include <sys/time.h>: a robot has no operating system; use resetTime() and "
                  "getDiffTimeMs() of utility.h, or an agenda")}) {
    Folder folder;
    auto built =
        build(folder, std::string("int a;\n#include <") + header + ">\nint main(void) { return 0; }");
    EXPECT_FALSE(built.ok) << header;
    EXPECT_TRUE(reads(folder, text_of(built), std::string("@/prog/main.c:2:10: fatal error: ") + said));
  }
}
