// SPDX-License-Identifier: MIT
#include <sys/stat.h>

#include <cstdio>
#include <deque>
#include <fstream>

#include "hal_sim/host/address_slot.h"
#include "sim_core/load/schema.h"
#include "tests/host/bench.h"
#include "twinpuck_paths.h"

namespace {

std::string refusal(const std::string& path) {
  std::string error;
  EXPECT_FALSE(host::Image::open(path, error));
  return error;
}

std::string write_file(const std::string& name, const std::string& bytes) {
  const std::string path = ::testing::TempDir() + name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

TEST(Image, a_missing_file_is_named) {
  EXPECT_EQ(refusal("/nowhere/x.so"),
            "/nowhere/x.so: firmware image: cannot be read: No such file or directory; build it, or name the "
            "program's folder");
}

TEST(Image, a_folder_is_refused) { EXPECT_NE(refusal("/tmp").find("got a folder"), std::string::npos); }

TEST(Image, an_empty_file_is_refused) {
  EXPECT_NE(refusal(write_file("empty.so", "")).find("got an empty file"), std::string::npos);
}

TEST(Image, a_text_is_refused) {
  EXPECT_NE(refusal(write_file("text.so", "hello, I am a text\n")).find("no ELF"), std::string::npos);
  EXPECT_NE(refusal(write_file("old.cof", "\x36\x12\x2E")).find("COFF"), std::string::npos);
}

TEST(Image, a_hex_file_is_told_from_others) {
  EXPECT_NE(refusal(write_file("x.hex", ":020000040000FA\n")).find("Intel hex"), std::string::npos);
}

TEST(Image, a_dspic_elf_is_told_from_others) {
  std::string elf(
      "\x7f"
      "ELF\x01\x01\x01",
      7);
  elf.resize(52);
  elf[16] = 2;
  elf[18] = 118;
  const std::string error = refusal(write_file("x.elf", elf));
  EXPECT_NE(error.find("ELF for the dsPIC30F"), std::string::npos) << error;
}

TEST(Image, a_cut_off_shared_object_is_refused) {
  std::ifstream whole(std::string(TWINPUCK_BUILD_DIR) + "/tests/images/hand_idle.so", std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(whole)), {});
  bytes.resize(bytes.size() / 3);
  EXPECT_NE(refusal(write_file("cut.so", bytes)).find("cut off"), std::string::npos);
}

TEST(Image, a_foreign_shared_object_is_refused) {
  EXPECT_NE(refusal("/lib/x86_64-linux-gnu/libm.so.6").find("without a firmware inside"), std::string::npos);
}

std::string bytes_of(const std::string& image) {
  std::ifstream in(std::string(TWINPUCK_BUILD_DIR) + "/tests/images/" + image + ".so", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Image, a_flipped_bit_anywhere_is_refused) {
  const std::string whole = bytes_of("hand_idle");
  ASSERT_GT(whole.size(), 1000u);
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 400) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << at % 8));
    EXPECT_NE(refusal(write_file("flipped.so", flipped)), "") << at;
  }
  EXPECT_NE(refusal(write_file("flipped.so", std::string(whole).replace(whole.size() / 2, 1, "?")))
                .find("damaged file"),
            std::string::npos);
}

// what its constructor would do is seen by everybody: it ends the process
TEST(Image, a_foreign_shared_object_is_refused_before_it_runs) {
  EXPECT_NE(refusal(std::string(TWINPUCK_BUILD_DIR) + "/tests/images/hand_foreign.so")
                .find("without a firmware inside"),
            std::string::npos);
}

TEST(Image, constructors_and_indirect_functions_are_refused_before_they_run) {
  EXPECT_NE(
      refusal(std::string(TWINPUCK_BUILD_DIR) + "/tests/images/hand_constructor.so").find("constructor"),
      std::string::npos);
  EXPECT_NE(refusal(std::string(TWINPUCK_BUILD_DIR) + "/tests/images/hand_ifunc.so").find("firmware has not"),
            std::string::npos);
}

#if !defined(__SANITIZE_THREAD__)  // there all memory lies in places of the sanitizer's
TEST(Image, every_copy_lies_at_the_same_place_as_far_as_32_bits_tell) {
  auto image = host_test::open_image("hand_busy"), other = host_test::open_image("hand_idle");
  const auto low = [](const host::ImageCopy& copy) { return static_cast<std::uint32_t>(copy.base()); };
  EXPECT_EQ(low(image->copy(0)), low(image->copy(1)));
  EXPECT_EQ(low(image->copy(0)), low(other->copy(0)));
  EXPECT_NE(image->copy(0).base(), image->copy(1).base());
}

TEST(AddressSlots, there_is_a_stack_for_every_robot_of_the_largest_world) {
  constexpr std::size_t kOffset = 0x1'0000, kBytes = 4096, kLowBits = 0x3F'FFFF;
  std::deque<host::AddressSlot> stacks;
  for (int r = 0; r < sim::kMostRobots; ++r) {
    const auto& stack = stacks.emplace_back(host::AddressSlot::Kind::Stack, kOffset, kBytes);
    ASSERT_EQ(stack.begin() & kLowBits, kOffset) << r;
    // an int that indexes an array of 64-byte structs meets no other robot's
    ASSERT_TRUE(r == 0 || stack.begin() - stacks[r - 1].begin() > 32767 * 64) << r;
  }
}

TEST(AddressSlots, a_stack_that_is_given_back_is_given_again) {
  using Kind = host::AddressSlot::Kind;
  auto first = std::make_unique<host::AddressSlot>(Kind::Stack, 0, 4096);
  const host::AddressSlot second(Kind::Stack, 0, 4096);
  const auto begin = first->begin();
  first.reset();
  const host::AddressSlot image(Kind::Image, 0, 4096);
  EXPECT_EQ(host::AddressSlot(Kind::Stack, 0, 4096).begin(), begin);
  EXPECT_NE(image.begin(), begin);
}
#endif

}  // namespace
