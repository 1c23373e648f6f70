// SPDX-License-Identifier: MIT
// What MemoryCheck knows of an instruction.
#pragma once
#include <cstdint>

#include "dspic30/core/instruction_table.h"
#include "dspic30/core/memory_check.h"

namespace dspic {

struct MemoryCheck::Shape {
  enum class Group : std::uint8_t {
    Other,  // nothing is known: all that it writes counts as written
    Copy,
    CopyPair,
    And,
    Or,
    Xor,
    Sum,   // carries go upwards only
    Left,  // one bit, or as many as the literal says
    Right,
    Mix,  // each bit of the result may depend on each of the operands
    SignExtend,
    ZeroExtend,
    Swap,
    Constant,
    SetBit,
    FlipBit,
    TestBit,
    SkipBit,
    TestAnyBit,
    Compare,
    Skip,
    Multiply,
    Divide,
    Branch,
    Unlink
  };
  std::uint32_t word = 0;
  const Row* row = nullptr;  // null: no instruction
  Fields f;
  Group group = Group::Other;
  bool byte = false, sets_flags = false;
};

}  // namespace dspic
