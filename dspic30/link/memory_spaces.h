// SPDX-License-Identifier: MIT
// Where a variable lies, said in the name of its section. The front end makes such names of XC16's
// attributes, the back end makes ELF sections of them, the linker places those:
//
//     .nbss .ndata      near: the first 8 KB, where file instructions reach
//     .bss .data        anywhere in RAM
//     .xbss .xdata      X memory      .ybss .ydata  Y memory, for the DSP instructions
//     .pbss             persistent: keeps its value over a reset
//     .eedata           data EEPROM   .const        constants in program memory, read through the PSV window
//     .prog             program memory, read by table instructions
//
// A fixed address follows as "@1000", in hexadecimal. The flags are the vendor's.
#pragma once
#include "llvm/ADT/StringRef.h"

namespace llvm {
namespace dspic_elf {

/// Of a word of program memory in an object: its three bytes and an empty one.
constexpr unsigned kWordOctets = 4;

enum SectionFlag : unsigned {
  kNoload = 1u << 23,
  kNearSpace = 1u << 24,
  kPersistent = 1u << 25,
  kXSpace = 1u << 26,
  kYSpace = 1u << 27,
  kPsv = 1u << 28,
  kEeprom = 1u << 29,
  kAbsolute = 1u << 30,
};

struct MemorySpace {
  const char* prefix;  // of sections' names
  unsigned flags;
  bool writable, zeroed;
};
inline constexpr MemorySpace kSpaces[] = {
    {".nbss", kNearSpace, true, true},
    {".ndata", kNearSpace, true, false},
    {".bss", 0, true, true},
    {".data", 0, true, false},
    {".xbss", kXSpace, true, true},
    {".xdata", kXSpace, true, false},
    {".ybss", kYSpace, true, true},
    {".ydata", kYSpace, true, false},
    {".pbss", kPersistent, true, true},
    {".const", kPsv, false, false},
    {".eedata", kEeprom, true, false},
    {".prog", 0, false, false},
};

/// The space a section's name says, or null: ".xbss", ".xbss.buffer", ".xbss@1800".
inline const MemorySpace* space_of(StringRef section) {
  for (const MemorySpace& space : kSpaces) {
    StringRef rest = section;
    if (rest.consume_front(space.prefix) && (rest.empty() || rest[0] == '.' || rest[0] == '@')) return &space;
  }
  return nullptr;
}

}  // namespace dspic_elf
}  // namespace llvm
