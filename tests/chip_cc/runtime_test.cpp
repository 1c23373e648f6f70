// SPDX-License-Identifier: MIT
// The runtime against the PC: the same operands, the same bits. Programs read pairs from an array that the
// test fills.
#include <cstring>
#include <random>

#include "tests/chip_cc/chip_program.h"
#include "tests/support/wording.h"

namespace chip_cc {
namespace {

constexpr int kPairs = 60, kRounds = 25;
constexpr dspic::Cycle kStartUp = 20000;  // until main() waits for operands

/// Operands that matter: special ones, near ones, and any.
template <class Bits>
class Operands {
 public:
  explicit Operands(std::vector<Bits> telling) : telling_(std::move(telling)) {}
  Bits next() {
    const auto any = static_cast<Bits>(std::uint64_t{random_()} << 32 | random_());
    switch (random_() % 3) {
      case 0:
        return telling_[random_() % telling_.size()];
      case 1:
        return last_ = static_cast<Bits>(last_ ^ (any & 0xF));
      default:
        return last_ = any;
    }
  }

 private:
  std::mt19937 random_{1};
  std::vector<Bits> telling_;
  Bits last_ = 1;
};

float as_float(std::uint32_t u) {
  float f;
  std::memcpy(&f, &u, sizeof f);
  return f;
}
std::uint32_t bits_of(float f) {
  std::uint32_t u;
  std::memcpy(&u, &f, sizeof u);
  return u;
}
bool is_nan(std::uint32_t u) { return (u & 0x7FFFFFFF) > 0x7F800000; }

constexpr const char* kPairsHead = R"(
#define PAIRS 60
typedef union { unsigned long u; float f; long i; } word;
word a[PAIRS], b[PAIRS], r[PAIRS];
volatile int go, finished, stop;
)";

void compare_words(const std::string& operation, std::vector<std::uint32_t> telling,
                   const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& on_pc, bool of_floats) {
  const std::string source =
      std::string(kPairsHead) +
      "long bench_run(void) { int n; for (; !stop;) { while (!go) ; go = 0; for (n = 0; n < "
      "PAIRS; n++) { " +
      operation + " } finished = 1; } return 0; }\n";
  ChipProgram program("runtime", source);
  ASSERT_TRUE(program.is_whole()) << program.error();
  Operands<std::uint32_t> operands(std::move(telling));
  const unsigned a = program.address_of("a"),
                 b = program.file().objects.count("b") ? program.address_of("b") : 0,
                 r = program.address_of("r");
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    if (round == 0) program.run_for(kStartUp);
    for (int n = 0; n < kPairs; ++n) {
      pairs.emplace_back(operands.next(), operands.next());
      program.poke(a + 4 * unsigned(n), pairs.back().first, 4);
      if (b) program.poke(b + 4 * unsigned(n), pairs.back().second, 4);
    }
    program.poke(program.address_of("finished"), 0, 2);
    program.poke(program.address_of("go"), 1, 2);
    program.run_until("finished");
    for (int n = 0; n < kPairs; ++n) {
      const auto got = static_cast<std::uint32_t>(program.peek(r + 4 * unsigned(n), 4));
      const std::uint32_t expected = on_pc(pairs[n].first, pairs[n].second);
      if (of_floats && is_nan(expected) && is_nan(got)) continue;
      ASSERT_EQ(got, expected) << operation << std::hex << " of " << pairs[n].first << " and "
                               << pairs[n].second;
    }
  }
}

const std::vector<std::uint32_t> kFloats = {0,          0x80000000, 0x3F800000, 0xBF800000, 1,
                                            0x007FFFFF, 0x00800000, 0x7F7FFFFF, 0x7F800000, 0xFF800000,
                                            0x7FC00000, 0x4B800000, 0x33800000, 0x34000001, 0x80000001,
                                            0x3F7FFFFF, 0x40490FDB, 0x00FFFFFF};
const std::vector<std::uint32_t> kLongs = {0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 1,          10,      0x10000,
                                           0xFFFF,     0x10001,    0x8000,     0xFFFF0000, 1000000, 3};

TEST(ChipRuntime, float_arithmetic_has_the_pcs_bits) {
  compare_words(
      "r[n].f = a[n].f + b[n].f;", kFloats, [](auto x, auto y) { return bits_of(as_float(x) + as_float(y)); },
      true);
  compare_words(
      "r[n].f = a[n].f - b[n].f;", kFloats, [](auto x, auto y) { return bits_of(as_float(x) - as_float(y)); },
      true);
  compare_words(
      "r[n].f = a[n].f * b[n].f;", kFloats, [](auto x, auto y) { return bits_of(as_float(x) * as_float(y)); },
      true);
  compare_words(
      "r[n].f = a[n].f / b[n].f;", kFloats, [](auto x, auto y) { return bits_of(as_float(x) / as_float(y)); },
      true);
}

TEST(ChipRuntime, floats_compare_as_on_the_pc) {
  compare_words(
      "r[n].u = (a[n].f < b[n].f) | (a[n].f <= b[n].f) << 1 | (a[n].f > b[n].f) << 2 | (a[n].f >= b[n].f) << "
      "3 | "
      "(a[n].f == b[n].f) << 4 | (a[n].f != b[n].f) << 5;",
      kFloats,
      [](auto x, auto y) {
        const float a = as_float(x), b = as_float(y);
        return std::uint32_t((a < b) | (a <= b) << 1 | (a > b) << 2 | (a >= b) << 3 | (a == b) << 4 |
                             (a != b) << 5);
      },
      false);
}

TEST(ChipRuntime, longs_become_floats_and_back) {
  compare_words(
      "r[n].f = (float)a[n].i;", kLongs, [](auto x, auto) { return bits_of(float(std::int32_t(x))); }, true);
  compare_words(
      "r[n].f = (float)a[n].u;", kLongs, [](auto x, auto) { return bits_of(float(x)); }, true);
  // back: only what fits, the rest is undefined in C
  compare_words(
      "r[n].i = a[n].f < 2147483520.0f && a[n].f > -2147483520.0f ? (long)a[n].f : 0;", kFloats,
      [](auto x, auto) {
        const float f = as_float(x);
        return f < 2147483520.0f && f > -2147483520.0f ? std::uint32_t(std::int32_t(f)) : 0u;
      },
      false);
}

TEST(ChipRuntime, longs_divide_as_on_the_pc) {
  const auto safe = [](std::uint32_t y) { return y ? y : 7u; };
  compare_words(
      "r[n].u = a[n].u / (b[n].u ? b[n].u : 7);", kLongs, [&](auto x, auto y) { return x / safe(y); }, false);
  compare_words(
      "r[n].u = a[n].u % (b[n].u ? b[n].u : 7);", kLongs, [&](auto x, auto y) { return x % safe(y); }, false);
  const auto wide = [&](std::uint32_t v) { return std::int64_t(std::int32_t(v)); };
  compare_words(
      "r[n].i = a[n].i / (b[n].i ? b[n].i : 7);", kLongs,
      [&](auto x, auto y) { return std::uint32_t(wide(x) / wide(safe(y))); }, false);
  compare_words(
      "r[n].i = a[n].i % (b[n].i ? b[n].i : 7);", kLongs,
      [&](auto x, auto y) { return std::uint32_t(wide(x) % wide(safe(y))); }, false);
}

// bars: what the vendor publishes of its own
TEST(ChipRuntime, float_operations_take_no_longer_than_measured) {
  struct {
    const char* operation;
    double most;
  } const rows[] = {{"a + b", 122}, {"a - b", 124}, {"a * b", 109}, {"a / b", 361}};
  for (const auto& row : rows) {
    constexpr int kCalls = 12;
    ChipProgram program(
        "float_cycles",
        "static const float x[] = {1.5f, -2.25f, 1000.1f, 3e-5f, 7.0f, 123456.7f, -0.1f, 9.9f, 2.0f, 1e10f, "
        "0.333f, 65.0f, 1.0f};\n"
        "__attribute__((noinline)) float operate(float a, float b) { return " +
            std::string(row.operation) +
            "; }\nlong bench_run(void) { float s = 0; int i; for (i = 0; i < 12; i++) s += "
            "operate(x[i], x[i + 1]) > 1; return (long)s; }\n");
    ASSERT_TRUE(program.is_whole()) << program.error();
    dspic::Cycle cycles = 0;
    program.run_counting("operate", cycles, true);
    std::printf("%s: %.0f cycles on average\n", row.operation, double(cycles) / kCalls);
    EXPECT_LT(double(cycles) / kCalls, row.most) << row.operation;
  }
}

TEST(ChipRuntime, libc_prints_copies_and_jumps) {
  const char* source = R"(
#include <stdio.h>
#include <string.h>
#include <stdlib.h>
#include <setjmp.h>
#include <math.h>
char text[80];
static jmp_buf back;
static int depth;
static void down(int n) { depth = n; if (n == 5) longjmp(back, 42); down(n + 1); }
long bench_run(void) {
  char *p = malloc(10);
  int code = setjmp(back);
  if (!code) down(0);
  strcpy(p, "robot");
  sprintf(text, "%d %ld %s %5.2f %x %c|%-4d|%04u %.3f", -7, 100000L, p, 3.14159, 0xBEEF, 'z', 12, 34u, sqrt(2.0));
  free(p);
  return strcmp(text, "-7 100000 robot  3.14 beef z|12  |0034 1.414") == 0 && code == 42 && depth == 5;
})";
  for (const char* level : {"-O0", "-O1", "-Os"}) {
    ChipProgram program("libc", source, level);
    ASSERT_TRUE(program.is_whole()) << program.error();
    EXPECT_EQ(program.run(), 1u) << level;
  }
}

TEST(ChipRuntime, linker_names_what_is_too_large_and_what_is_missing) {
  const ChipProgram large("large",
                          "char small[100], table[6000], picture[4000];\n"
                          "long bench_run(void) { return small[1] + table[2] + picture[3]; }\n");
  EXPECT_TRUE(wording::reads(large.error(),
                             "link: error: RAM: no room for table, 6000 bytes in 0x0800 to 0x27FF; largest: "
                             "table 6000, picture 4000, small 100, bench_result 4, bench_done 2"));
  const ChipProgram missing("missing",
                            "extern int nowhere(void); long bench_run(void) { return nowhere(); }\n");
  EXPECT_TRUE(
      wording::reads(missing.error(),
                     "main.c:2: error: bench_run() calls nowhere(): got no definition, expected one in the "
                     "program or the library; is a .c file missing from the folder, or the name misspelt?"));
}

}  // namespace
}  // namespace chip_cc
