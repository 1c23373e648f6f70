// SPDX-License-Identifier: MIT
// `make second`: avr-gcc on simavr makes the same programs of arguments and results. As on the chip an int
// has 16 bits, a long 32 and a double 32, so sizes and conversions count too, which the PC cannot judge.
// TWINPUCK_SIGNATURES="5000 1000" tries so many signatures, from that seed on.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/chip_cc/abi_program.h"
#include "tests/chip_cc/chip_program.h"

namespace chip_cc {
namespace {

std::uint32_t expected_of(const std::string& source) {
  std::string error;
  const std::uint32_t expected = result_on_avr(source, error);
  EXPECT_EQ(error, "");
  return expected;
}

/// At the usual level and, in turn, at one of the others.
void expect_second_opinion(const AbiProgram& all) {
  static int number = 0;
  const int turn = (number + number / 3) % 3;  // what comes in threes meets all
  ++number;
  const std::uint32_t expected = expected_of(all.source());
  constexpr const char* kOthers[] = {"-O0", "-Os", "-O2"};
  for (const char* level : {"-O1", kOthers[turn]}) {
    ChipProgram program("abi", all.source(), level);
    ASSERT_TRUE(program.is_whole()) << all.what << level << program.error();
    if (program.run() == expected) continue;
    // which of them
    for (std::size_t i = 0; i < all.parts.size(); ++i) {
      ChipProgram one("abi", all.source_of(i), level);
      ASSERT_TRUE(one.is_whole()) << all.names[i] << level << one.error();
      EXPECT_EQ(one.run(), expected_of(all.source_of(i))) << all.names[i] << ", " << level;
    }
    ADD_FAILURE() << all.what << ", " << level;
  }
}

TEST(SecondOpinion, avr_gcc_s_structs_of_0_to_20_bytes_arrive_as_ours) {
  for (const AbiProgram& all : abi_programs_by_shape()) expect_second_opinion(all);
}

TEST(SecondOpinion, avr_gcc_s_signatures_by_chance_are_ours) {
  constexpr int kTogether = 8;
  int first = 1, count = 240;
  if (const char* wish = std::getenv("TWINPUCK_SIGNATURES")) {
    ASSERT_EQ(std::sscanf(wish, "%d %d", &first, &count), 2) << wish;
  }
  for (int seed = first; seed < first + count; seed += kTogether)
    expect_second_opinion(abi_program_by_chance(std::uint32_t(seed), kTogether));
}

// what the chip's own types hold
TEST(SecondOpinion, avr_gcc_s_types_are_as_wide_as_ours) {
  AbiProgram all;
  all.what = "types";
  all.names = {"types"};
  all.parts = {R"(
    typedef struct { u8 a; } One;
    typedef union { u8 a[3]; } Three;
    typedef enum { kSmall, kSmaller } Small;
    void run_part_0(void) {
      add(sizeof(char)); add(sizeof(short)); add(sizeof(int)); add(sizeof(long)); add(sizeof(long long));
      add(sizeof(float)); add(sizeof(double)); add(sizeof(void *)); add(sizeof(Fn)); add(sizeof(One));
      add(sizeof(Three)); add(sizeof(Three[3])); add(sizeof(Small)); add(sizeof('a')); add(sizeof(1 + 1u));
      add(sizeof(1L * 'a')); add(sizeof(1.0f * 1.0)); add(sizeof(one << 20L)); add((u16)(one - 2 > 5));
      add((u16)(one * 40000u / 2)); add((u16)((long)one * -3 >> 1)); add((u16)((one ? -1 : 1u) > 0));
    }
  )"};
  expect_second_opinion(all);
}

}  // namespace
}  // namespace chip_cc
