// SPDX-License-Identifier: MIT
// section(".ydata, data, ymemory"): what the compiler hands on to XC16's assembler as it stands, attributes
// included. Such a name becomes the one by which this compiler says the same (memory_spaces.h).
#include "dspic30/asm/section_text.h"
#include "dspic30/llvm/target.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/IR/Module.h"

namespace llvm {

namespace {

namespace assembly = dspic::assembly;

/// "" where a function or a variable lies as if it had no section.
std::string section_for(const assembly::SectionText& text, bool has_value) {
  using Kind = assembly::SectionKind;
  std::string name = text.is_persistent                  ? ".pbss"
                     : text.is_x                         ? (has_value ? ".xdata" : ".xbss")
                     : text.is_y                         ? (has_value ? ".ydata" : ".ybss")
                     : text.is_near                      ? (has_value ? ".ndata" : ".nbss")
                     : text.kind == Kind::Eeprom         ? ".eedata"
                     : text.kind == Kind::Constants      ? ".const"
                     : text.kind == Kind::Code           ? ".prog"
                     : has_value || text.address.empty() ? ".data"
                                                         : ".bss";
  std::uint64_t address = 0;
  if (!text.address.empty() && !StringRef(text.address).trim().getAsInteger(0, address))
    name += "@" + utohexstr(address);
  return name;
}

}  // namespace

std::string name_dspic_sections(Module& module) {
  std::string wrong;
  for (GlobalObject& object : module.global_objects()) {
    if (!object.getSection().contains(',')) continue;
    const auto complain = [&](const std::string& message) {
      wrong = object.getName().str() + ": section(\"" + object.getSection().str() + "\"): " + message;
    };
    assembly::SectionText text;
    if (!assembly::read_section(object.getSection().str(), text, complain)) return wrong;
    const auto* variable = dyn_cast<GlobalVariable>(&object);
    const bool has_value =
        variable && variable->hasInitializer() && !variable->getInitializer()->isNullValue();
    object.setSection(variable ? section_for(text, has_value) : "");
  }
  return wrong;
}

}  // namespace llvm
