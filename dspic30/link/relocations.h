// SPDX-License-Identifier: MIT
// Places in an instruction that the linker fills, and the numbers by which ELF objects of this chip name them
// (the vendor's, so that its objects and ours mix).
#pragma once

namespace llvm {
namespace dspic_elf {

enum Relocation : unsigned {
  kNone = 0,
  kByte = 1,          // data, 8 bits
  kWord = 2,          // data, 16 bits; of a function: its handle
  kLong = 3,          // data, 32 bits
  kNearByte = 4,      // f<12:0>
  kNear = 5,          // f<12:0>, even
  kFile = 6,          // f<15:0>, even: PUSH, POP
  kFileOfMove = 7,    // f<15:1> at bit 4: MOV f,Wnd
  kLiteral16 = 8,     // #lit16 at bit 4; of a function: its handle
  kPsvOffset = 17,    // #lit16: where the PSV window shows it
  kPsvPage = 20,      // #lit16: of the PSV window
  kTableOffset = 21,  // #lit16: program address <15:0>
  kTablePage = 24,    // #lit16: program address <22:16>
  kBranch = 28,       // words from the next instruction
  kDoEnd = 30,        // the same, second word of DO
  kCallLow = 32,      // program address <15:0>, first word of CALL and GOTO
  kCallHigh = 33,     // program address <22:16>, second word
};

}  // namespace dspic_elf

struct DSPICFixup {
  const char* name;
  unsigned shift, bits;
  dspic_elf::Relocation relocation;
  bool is_relative() const { return relocation == dspic_elf::kBranch || relocation == dspic_elf::kDoEnd; }
};
inline constexpr DSPICFixup kFixups[] = {
    {"near byte", 0, 13, dspic_elf::kNearByte},
    {"near", 0, 13, dspic_elf::kNear},
    {"file", 0, 16, dspic_elf::kFile},
    {"file of mov", 4, 15, dspic_elf::kFileOfMove},
    {"lit16", 4, 16, dspic_elf::kLiteral16},
    {"psv offset", 4, 16, dspic_elf::kPsvOffset},
    {"psv page", 4, 16, dspic_elf::kPsvPage},
    {"table offset", 4, 16, dspic_elf::kTableOffset},
    {"table page", 4, 16, dspic_elf::kTablePage},
    {"branch", 0, 16, dspic_elf::kBranch},
    {"end of do", 0, 16, dspic_elf::kDoEnd},
    {"call low", 0, 16, dspic_elf::kCallLow},
    {"call high", 0, 16, dspic_elf::kCallHigh},
};

}  // namespace llvm
