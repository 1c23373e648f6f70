// SPDX-License-Identifier: MIT
// The map: what each module takes, its sections with address and size, then all sections and all
// symbols by address.
#include <algorithm>
#include <cstdio>

#include "dspic30/link/link.h"
#include "dspic30/link/memory_spaces.h"

namespace dspic::link {

namespace {

const char* memory_of(Kind kind) {
  switch (kind) {
    case Kind::Code:
      return "code";
    case Kind::Constant:
      return "constants";
    case Kind::Table:
      return "table";
    case Kind::Ram:
      return "RAM";
    case Kind::Eeprom:
      return "EEPROM";
    default:
      return "config";
  }
}

/// Bytes of RAM and EEPROM, words of flash.
std::uint32_t size_of(const Section& s) {
  if (s.kind == Kind::Code) return s.size / llvm::dspic_elf::kWordOctets;
  return s.kind == Kind::Ram || s.kind == Kind::Eeprom ? s.size : (s.size + 1) / 2;
}
std::uint32_t place_of(const Section& s) {
  return s.kind == Kind::Code || s.kind == Kind::Ram ? s.address : s.load;
}

std::string section_line(const Section& s) {
  char line[600];
  const bool is_bytes = s.kind == Kind::Ram || s.kind == Kind::Eeprom;
  std::snprintf(line, sizeof line, "0x%06X %7u %s  %-9s  %s", place_of(s), size_of(s),
                is_bytes ? "bytes" : "words", memory_of(s.kind), s.name.c_str());
  return line;
}

/// Sections of a module; modules in the order of the link.
struct Module {
  std::string name;
  std::vector<const Section*> sections;
  std::uint32_t sum(std::initializer_list<Kind> kinds) const {
    std::uint32_t total = 0;
    for (const Section* s : sections)
      if (std::find(kinds.begin(), kinds.end(), s->kind) != kinds.end()) total += size_of(*s);
    return total;
  }
};

std::vector<Module> modules_of(const std::vector<const Section*>& sections) {
  std::vector<Module> modules;
  std::map<std::string, std::size_t> known;
  for (const Section* s : sections) {
    const auto [at, is_new] = known.emplace(s->from, modules.size());
    if (is_new) modules.push_back({s->from, {}});
    modules[at->second].sections.push_back(s);
  }
  return modules;
}

}  // namespace

std::string map_file(const Program& program) {
  // All that has a place, in the order of the memories.
  std::vector<const Section*> sections;
  for (const Section& s : program.sections)
    if (s.used && s.kind != Kind::Debug && s.size) sections.push_back(&s);
  const auto by_place = [](const Section* a, const Section* b) {
    return std::make_pair(a->kind, place_of(*a)) < std::make_pair(b->kind, place_of(*b));
  };
  std::string out = program.sizes;
  char line[600];

  out += "\nmodules: words of code, of constants and tables, bytes of RAM\n";
  std::vector<Module> modules = modules_of(sections);
  for (const Module& m : modules) {
    std::snprintf(line, sizeof line, "%8u %8u %8u  %s\n", m.sum({Kind::Code}),
                  m.sum({Kind::Constant, Kind::Table}), m.sum({Kind::Ram}), m.name.c_str());
    out += line;
  }

  out += "\nsections by module: address, size, memory, name\n";
  for (Module& m : modules) {
    std::stable_sort(m.sections.begin(), m.sections.end(), by_place);
    out += m.name + "\n";
    for (const Section* s : m.sections) out += "  " + section_line(*s) + "\n";
  }

  out += "\nsections by address: address, size, memory, name, module\n";
  std::stable_sort(sections.begin(), sections.end(), by_place);
  for (const Section* s : sections) out += section_line(*s) + "  " + s->from + "\n";
  std::snprintf(line, sizeof line,
                "0x%06X %7u words  start values\n0x%06X %7u words  jumps\n0x%06X %7u bytes  stack\n",
                program.dinit, program.dinit_words, program.handles_at, 2 * unsigned(program.handles.size()),
                program.stack_begin, program.stack_end - program.stack_begin);
  out += line;

  out += "\nsymbols by address: address, bytes, name, module\n" + symbol_table(program);
  return out;
}

std::string symbol_table(const Program& program) {
  std::vector<const Symbol*> symbols;
  for (const Symbol& s : program.symbols)
    if (s.is_defined && s.section && s.section->used && s.section->kind != Kind::Debug && !s.name.empty() &&
        s.name[0] != '.')
      symbols.push_back(&s);
  const auto place = [&](const Symbol* s) {
    return std::make_pair(s->section->kind,
                          place_of(*s->section) + program.address_of(*s) - s->section->address);
  };
  std::stable_sort(symbols.begin(), symbols.end(),
                   [&](const Symbol* a, const Symbol* b) { return place(a) < place(b); });
  std::string out;
  char line[600];
  for (const Symbol* s : symbols) {
    std::snprintf(line, sizeof line, "0x%06X %6u  %-9s  %-32s %s\n", place(s).second, s->size,
                  memory_of(s->section->kind), s->name.c_str(), s->from.c_str());
    out += line;
  }
  return out;
}

}  // namespace dspic::link
