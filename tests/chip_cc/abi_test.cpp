// SPDX-License-Identifier: MIT
// Structs of 0 to 20 bytes as arguments, results and behind "...", at odd and even addresses. Each function
// mixes what arrived into a sum; the PC's compiler makes the same program, and its sum is the second opinion.
#include <sstream>
#include <string>
#include <vector>

#include "tests/chip_cc/chip_program.h"
#include "tests/chip_cc/random_program.h"

namespace chip_cc {
namespace {

struct Shape {
  std::string members;              // in C
  std::vector<std::string> leaves;  // how each number in it is reached
};

constexpr int kLargest = 20;  // bytes

Shape chars(int bytes) {
  Shape s;
  if (bytes) s.members = "u8 c[" + std::to_string(bytes) + "];";
  for (int i = 0; i < bytes; ++i) s.leaves.push_back("c[" + std::to_string(i) + "]");
  return s;
}

/// Members of these sizes in turn.
Shape members(int bytes, const std::vector<int>& sizes) {
  Shape s;
  for (int i = 0, left = bytes; left > 0; ++i) {
    const int size = std::min(sizes[std::size_t(i) % sizes.size()], left == 3 ? 2 : left);
    const std::string name = "m" + std::to_string(i);
    s.members += (size == 1 ? "u8 " : size == 2 ? "u16 " : "u32 ") + name + "; ";
    s.leaves.push_back(name);
    left -= size;
  }
  return s;
}

Shape nested(int bytes) {
  Shape s = chars(bytes ? bytes - 1 : 0), made;
  made.members = bytes ? "u8 k; struct { " + s.members + " } in;" : "struct { } in;";
  if (bytes) made.leaves.push_back("k");
  for (const std::string& leaf : s.leaves) made.leaves.push_back("in." + leaf);
  return made;
}

/// An array of structs of three bytes, and the rest.
Shape of_odd_elements(int bytes) {
  Shape made;
  if (bytes >= 3) made.members = "struct { u8 c[3]; } a[" + std::to_string(bytes / 3) + "]; ";
  for (int i = 0; i < bytes / 3 * 3; ++i)
    made.leaves.push_back("a[" + std::to_string(i / 3) + "].c[" + std::to_string(i % 3) + "]");
  if (bytes % 3) made.members += "u8 r[" + std::to_string(bytes % 3) + "];";
  for (int i = 0; i < bytes % 3; ++i) made.leaves.push_back("r[" + std::to_string(i) + "]");
  return made;
}

constexpr const char* kHead = R"(
#include <stdarg.h>
#ifdef __C30__
typedef unsigned char u8; typedef unsigned u16; typedef unsigned long u32;
#else
#include <stdint.h>
typedef uint8_t u8; typedef uint16_t u16; typedef uint32_t u32;
#endif
#define ALONE __attribute__((noinline))
static u16 mix(u16 h, u16 v) { return (u16)(h * 31u + v); }
u32 all = 1;
ALONE void add(u16 v) { all = all * 33u + v; }
)";

/// All that is done with one struct, as run_N().
std::string program_of(const std::string& n, const Shape& shape) {
  std::string sum, set;
  int i = 0;
  for (const std::string& leaf : shape.leaves) {
    sum += "h = mix(h, (u16)s." + leaf + "); ";
    set += "p->" + leaf + " = (u8)(seed * 7 + " + std::to_string(13 * ++i) + "); ";
  }
  std::string text = R"(
struct S { MEMBERS };
struct W { u8 odd; struct S s; struct S more[2]; u8 end; } w;
ALONE void set(struct S *p, u16 seed) { SET }
ALONE u16 first(struct S s, u16 z) { u16 h = 3; SUM return mix(h, z); }
ALONE u16 behind(u16 a, u32 b, struct S s, u8 z) { u16 h = mix(a, (u16)b); SUM return mix(h, z); }
ALONE u16 far(u32 a, u32 b, u32 c, struct S s, u16 z) { u16 h = mix((u16)a, (u16)(b + c)); SUM return mix(h, z); }
ALONE u16 two(struct S t, struct S s) { u16 h = 5; SUM s = t; SUM return h; }
ALONE u16 list(int n, ...) {
  u16 h = 7; va_list ap;
  va_start(ap, n);
  while (n--) { struct S s = va_arg(ap, struct S); SUM h = mix(h, (u16)va_arg(ap, int)); }
  va_end(ap);
  return h;
}
ALONE struct S give(const struct S *p) { return *p; }
ALONE struct S pass(struct S s) { return s; }
ALONE u16 own(struct S s) { struct S *p = &s; set(p, 50); return first(*p, 1); }
ALONE void run(struct S *p) {
  set(&w.s, 1); set(&w.more[0], 2); set(&w.more[1], 3);
  w.odd = 17; w.end = 19;
  add(first(w.s, 7)); add(first(*p, 8)); add(first(p[1], 9));
  add(behind(1, 2, w.more[1], 3)); add(far(1, 2, 3, w.more[0], 4)); add(two(w.s, w.more[0]));
  add(list(2, w.s, 5, p[1], 6)); add(list(3, *p, 1, w.more[1], 2, w.s, 3));
  add(first(give(p + 1), 1)); add(first(pass(w.s), 2)); add(own(w.s)); add(first(w.s, 7));
  w.more[0] = w.s; p[1] = pass(*p);
  { struct S local = p[1]; add(first(local, 1)); add(list(1, local, 2)); }
  add(w.odd); add(w.end);
}
)";
  const auto replace = [&text](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  };
  replace("MEMBERS", shape.members);
  replace("SUM", sum);
  replace("SET", set);
  std::string renamed;
  for (const char* name :
       {"S", "W", "w", "set", "first", "behind", "far", "two", "list", "give", "pass", "own", "run"})
    renamed += "#define " + std::string(name) + " " + name + "_" + n + "\n";
  for (const char* name :
       {"S", "W", "w", "set", "first", "behind", "far", "two", "list", "give", "pass", "own", "run"})
    text += "#undef " + std::string(name) + "\n";
  return renamed + text;
}

TEST(ChipAbi, structs_of_0_to_20_bytes_arrive_whole) {
  using Make = Shape (*)(int);
  const std::pair<const char*, Make> kShapes[] = {{"chars", chars},
                                                  {"chars and ints",
                                                   [](int n) {
                                                     return members(n, {1, 2});
                                                   }},
                                                  {"longs and chars",
                                                   [](int n) {
                                                     return members(n, {4, 1});
                                                   }},
                                                  {"ints", [](int n) { return members(n, {2}); }},
                                                  {"a struct within", nested},
                                                  {"an array of odd structs", of_odd_elements}};
  int number = 0;
  for (const auto& [what, make] : kShapes) {
    std::string source = kHead, calls;
    for (int bytes = 0; bytes <= kLargest; ++bytes) {
      const std::string n = std::to_string(bytes);
      source += program_of(n, make(bytes));
      calls += "run_" + n + "(w_" + n + ".more); ";
    }
    source += "\nlong bench_run(void) { " + calls + " return (long)all; }\n";
    const std::uint32_t expected = result_on_pc(source);
    ASSERT_NE(expected, 0xDEAD0000u) << what;
    // two levels each, all of them twice or more
    const std::vector<const char*> levels =
        number++ % 2 ? std::vector<const char*>{"-O1", "-Os"} : std::vector<const char*>{"-O0", "-O2"};
    for (const char* level : levels) {
      ChipProgram program("abi", source, level);
      ASSERT_TRUE(program.is_whole()) << what << level << program.error();
      if (program.run() == expected) continue;
      // which of them
      for (int bytes = 0; bytes <= kLargest; ++bytes) {
        const std::string n = std::to_string(bytes);
        const std::string alone = kHead + program_of(n, make(bytes)) + "\nlong bench_run(void) { run_" + n +
                                  "(w_" + n + ".more); return (long)all; }\n";
        ChipProgram one("abi", alone, level);
        ASSERT_TRUE(one.is_whole()) << what << level << one.error();
        EXPECT_EQ(one.run(), result_on_pc(alone)) << what << ", " << bytes << " bytes, " << level;
      }
      ADD_FAILURE() << what << level;
    }
  }
}

// the addresses that program memory has for what lies behind a variable's beginning
TEST(ChipAbi, addresses_in_program_memory_keep_what_is_added) {
  const std::string source = R"(
    #include <p30F6014A.h>
    const int __attribute__((space(psv))) table[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    struct { int a, b[3]; } const s = {1, {2, 3, 4}};
    int ram[8];
    long bench_run(void) {
      unsigned wrong = 0, w;
      wrong |= __builtin_tbloffset(&table[1]) - __builtin_tbloffset(table) != 2;
      wrong |= (__builtin_tbloffset(&table[7] - 2) - __builtin_tbloffset(table) != 10) << 1;
      wrong |= (__builtin_psvoffset(&table[3]) - __builtin_psvoffset(table) != 6) << 2;
      wrong |= (__builtin_psvoffset(&s.b[2]) - __builtin_psvoffset(&s) != 6) << 3;
      wrong |= (__builtin_tblpage(&table[1]) != __builtin_tblpage(table)) << 4;
      wrong |= (__builtin_psvpage(&table[1]) != __builtin_psvpage(table)) << 5;
      wrong |= (__builtin_tbladdress(&table[4]) - __builtin_tbladdress(table) != 8) << 6;
      TBLPAG = __builtin_tblpage(&table[5]);
      wrong |= (__builtin_tblrdl(__builtin_tbloffset(&table[5])) != 6) << 7;
      __asm__("mov #%1, %0" : "=r"(w) : "i"(&ram[3]));
      wrong |= (w != (unsigned)&ram[3]) << 8;
      return wrong;
    })";
  for (const char* level : {"-O0", "-O1", "-Os"}) {
    ChipProgram program("offsets", source, level);
    ASSERT_TRUE(program.is_whole()) << program.error();
    EXPECT_EQ(program.run(), 0u) << level;
  }
}

// as XC16's __fixunssfsi: what is negative wraps
TEST(ChipAbi, negative_floats_become_unsigned_as_with_xc16) {
  const std::string source = R"(
    volatile float f = -1.0f, g = -40000.0f, h = 60000.0f, k = 3e9f, z = -0.25f;
    long bench_run(void) {
      unsigned wrong = 0;
      wrong |= (unsigned)f != 0xFFFF;
      wrong |= ((unsigned)g != (unsigned)-40000L) << 1;
      wrong |= ((unsigned)h != 60000u) << 2;
      wrong |= ((unsigned long)f != 0xFFFFFFFFul) << 3;
      wrong |= ((unsigned long)k != 3000000000ul) << 4;
      wrong |= ((unsigned char)f != 0xFF) << 5;
      wrong |= ((unsigned long long)f != 0xFFFFFFFFFFFFFFFFull) << 6;
      wrong |= ((unsigned)z != 0) << 7;
      wrong |= ((unsigned)(f * 2 - 1) != 0xFFFD) << 8;
      return wrong;
    })";
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
    ChipProgram program("unsigned", source, level);
    ASSERT_TRUE(program.is_whole()) << program.error();
    EXPECT_EQ(program.run(), 0u) << level;
  }
}

// two MOV, REPEAT, a cycle a word, RETURN: XC16 takes 16 cycles for 12 bytes
TEST(ChipAbi, structs_are_copied_a_word_a_cycle) {
  for (const auto& [bytes, cycles] : {std::pair(12, 12), {40, 26}, {13, 17}})
    for (const char* level : {"-O1", "-O2", "-Os"}) {
      const std::string n = std::to_string(bytes / 2);
      ChipProgram program("copy",
                          "struct S { int a[" + n + "]; " + (bytes % 2 ? "char c; " : "") + "} s, t;\n" +
                              "__attribute__((noinline)) void copy(void) { s = t; }\n"
                              "long bench_run(void) { int i; for (i = 0; i < " +
                              n +
                              "; ++i) t.a[i] = i * 3; copy();\n"
                              "  for (i = 0; i < " +
                              n + "; ++i) if (s.a[i] != i * 3) return 0; return 1; }",
                          level);
      ASSERT_TRUE(program.is_whole()) << program.error();
      dspic::Cycle own = 0;
      EXPECT_EQ(program.run_counting("copy", own), 1u);
      EXPECT_LE(own, dspic::Cycle(cycles)) << bytes << level;
    }
}

// a comparison with an element stays a look-up: tests of the index in its place took 358 cycles for 199
TEST(ChipAbi, look_ups_in_tables_stay_look_ups) {
  const std::string source = R"(
    const unsigned char kinds[16] = {0, 1, 0, 2, 1, 1, 0, 3, 1, 0, 2, 1, 0, 1, 1, 2};
    __attribute__((noinline)) int count(const unsigned char *p, int n) {
      int k, ones = 0;
      for (k = 0; k < n; k++) if (kinds[p[k] & 15] == 1) ones++;
      return ones;
    }
    unsigned char text[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0};
    long bench_run(void) { return count(text, 16); })";
  ChipProgram program("table", source);
  ASSERT_TRUE(program.is_whole()) << program.error();
  dspic::Cycle own = 0;
  EXPECT_EQ(program.run_counting("count", own), 7u);
  EXPECT_LE(own, 16u * 14u);
}

}  // namespace
}  // namespace chip_cc
