// SPDX-License-Identifier: MIT
// Corners of C on the chip, each a few lines, at every level. A public compiler test-suite found most of
// them.
#include "tests/chip_cc/chip_program.h"

namespace chip_cc {
namespace {

struct Corner {
  const char* name;
  const char* source;  ///< bench_run() returns 0 when all is right, else which check failed
};

const Corner kCorners[] = {
    {"distances of labels count as pointers do", R"(
static int c;
__attribute__((noinline)) static void go(int x) {
  static const int b[] = { &&one - &&none, &&two - &&none };
  goto *(&&none + b[x]);
one: c += 2;
two: c++;
none:;
}
long bench_run(void) { go(0); if (c != 3) return 1; go(1); return c != 4; })"},
    {"address of the frame and of the return, prefetch", R"(
int x[4];
__attribute__((noinline)) static void *frame(void) { return __builtin_frame_address(0); }
__attribute__((noinline)) static void *from(void) { return __builtin_return_address(0); }
long bench_run(void) { __builtin_prefetch(x, 1, 2); return frame() == 0 || from() == 0; })"},
    {"alloca without a header", R"(
extern void *alloca(unsigned);
__attribute__((noinline)) static int sum(const char *p, int n) { int s = 0; while (n--) s += *p++; return s; }
long bench_run(void) {
  int n, s = 0;
  for (n = 1; n < 20; n++) { char *p = alloca(n); int i; for (i = 0; i < n; i++) p[i] = n; s += sum(p, n); }
  return s != 19 * 20 * 39 / 6;
})"},
    // gcc knows these by itself; as int f() they would take and give the wrong things
    {"functions of the library without their headers", R"(
volatile float two = 2.0f;
volatile int minus = -7;
__attribute__((noinline)) static int same(const char *a, const char *b) { return strcmp(a, b) == 0; }
long bench_run(void) {
  char text[40];
  if (sprintf(text, "%i %ld %s", minus, 70000L, "end") != 12 || !same(text, "-7 70000 end")) return 1;
  if ((int)(1000 * sqrt(two)) != 1414 || pow(two, 3) != 8 || fabs(-two) != 2 || floor(two + 0.5) != 2) return 2;
  if (strlen(text) != 12 || abs(minus) != 7 || labs(-70000L) != 70000L || toupper('a') != 'A') return 3;
  memset(text, 'x', 3);
  return memcmp(text, "xxx70", 5) != 0 && text[0] != 'x';
})"},
    {"functions of the program that are named like the library's", R"(
static int round(int x) { return x + 1; }
long bench_run(void) { return round(3) != 4 || log(5) != 10 || puts(2, 3) != 5; }
int log(int x) { return 2 * x; }
int puts(int a, int b) { return a + b; })"},
    {"an array of variable length makes room, read or not", R"(
static unsigned place;
__attribute__((noinline)) static void here(void) { volatile char c = 0; place = (unsigned)&c + c; }
__attribute__((noinline)) static void beyond(int n) { char pad[n]; pad[n - 1] = 0; here(); place = place; }
long bench_run(void) {
  unsigned near_by;
  beyond(2);
  near_by = place;
  beyond(402);
  return place - near_by != 400;
})"},
    {"structs behind ...", R"(
#include <stdarg.h>
struct three { char c[3]; };
struct large { int v[6]; };
struct pair { long a; char b; };
__attribute__((noinline)) static int sum(int n, ...) {
  va_list list;
  int s;
  va_start(list, n);
  struct large l = va_arg(list, struct large);
  struct large *p = va_arg(list, struct large *);
  s = l.v[5] + p->v[1] + va_arg(list, struct three).c[2];
  struct pair q = va_arg(list, struct pair);
  s += (int)q.a + q.b + va_arg(list, int);
  va_end(list);
  return s + n;
}
struct large l = {{1, 2, 3, 4, 5, 6}};
struct three t = {{7, 8, 9}};
struct pair q = {1000, 20};
long bench_run(void) { return sum(3, l, &l, t, q, 500) != 3 + 6 + 2 + 9 + 1020 + 500; })"},
    {"byte order", R"(
long bench_run(void) {
  long v = 0x01020304;
  return __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__ || *(char *)&v != 4;
})"},
    {"vectors", R"(
typedef unsigned short words __attribute__((vector_size(16)));
typedef int counts __attribute__((vector_size(16)));
words a = {73, 65531, 0, 174, 921, 65535, 17, 178}, r;
counts b = {73, -9123, 32761, 8191, 16371, 1201, 12701, 9999}, q;
__attribute__((noinline)) static void divide(words *x, words *y) { *x = *y / (words){1, 4, 2, 8, 16, 64, 32, 128}; }
__attribute__((noinline)) static void rest(counts *x, counts *y) { *x = *y % (counts){4, 4, 4, 4, 4, 4, 4, 4}; }
long bench_run(void) {
  int i;
  static const int by[] = {1, 4, 2, 8, 16, 64, 32, 128};
  divide(&r, &a);
  rest(&q, &b);
  for (i = 0; i < 8; i++)
    if (((unsigned short *)&r)[i] != ((unsigned short *)&a)[i] / (unsigned)by[i] || ((int *)&q)[i] != ((int *)&b)[i] % 4)
      return i + 1;
  return 0;
})"},
    {"products that overflow", R"(
long a = 70000, b = -70000;
long long c = 5000000000ll, d = -5000000000ll, e = 3;
long bench_run(void) {
  long r;
  long long s;
  if (!__builtin_mul_overflow(a, b, &r) || __builtin_mul_overflow(a, 3l, &r) || r != 210000) return 1;
  if (!__builtin_mul_overflow(c, d, &s) || __builtin_mul_overflow(d, e, &s) || s != -15000000000ll) return 2;
  return 0;
})"},
    {"products of an unsigned and a signed number", R"(
unsigned char a = 4;
unsigned long long r;
long bench_run(void) { return !__builtin_mul_overflow(a, -16, &r) || r != -64ull; })"},
    {"complex quotients", R"(
_Complex float a = 1.0f + 2.0if, b = 3.0f - 4.0if, z;
long bench_run(void) {
  z = a / b;
  if (__real__ z != -0.2f || __imag__ z != 0.4f) return 1;
  z = a * b;
  return __real__ z != 11 || __imag__ z != 2;
})"},
    {"zero keeps its sign", R"(
#include <math.h>
double zero = -0.0;
static int is_negative(double d) { union { float f; unsigned long u; } b; b.f = d; return b.u == 0x80000000ul; }
long bench_run(void) { return !is_negative(sin(zero)) | !is_negative(tan(zero)) << 1 | !is_negative(atan(zero)) << 2; })"},
    {"signals, limits of long double, names of types", R"(
#include <float.h>
#include <signal.h>
#include <sys/types.h>
static int got;
static void take(int number) { got = number; }
long bench_run(void) {
  ssize_t n = -1;
  if (signal(SIGFPE, take) != SIG_DFL || raise(SIGFPE) || got != SIGFPE) return 1;
  signal(SIGTERM, SIG_IGN);
  if (raise(SIGTERM) || n > 0) return 2;
  return 1.0L + LDBL_EPSILON == 1.0L || 1.0L + LDBL_EPSILON / 2 != 1.0L || LDBL_MANT_DIG != 53;
})"},
    {"all of a union is cleared", R"(
union u { char c; long l; };
struct s { int a; union u b; char d; };
static volatile int one = 1;
__attribute__((noinline)) static void dirty(void) { volatile char mud[40]; int i; for (i = 0; i < 40; i++) mud[i] = 0x55; }
__attribute__((noinline)) static long empty(void) { union u x = {}; return x.l; }
__attribute__((noinline)) static long member(void) { struct s x = {1}; return x.b.l; }
long bench_run(void) { dirty(); if (empty()) return 1; dirty(); return member() ? 2 : 0; })"},
    {"the rest of what a value of run time does not fill is cleared", R"(
union u { char c; long l; };
union f { unsigned b : 3; int w[3]; };
struct s { int a; union u b; char d; long e[3]; };
static volatile int n = 0x7E;
__attribute__((noinline)) static void dirty(void) { volatile char mud[60]; int i; for (i = 0; i < 60; i++) mud[i] = 0x55; }
__attribute__((noinline)) static long first(void) { union u x = {n}; return x.l; }
__attribute__((noinline)) static long named(void) { union u x = {.c = n}; return x.l; }
__attribute__((noinline)) static long literal(void) { return ((union u){n}).l; }
__attribute__((noinline)) static int field(void) { union f x = {n}; return x.w[0] == 6 && !x.w[1] && !x.w[2]; }
__attribute__((noinline)) static long within(void) { struct s x = {n, {n}}; return x.b.l ^ x.d ^ x.e[0] ^ x.e[1] ^ x.e[2]; }
__attribute__((noinline)) static long constant_within(void) { struct s x = {n, {5}}; return x.b.l; }
__attribute__((noinline)) static long of_array(void) { union u x[3] = {{1}, {n}}; return x[0].l ^ x[1].l << 8 ^ x[2].l; }
__attribute__((noinline)) static long again(void) {
  long sum = 0;
  int i;
  for (i = 0; i < 2; i++) { union u x = {n}; sum += x.l; x.l = -1; dirty(); }
  return sum;
}
__attribute__((noinline)) static long rest(void) { struct s x = {n}; return x.b.l | x.d | x.e[0] | x.e[1] | x.e[2]; }
__attribute__((noinline)) static long of_words(void) { int x[12] = {n, n}; int i; long s = 0; for (i = 2; i < 12; i++) s |= x[i]; return s; }
long bench_run(void) {
  dirty(); if (first() != 0x7E) return 1;
  dirty(); if (named() != 0x7E) return 2;
  dirty(); if (literal() != 0x7E) return 3;
  dirty(); if (!field()) return 4;
  dirty(); if (within() != 0x7E) return 5;
  dirty(); if (constant_within() != 5) return 6;
  dirty(); if (of_array() != 0x7E01) return 7;
  dirty(); if (again() != 0xFC) return 8;
  dirty(); if (rest() || of_words()) return 9;
  return 0;
})"},
    {"64-bit division", R"(
typedef unsigned long long wide;
static wide s = 88172645463325252ull;
static wide next(void) { s ^= s << 13; s ^= s >> 7; s ^= s << 17; return s; }
volatile wide a = 0xFEDCBA9876543210ull, b = 0x123456789ull;
volatile long long c = -5000000000000ll, d = 7000000ll;
long bench_run(void) {
  int n;
  if (a / b != 3758096384ull || a % b != 2522100240ull) return 1;
  if (c / d != -714285 || c % d != -5000000 || c / -d != 714285 || -c % d != 5000000) return 2;
  for (n = 0; n < 150; n++) {
    const wide x = next() >> (n % 50), y = (next() >> (n * 7 % 60)) | 1;
    const long long i = (long long)next() >> (n % 40), j = ((long long)next() >> (n * 11 % 60)) | 1;
    if (x % y >= y || x / y * y + x % y != x) return 3;
    if (i / j * j + i % j != i || (i % j != 0 && (i % j < 0) != (i < 0))) return 4;
    if ((i % j < 0 ? 0 - (wide)(i % j) : (wide)(i % j)) >= (j < 0 ? 0 - (wide)j : (wide)j)) return 5;
  }
  return 0;
})"},
    {"data EEPROM by libpic30.h", R"(
#include <libpic30.h>
int kept[16] __attribute__((space(eedata))) = {11, 22, 33};
long bench_run(void) {
  _prog_addressT place, end;
  int row[16], back[16], i;
  _init_prog_address(place, kept);
  end = _memcpy_p2d16(back, place, 6);
  if (end != place + 6 || back[0] != 11 || back[2] != 33) return 1;
  for (i = 0; i < 16; i++) row[i] = 1000 + i;
  _erase_eedata(place, _EE_ROW);
  _wait_eedata();
  _write_eedata_row(place, row);
  _wait_eedata();
  _memcpy_p2d16(back, place, 32);
  for (i = 0; i < 16; i++) if (back[i] != 1000 + i) return 2;
  _erase_eedata(place + 4, _EE_WORD);
  _wait_eedata();
  _write_eedata_word(place + 4, -5);
  _wait_eedata();
  _memcpy_p2d16(back, place, 8);
  return back[1] != 1001 || back[2] != -5 || back[3] != 1003;
})"},
    {"comparisons with 0 as values and as branches", R"(
volatile long longs[9] = {-70000, -65536, -65535, -1, 0, 1, 65535, 65536, 70000};
volatile long long wide[9] = {-70000, -65536, -65535, -1, 0, 1, 65535, 65536, 70000};
volatile int ints[9] = {-30000, -256, -255, -1, 0, 1, 255, 256, 30000};
volatile int is;
#define IS(condition, wanted) is = condition; wrong += is != (wanted); is = 0; if (condition) is = 1; wrong += is != (wanted);
#define ALL(x) IS(x > 0, i > 4) IS(x >= 0, i >= 4) IS(x < 0, i < 4) IS(x <= 0, i <= 4) IS(x == 0, i == 4) IS(x != 0, i != 4)
long bench_run(void) {
  int i, wrong = 0;
  for (i = 0; i < 9; i++) {
    ALL(longs[i]) ALL(wide[i]) ALL(ints[i])
    IS(longs[i] > 65535, i > 6) IS(longs[i] < -65535, i < 2) IS((unsigned long)longs[i] > 65536, i > 7 || i < 4)
  }
  return wrong;
})"},
    {"a long in assembler is a pair of registers, wherever it is handed over", R"(
volatile unsigned long num = 100003UL;
volatile long wide = 0x12345678L;
volatile unsigned one = 1;
__attribute__((noinline)) static unsigned high(unsigned long v) { unsigned h; asm("mov %d1, %0" : "=r"(h) : "r"(v)); return h; }
__attribute__((noinline)) static long product(unsigned a, unsigned b) { unsigned long p; asm("mul.uu %1, %2, %0" : "=r"(p) : "r"(a), "r"(b)); return p; }
__attribute__((noinline)) static unsigned long more(unsigned long v) { asm("add %0, #1, %0\n addc %d0, #0, %d0" : "+r"(v)); return v; }
__attribute__((noinline)) static unsigned long swapped(unsigned long v) { unsigned long s; asm("mov %d1, %0\n mov %1, %d0" : "=&r"(s) : "r"(v)); return s; }
long bench_run(void) {
  unsigned long n = num * one, sum;
  unsigned q, m;
  float f = 1.5f * one;
  unsigned f_high;
  asm("repeat #17\n div.ud %2, %3" : "=a"(q), "=b"(m) : "r"(n), "e"(7));
  if (q != 14286 || m != 1) return 1;
  if (high(wide) != 0x1234 || high(wide + wide) != 0x2468) return 2;
  if (product(50000u, 50001u) != 50000UL * 50001UL) return 3;
  if (more(0x1FFFFUL * one) != 0x20000UL) return 4;
  if (swapped(wide) != 0x56781234UL) return 5;
  asm("add %1, %2, %0\n addc %d1, %d2, %d0" : "=&r"(sum) : "r"(n), "r"(wide));
  if (sum != 100003UL + 0x12345678UL) return 6;
  asm("mov %d1, %0" : "=r"(f_high) : "r"(f));
  return f_high != 0x3FC0;
})"},
    {"numbers in assembler, with # and without", R"(
long bench_run(void) {
  int a, b;
  asm("mov #%1, %0" : "=r"(a) : "i"(500));
  asm("mov %1, %0" : "=r"(b) : "i"(-7));
  return a != 500 || b != -7;
})"},
    {"variables that ask for a wider alignment than the stack has", R"(
__attribute__((noinline)) static void set(char *p) { int i; for (i = 0; i < 8; i++) p[i] = i; }
__attribute__((noinline)) static int of_long(void) { long v[2] __attribute__((aligned(4))) = {0}; set((char *)v); return (int)(v[1] >> 16); }
__attribute__((noinline)) static int of_chars(void) {
  char a[24] __attribute__((aligned(8))) = {0};
  int i, sum = 0;
  set(a + 4);
  for (i = 4; i < 12; i++) sum += a[i];
  return sum;
}
__attribute__((noinline)) static int deeper(volatile int odd) { int sum = of_long() == 0x0706 ? of_chars() : 0; return odd ? sum : 0; }
long bench_run(void) { return of_long() != 0x0706 || of_chars() != 28 || deeper(1) != 28; })"},
    {"what the program defines takes the place of the libc's", R"(
#include <stdlib.h>
static int called;
void abort(void) { called++; for (;;) ; }
long labs(long v) { called++; return v; }
long bench_run(void) { return abs(-5) != 5 || labs(-5) != -5 || called != 1; })"},
};

TEST(ChipLanguage, corners_are_right_at_every_level) {
  for (const Corner& corner : kCorners)
    for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
      ChipProgram program("corner", corner.source, level);
      ASSERT_TRUE(program.is_whole()) << corner.name << level << ": " << program.error();
      EXPECT_EQ(program.run(), 0u) << corner.name << " " << level;
    }
}

TEST(ChipLanguage, mistakes_are_named_and_stop_no_compiler) {
  const std::pair<const char*, const char*> cases[] = {
      {"struct big { int i[0x10000]; };\nlong bench_run(void) { struct big b = {}; return b.i[0]; }",
       "main.c:2:20: error: array is too large (65536 elements)"},
      {"long bench_run(void) { int f(int v) { return v; } return f(1); }",
       "main.c:2:37: error: function definition is not allowed here"},
      {"void g(char*);\nlong bench_run(void) { char a[20000]; g(a); return a[0]; }\nvoid g(char* a) { a[1] = "
       "0; }",
       "main.c:3: error: bench_run() needs 20002 bytes of stack, which the chip does not have"},
      {"volatile long long x;\nlong bench_run(void) { int h;\n  asm(\"mov %1, %0\" : \"=r\"(h) : \"r\"(x)); "
       "return h; }",
       "main.c:4: error: bench_run() hands asm an operand of 64 bits, expected at most 32"},
      {"register int kept asm(\"w8\");\nlong bench_run(void) { return kept; }",
       "main.c:3:31: error: got a global variable in a working register, expected one in memory"},
      {"int x;\nlong bench_run(void) { return __sync_bool_compare_and_swap(&x, 1, 2); }",
       "main.c:3:31: error: got an atomic operation that reads and writes, expected a plain one between "
       "__builtin_disi(0x3FFF) and __builtin_disi(0)"}};
  for (const auto& [source, message] : cases) {
    const ChipProgram program("mistake", source, "-O0");
    EXPECT_FALSE(program.is_whole()) << source;
    EXPECT_EQ(program.error(), std::string(message) + "\n");
  }
}

TEST(ChipLanguage, optimiser_says_so_and_only_then) {
  const char* source = R"(
#ifdef __OPTIMIZE__
long bench_run(void) { return 1; }
#else
long bench_run(void) { return 0; }
#endif
)";
  for (const auto& [level, expected] : {std::pair("-O0", 0u), {"-O1", 1u}, {"-Os", 1u}})
    EXPECT_EQ(ChipProgram("level", source, level).run(), expected) << level;
}

}  // namespace
}  // namespace chip_cc
