// SPDX-License-Identifier: MIT
// The image's code as text: address, word, instruction; functions by their names.
#include <cstdio>

#include "dspic30/core/disassembler.h"
#include "dspic30/llvm/link.h"

namespace dspic::link {

std::string listing(const Program& program) {
  std::map<std::uint32_t, std::string> labels;
  for (const auto& [name, symbol] : program.globals)
    if (symbol->is_defined && symbol->section && symbol->section->used && symbol->section->kind == Kind::Code)
      labels[program.address_of(*symbol)] = name;
  std::map<std::uint32_t, const Section*> code;
  for (const Section& s : program.sections)
    if (s.used && s.kind == Kind::Code) code[s.address] = &s;
  std::string out;
  char line[160];
  for (const auto& [begin, s] : code)
    for (std::uint32_t at = begin; at < begin + s->size / 2; at += 2) {
      if (const auto label = labels.find(at); label != labels.end()) out += "\n" + label->second + ":\n";
      const std::uint32_t word = program.words.at(at);
      const auto next = program.words.find(at + 2);
      std::snprintf(line, sizeof line, "%06X  %06X  %s\n", at, word,
                    disassemble(word, next == program.words.end() ? 0 : next->second, at).c_str());
      out += line;
      if (instruction_words(word) == 2) at += 2;
    }
  return out;
}

}  // namespace dspic::link
