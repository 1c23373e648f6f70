// SPDX-License-Identifier: MIT
#include "dspic30/asm/section_text.h"

#include <vector>

#include "dspic30/asm/expression.h"

namespace dspic::assembly {

namespace {

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

SectionKind kind_by_name(const std::string& name) {
  if (name.compare(0, 6, ".const") == 0) return SectionKind::Constants;
  if (name.compare(0, 7, ".eedata") == 0) return SectionKind::Eeprom;
  return contains(name, "bss") || contains(name, "data") ? SectionKind::Ram : SectionKind::Code;
}

/// "ADDRESS(0x1800)" as "address" and "0x1800".
std::string argument(std::string& attribute) {
  const std::size_t open = attribute.find('('), close = attribute.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  std::string inside = attribute.substr(open + 1, close - open - 1);
  attribute.resize(open);
  return inside;
}

}  // namespace

bool read_section(const std::string& operands, SectionText& section, const Complaint& complain) {
  const std::vector<std::string> parts = split(operands);
  if (parts.empty() || parts[0].empty()) return complain(".section: which?"), false;
  section = {};
  section.name = parts[0];
  section.kind = kind_by_name(section.name);
  section.is_zeroed = section.kind == SectionKind::Ram && contains(section.name, "bss");
  // Attributes of XC16 and of gcc, in any order.
  for (std::size_t i = 1; i < parts.size(); ++i) {
    std::string a = lower(parts[i]);
    const std::string inside = argument(a);
    if (a == "code" || a == "\"x\"") {
      section.kind = SectionKind::Code;
    } else if (a == "psv" || a == "const" || a == "\"r\"") {
      section.kind = SectionKind::Constants;
    } else if (a == "eedata") {
      section.kind = SectionKind::Eeprom;
    } else if (a == "data" || a == "bss" || a == "\"b\"" || a == "\"d\"") {
      section.kind = SectionKind::Ram;
      section.is_zeroed = a == "bss" || a == "\"b\"";
    } else if (a == "xmemory" || a == "ymemory") {
      section.kind = SectionKind::Ram;
      (a == "xmemory" ? section.is_x : section.is_y) = true;
    } else if (a == "persist") {
      section.kind = SectionKind::Ram;
      section.is_persistent = section.is_zeroed = true;
    } else if (a == "address") {
      section.address = inside;
    } else if (a == "align") {
      section.alignment = inside;
    } else if (a == "near") {
      section.is_near = true;
    } else if (a == "noload" || a == "\"n\"") {
      section.is_noload = true;
    } else if (a == "info") {
      section.is_info = true;
    } else if (a != "page" && a != "keep") {
      return complain(".section: unknown attribute '" + parts[i] + "'"), false;
    }
  }
  return true;
}

}  // namespace dspic::assembly
