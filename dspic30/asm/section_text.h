// SPDX-License-Identifier: MIT
// What ".section NAME, attribute, ..." says, in the words of the vendor's assembler. Source: DS51317 (MPLAB
// ASM30), section types and attributes.
#pragma once
#include <string>

#include "dspic30/asm/instruction_text.h"

namespace dspic::assembly {

enum class SectionKind { Code, Constants, Eeprom, Ram };

struct SectionText {
  std::string name;
  SectionKind kind = SectionKind::Code;
  bool is_zeroed = false;  ///< bss, persist: it has no values of its own
  bool is_near = false, is_x = false, is_y = false, is_persistent = false, is_noload = false;
  bool is_info = false;            ///< for tools: no part of the program
  std::string address, alignment;  ///< expressions; empty: any
};

/// Without an attribute that says so, the kind follows from the name: .const, .eedata, or one with "bss" or
/// "data" in it; else it is code. False, with a complaint, for an unknown attribute.
bool read_section(const std::string& operands, SectionText& section, const Complaint& complain);

}  // namespace dspic::assembly
