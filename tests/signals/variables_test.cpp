// SPDX-License-Identifier: MIT
// Numbers of a program's variables, to and from their bytes; and what kinds of traps are called.
#include "hal_sim/host/variables.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "hal_sim/host/runner.h"

namespace {

using host::Variable;

struct Row {
  Variable::Kind kind;
  std::size_t bytes;
  int first_bit, bits;
  double set, got;
  std::string hex;  ///< bytes after it, which were all 5A before
};

constexpr auto kSigned = Variable::Kind::Signed, kUnsigned = Variable::Kind::Unsigned,
               kFloat = Variable::Kind::Float;

// the lowest byte first
const Row kRows[] = {
    {kSigned, 1, 0, 0, -1, -1, "ff5a5a5a5a5a5a5a"},
    {kUnsigned, 1, 0, 0, -1, 255, "ff5a5a5a5a5a5a5a"},
    {kSigned, 2, 0, 0, -2, -2, "feff5a5a5a5a5a5a"},
    {kUnsigned, 2, 0, 0, 65535, 65535, "ffff5a5a5a5a5a5a"},
    {kSigned, 2, 0, 0, 40000, 40000 - 65536, "409c5a5a5a5a5a5a"},  // cut to its width
    {kSigned, 4, 0, 0, -70000, -70000, "90eefeff5a5a5a5a"},
    {kUnsigned, 4, 0, 0, 4294967296.0 + 5, 5, "050000005a5a5a5a"},
    {kSigned, 8, 0, 0, -3, -3, "fdffffffffffffff"},
    {kUnsigned, 8, 0, 0, 1e30, 1.8e19, "000008c5a1d8ccf9"},  // the nearest that 64 bits hold
    {kSigned, 2, 0, 0, 2.9, 2, "02005a5a5a5a5a5a"},          // towards zero
    {kSigned, 2, 0, 0, -2.9, -2, "feff5a5a5a5a5a5a"},
    {kSigned, 2, 0, 0, std::nan(""), 0, "00005a5a5a5a5a5a"},
    // 5a5a is 0101 1010 0101 1010: three bits from the fourth on
    {kUnsigned, 2, 3, 3, 7, 7, "7a5a5a5a5a5a5a5a"},
    {kUnsigned, 2, 3, 3, 8, 0, "425a5a5a5a5a5a5a"},
    {kSigned, 2, 3, 3, -1, -1, "7a5a5a5a5a5a5a5a"},
    {kSigned, 2, 3, 3, 3, 3, "5a5a5a5a5a5a5a5a"},
    {kSigned, 2, 12, 4, -8, -8, "5a8a5a5a5a5a5a5a"},
    {kUnsigned, 1, 7, 1, 1, 1, "da5a5a5a5a5a5a5a"},
    {kFloat, 4, 0, 0, 1.5, 1.5, "0000c03f5a5a5a5a"},
    {kFloat, 8, 0, 0, -2, -2, "00000000000000c0"},
};

TEST(Variables, have_the_number_that_their_bytes_stand_for) {
  for (const Row& row : kRows) {
    Variable v;
    v.kind = row.kind;
    v.bytes = row.bytes;
    v.first_bit = row.first_bit;
    v.bits = row.bits;
    std::array<char, 8> memory;
    memory.fill(0x5A);
    host::set_variable_value(v, memory.data(), row.set);
    std::string hex;
    for (const char byte : memory) {
      char pair[3];
      std::snprintf(pair, sizeof pair, "%02x", static_cast<unsigned char>(byte));
      hex += pair;
    }
    EXPECT_EQ(hex, row.hex) << row.set << " into " << row.bytes << " bytes, bits " << row.bits;
    EXPECT_EQ(host::variable_value(v, memory.data()), row.got) << row.set;
  }
}

TEST(Traps, have_names) {
  const std::pair<int, const char*> rows[] = {{host::kUnexpectedReset, "unexpected reset"},
                                              {host::kTrapMath, "math error"},
                                              {host::kTrapAddress, "address error"},
                                              {host::kTrapStack, "stack error"},
                                              {host::kTrapAbort, "abort"},
                                              {host::kTrapInterrupt, "interrupt trouble"},
                                              {host::kTrapIllegal, "illegal instruction"},
                                              {host::kTrapSanitizer, "sanitizer"},
                                              {host::kTrapUnsimulated, "not simulated"},
                                              {host::kProgramEnded, "its program"},
                                              {99, "trap"}};
  for (const auto& [kind, name] : rows) EXPECT_STREQ(host::trap_name(kind), name);
}

}  // namespace
