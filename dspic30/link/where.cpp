// SPDX-License-Identifier: MIT
// Function and line of code that has no place yet: sections of code are laid one behind the other, and line
// tables are read as if that were memory. Their steps count words of four octets there, as the objects do.
#include "dspic30/link/link.h"
#include "dspic30/link/relocations.h"

namespace dspic::link {

std::string in_c(const std::string& name) { return name.substr(name.size() > 1 && name[0] == '_'); }

Whereabouts::Whereabouts(const Program& program) : program_(program) {
  lines_.moved_from = program.moved_from;
  lines_.moved_to = program.moved_to;
  constexpr std::uint32_t kGap = 4;  // what begins at 0 counts as left out
  std::uint32_t next = kGap;
  for (const Section& s : program.sections)
    if (s.kind == Kind::Code) begins_[&s] = next, next += s.size + kGap;
  for (const Section& s : program.sections) {
    if (s.name != ".debug_line") continue;
    std::vector<std::uint8_t> bytes = s.bytes;
    for (const Relocation& r : s.relocations) {
      const auto begin = begins_.find(r.symbol->section);
      if (r.type != llvm::dspic_elf::kLong || r.offset + 4 > bytes.size()) continue;
      const std::uint32_t at =
          begin == begins_.end() ? 0 : begin->second + r.symbol->value + std::uint32_t(r.addend);
      for (unsigned i = 0; i < 4; ++i) bytes[r.offset + i] = std::uint8_t(at >> 8 * i);
    }
    lines_.add(bytes.data(), bytes.size());
  }
  lines_.sort();
}

std::string Whereabouts::line(const Section& section, std::uint32_t offset) const {
  const auto begin = begins_.find(&section);
  const LineTable::Row* line = begin == begins_.end() ? nullptr : lines_.line_at(begin->second + offset);
  return line ? source_named(lines_.files[line->file], program_.sources) + ":" + std::to_string(line->line)
              : section.from;
}

std::string Whereabouts::line(const Symbol& symbol) const {
  return symbol.section ? line(*symbol.section, symbol.value) : symbol.from;
}

std::string Whereabouts::function(const Section& section, std::uint32_t offset) const {
  const Symbol* found = nullptr;
  const auto look = [&](const Symbol& s) {
    if (s.section != &section || s.value > offset || s.name.empty() || s.name[0] == '.') return;
    if (!found || s.value > found->value || (s.value == found->value && s.is_function)) found = &s;
  };
  for (const Symbol& s : program_.symbols) look(s);
  return found ? in_c(found->name) : "";
}

}  // namespace dspic::link
