// SPDX-License-Identifier: MIT
// Arguments and results arrive whole; the PC's compiler makes the same programs, and its sum is the second
// opinion (abi_program.h).
#include <string>
#include <utility>
#include <vector>

#include "tests/chip_cc/abi_program.h"
#include "tests/chip_cc/chip_program.h"
#include "tests/chip_cc/random_program.h"

namespace chip_cc {
namespace {

/// Each case of it alone, to tell which of them is wrong.
void expect_each_agrees(const AbiProgram& all, const char* level) {
  for (std::size_t i = 0; i < all.parts.size(); ++i) {
    ChipProgram one("abi", all.source_of(i), level);
    ASSERT_TRUE(one.is_whole()) << all.names[i] << level << one.error();
    EXPECT_EQ(one.run(), result_on_pc(all.source_of(i))) << all.names[i] << ", " << level;
  }
}

void expect_agrees_with_pc(const AbiProgram& all, const char* level) {
  const std::uint32_t expected = result_on_pc(all.source());
  ASSERT_NE(expected, 0xDEAD0000u) << all.what;
  ChipProgram program("abi", all.source(), level);
  ASSERT_TRUE(program.is_whole()) << all.what << level << program.error();
  if (program.run() == expected) return;
  expect_each_agrees(all, level);
  ADD_FAILURE() << all.what << level;
}

constexpr const char* kLevelsInTurn[] = {"-O0", "-O1", "-Os", "-O2"};

// every second one, at a level each: `make second` asks avr-gcc about all of them
TEST(ChipAbi, structs_of_0_to_20_bytes_arrive_whole) {
  const std::vector<AbiProgram> all = abi_programs_by_shape();
  for (std::size_t i = 0; i < all.size(); i += 2) expect_agrees_with_pc(all[i], kLevelsInTurn[i / 2 % 4]);
}

TEST(ChipAbi, signatures_by_chance_agree_with_the_pc) {
  constexpr int kTogether = 8;
  for (std::uint32_t i = 0; i < 4; ++i)
    expect_agrees_with_pc(abi_program_by_chance(1 + i * kTogether, kTogether), kLevelsInTurn[i]);
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
