// SPDX-License-Identifier: MIT
// Words of program memory as assembler text, in XC16's syntax: "add.b w1, [w2++], w3".
//
// The text is one that the assembler turns into the same words. What it would not write that way
// (bits that nothing reads, two codes for one operand, odd addresses of words) and illegal opcodes
// come as ".pword 0x...".
#pragma once
#include <cstdint>
#include <string>

namespace dspic {

/// Instruction at `address`; `second` is the word after it, for GOTO, CALL and DO.
std::string disassemble(std::uint32_t word, std::uint32_t second, std::uint32_t address);
/// Words that it takes: 1 or 2.
int instruction_words(std::uint32_t word);

}  // namespace dspic
