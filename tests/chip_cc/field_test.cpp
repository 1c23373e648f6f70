// SPDX-License-Identifier: MIT
// Bit-fields wider than int compute in their own width, as gcc's do.
#include <filesystem>
#include <fstream>
#include <random>

#include "compiler/cache/object_cache.h"
#include "tests/chip_cc/chip_program.h"
#include "tests/support/wording.h"

namespace chip_cc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFields = R"(
struct { unsigned long u20 : 20; long s20 : 20; unsigned u3 : 3; unsigned long long u40 : 40, v20 : 20; long long s32 : 32; } x;
volatile long minus3 = -3;
volatile int minus1 = -1;
)";

TEST(ChipFields, keep_their_width_in_every_operation) {
  const char* source = R"(
static int wide(unsigned long v, int n, int (*f)(int)) { return v == 0xFFFFFul && n == 7; }
long bench_run(void) {
  int i = -1;
  x.u20 = 0xFFFFF; x.s20 = 0x7FFFF; x.u40 = 0xFFFFFFFFFFull; x.v20 = 3; x.s32 = 0x7FFFFFFF; x.u3 = 2;
  if (x.u20 + 1 != 0 || x.u20 * x.u20 != 1 || -x.u20 != 1 || ~x.u20 != 0) return 1;
  if (x.s20 + 1 != -524288 || (x.s20 << 1) != -2) return 2;             /* -2^19; 0xFFFFE of 20 bits */
  if ((x.u20 << 4) != 0xFFFF0 || (x.u20 << 4) >> 8 != 0xFFF) return 3;
  if (x.u20 + 1l != 0x100000l || x.u20 < -1l) return 4;                 /* a long is wider, and signed */
  if (x.u20 / minus3 != -349525 || x.u20 % minus3 != 0) return 5;       /* 1048575 / -3 */
  if (x.u20 != minus1 || x.u20 - minus1 != 0) return 6;                 /* -1 has 20 bits there */
  if (x.u20 + x.s20 != 0x7FFFE) return 7;
  if ((long long)(x.v20 - 4l) != -1 || (float)(x.v20 - 4l) != -1.0f) return 8;
  if (x.v20 - 4 != 0xFFFFFul || x.s32 + 1 != -2147483647 - 1) return 9;
  if ((x.u40 + 1) != 0 || (long long)(x.u40 * x.u40) != 1) return 10;
  if ((i ? x.u20 : 0) + 1 != 0 || (x.u20 ?: 0) + 1 != 0 || (0, x.u20) + 1 != 0 || ({ x.u20; }) + 1 != 0) return 11;
  if (x.u20++ + 1 != 0 || x.u20 != 0 || --x.u20 + 1 != 0 || (x.u20 += 1) - 1 != 0xFFFFF) return 12;
  if ((minus1 ?: x.u20) != 0xFFFFF) return 17;
  x.u20 = 0xABCDE; i /= x.u20; if (i != 1) return 13;                   /* 0xFFFFF / 0xABCDE */
  x.u20 = 0xABCDE; x.u20 /= minus3; if (x.u20 != (-234570l & 0xFFFFF)) return 14;    /* 703710 / -3 */
  x.u20 = 0xFFFFF;
  switch (x.u20) { case -1: break; default: return 15; }
  if (x.u3++ - 5 >= 0 || ({ x.u3; }) - 5 >= 0) return 16;               /* narrow ones are int */
  return 0;
})";
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
    ChipProgram program("fields", std::string(kFields) + source, level);
    ASSERT_TRUE(program.is_whole()) << level << program.error();
    EXPECT_EQ(program.run(), 0u) << level;
  }
}

// Nobody says the type of an argument behind "...": it travels in the next whole type, two words here.
TEST(ChipFields, travel_behind_dots_in_their_own_width) {
  const char* source = R"(
#include <stdarg.h>
__attribute__((noinline)) static long sum(int n, ...) {
  va_list list;
  va_start(list, n);
  const long v = va_arg(list, long);
  const int after = va_arg(list, int);
  va_end(list);
  return n + v + after;
}
long bench_run(void) { x.v20 = 70000; return sum(1, x.v20, 500); })";
  ChipProgram program("dots", std::string(kFields) + source);
  ASSERT_TRUE(program.is_whole()) << program.error();
  EXPECT_EQ(program.run(), 70501u);
}

TEST(ChipFields, labels_that_become_one_are_refused) {
  const char* source = R"(
long bench_run(void) { switch (x.u20) { case -1: return 1; case 0xFFFFFFFFul: return 2; case 0xFFFFF: return 3; } return 0; })";
  ChipProgram program("labels", std::string(kFields) + source);
  EXPECT_TRUE(wording::reads(program.error(),
                             "main.c:7:65: error: duplicate case value "
                             "'4294967295'\nmain.c:7:46: note: previous case defined here"));
}

// --- made up by chance, beside the PC's gcc: fields of 33 to 63 bits mean the same to an int of 16 bits and
// to one of 32

constexpr const char* kWide = R"(
#ifdef __TWINPUCK__
typedef long i32; typedef unsigned long u32;
#else
typedef int i32; typedef unsigned u32;
#endif
typedef long long i64; typedef unsigned long long u64;
struct fields { u64 a : 33; i64 b : 33; u64 c : 40; i64 d : 40; u64 e : 47; i64 f : 52; u64 g : 63; i64 h : 63; } x, y;
i32 l; u32 ul; i64 q; u64 uq; short s; unsigned short us;
static u64 seed, sum;
static u64 next(void) { seed = seed * 6364136223846793005ull + 1442695040888963407ull; return seed ^ seed >> 29; }
static void keep(u64 v) { sum = (sum ^ v) * 1099511628211ull; sum ^= sum >> 31; }
static void fill(void) {
  x.a = next(); x.b = next(); x.c = next() >> 30; x.d = next(); x.e = next(); x.f = next(); x.g = next(); x.h = next();
  y = x; l = next(); ul = next(); q = next(); uq = next(); s = next(); us = next();
}
)";

/// Expressions and the least width they are computed in: 16 (differs between chip and PC), 32 or more.
class FieldPrograms {
 public:
  explicit FieldPrograms(std::uint32_t seed) : random_(seed) {}
  std::string program() {
    std::string text = kWide;
    text += "long bench_run(void) {\n  int n;\n  seed = " + std::to_string(random_()) +
            ";\n  for (n = 0; n < 8; n++) {\n    fill();\n";
    for (int i = 0; i < kStatements; ++i) text += "    " + statement() + "\n";
    return text + "  }\n  return (i32)(sum ^ sum >> 32);\n}\n";
  }

 private:
  static constexpr int kStatements = 12;
  struct Made {
    std::string text;
    int width;
  };
  int below(int n) { return int(random_() % unsigned(n)); }
  std::string field() { return std::string(".") + "abcdefgh"[below(8)]; }
  Made leaf() {
    static const Made plain[] = {{"l", 32},  {"ul", 32}, {"q", 64},    {"uq", 64},    {"s", 16},
                                 {"us", 16}, {"5", 16},  {"(-7)", 16}, {"(u32)3", 32}};
    return below(5) < 3 ? Made{"x" + field(), 64} : plain[below(9)];
  }
  Made wide_expression(int depth) {
    for (;;)
      if (Made e = expression(depth); e.width > 16) return e;
  }
  Made expression(int depth) {
    if (depth == 0) return leaf();
    const Made a = wide_expression(depth - 1);
    const Made b = expression(depth - 1);
    const int width = std::max(a.width, b.width);
    switch (below(12)) {
      case 0:
        return {"(" + a.text + " / ((" + b.text + " & 255) | 1))", width};
      case 1:  // of 16 bits, a divisor would wrap on the chip
        return {"(" + a.text + " % ((" + wide_expression(depth - 1).text + " & 255) - 300))", 64};
      case 2:
        return {"(" + a.text + (below(2) ? " << " : " >> ") + std::to_string(below(32)) + ")", a.width};
      case 3:
        return {std::string("(") + "-~+"[below(3)] + "(" + a.text + "))", a.width};
      case 4: {
        static const char* const ops[] = {"<", ">", "<=", ">=", "==", "!="};
        return {"(" + a.text + " " + ops[below(6)] + " " + b.text + ")", 16};
      }
      case 5:
        return {"(" + expression(depth - 1).text + " ? " + a.text + " : " + b.text + ")", width};
      case 6: {
        static const char* const types[] = {"i32", "u32", "i64", "u64"};
        const int t = below(4);
        return {std::string("(") + types[t] + ")(" + a.text + ")", t < 2 ? 32 : 64};
      }
      case 7:
        return {"(" + a.text + " ?: " + b.text + ")", width};
      default: {
        static const char* const ops[] = {"+", "-", "*", "&", "|", "^"};
        return {"(" + a.text + " " + ops[below(6)] + " " + b.text + ")", width};
      }
    }
  }
  std::string statement() {
    static const char* const ops[] = {"=", "+=", "-=", "*=", "&=", "|=", "^="};
    const std::string target = below(3) ? "y" + field() : below(2) ? "q" : "ul";
    switch (below(4)) {
      case 0:
        return "keep(((" + target + " " + ops[below(7)] + " " + wide_expression(2).text + ") + 1) * 3);";
      case 1:
        return target + (below(2) ? " /= " : " %= ") + "((" + wide_expression(1).text +
               " & 255) - 300); keep(" + target + ");";
      case 2:
        return "keep((" + std::string(below(2) ? "++" : "--") + "y" + field() + ") * 5 >> 3); keep(y" +
               field() + "++ + 1);";
      default:
        return "keep(" + wide_expression(3).text + ");";
    }
  }
  std::mt19937 random_;
};

std::uint32_t result_with_gcc(const std::string& source) {
  const fs::path folder = fs::temp_directory_path() / ("twinpuck-fields-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "x.c")
      << source << "#include <stdio.h>\nint main(void) { printf(\"%lx\", bench_run() & 0xFFFFFFFFL); }\n";
  const auto compiled = cc::run_process(
      {"gcc", "-w", "-std=gnu99", "-fwrapv", (folder / "x.c").string(), "-o", (folder / "x").string()});
  const auto run = cc::run_process({(folder / "x").string()});
  fs::remove_all(folder);
  EXPECT_EQ(compiled.status, 0) << compiled.output << source;
  EXPECT_EQ(run.status, 0) << source;
  return compiled.status || run.status ? 0xDEAD0000u : std::uint32_t(std::stoul(run.output, nullptr, 16));
}

TEST(ChipFields, random_expressions_agree_with_gcc) {
  int first = 1, count = 6;
  if (const char* wish = std::getenv("TWINPUCK_RANDOM_PROGRAMS")) {
    ASSERT_EQ(std::sscanf(wish, "%d %d", &first, &count), 2) << wish;
  }
  for (int seed = first; seed < first + count; ++seed) {
    const std::string source = FieldPrograms(std::uint32_t(seed)).program();
    const std::uint32_t expected = result_with_gcc(source);
    for (const char* level : {"-O0", "-O1"}) {
      ChipProgram program("field" + std::to_string(seed), source, level);
      ASSERT_TRUE(program.is_whole()) << seed << program.error();
      EXPECT_EQ(program.run(), expected) << "seed " << seed << " " << level << source;
    }
  }
}

}  // namespace
}  // namespace chip_cc
