// SPDX-License-Identifier: MIT
// The image's code as text: address, word, instruction; functions by their names, each line of the source
// before the code that comes of it, and all symbols at the end.
#include <algorithm>
#include <cstdio>
#include <fstream>

#include "dspic30/core/disassembler.h"
#include "dspic30/link/link.h"

namespace dspic::link {

namespace {

/// Lines of source files, read when they are asked for.
class Sources {
 public:
  explicit Sources(const Options& options) : options_(options) {}

  /// "12  led = 1;", or the number alone where the file is not at hand.
  std::string text(const std::string& file, int line) {
    const std::vector<std::string>& all = lines_of(file);
    const std::string number = std::to_string(line);
    return std::string(number.size() < 5 ? 5 - number.size() : 0, ' ') + number +
           (line > 0 && std::size_t(line) <= all.size() ? "  " + all[std::size_t(line) - 1] : "");
  }

 private:
  const std::vector<std::string>& lines_of(const std::string& file) {
    const auto [known, is_new] = files_.try_emplace(file);
    if (!is_new) return known->second;
    const std::string source = source_named(file, options_.sources);
    if (options_.may_quote && !options_.may_quote(source)) return known->second;
    std::ifstream in(source);
    for (std::string line; std::getline(in, line);) {
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
      known->second.push_back(line);
    }
    return known->second;
  }

  const Options& options_;
  std::map<std::string, std::vector<std::string>> files_;
};

}  // namespace

std::string source_named(const std::string& name, const std::map<std::string, std::string>& sources) {
  // how much of the ends of two paths is one, in whole names
  const auto common = [](const std::string& a, const std::string& b) {
    std::size_t same = 0, n = 0;
    while (n < a.size() && n < b.size() && a[a.size() - 1 - n] == b[b.size() - 1 - n]) {
      ++n;
      const bool ends =
          (n == a.size() || a[a.size() - 1 - n] == '/') && (n == b.size() || b[b.size() - 1 - n] == '/');
      if (ends) same = n;
    }
    return same;
  };
  const std::string* best = nullptr;
  std::size_t most = 0;
  for (const auto& [object, source] : sources)
    if (const std::size_t n = common(name, source); n > most) most = n, best = &source;
  return best ? *best : name;
}

std::string listing(const Program& program, const Options& options) {
  // Labels by address, sections in order, and the lines of the source.
  std::map<std::uint32_t, std::vector<std::string>> labels;
  for (const Symbol& s : program.symbols)
    if (s.is_defined && s.section && s.section->used && s.section->kind == Kind::Code && !s.name.empty() &&
        s.name[0] != '.')
      labels[program.address_of(s)].push_back(s.name);
  std::map<std::uint32_t, const Section*> code;
  for (const Section& s : program.sections)
    if (s.used && s.kind == Kind::Code) code[s.address] = &s;
  LineTable lines;
  lines.moved_from = options.moved_from;
  lines.moved_to = options.moved_to;
  for (const Section& s : program.sections)
    if (s.name == ".debug_line") lines.add(s.bytes.data(), s.bytes.size());
  lines.sort();

  Sources sources(options);
  std::string out = "; address, word, instruction; before them the lines of the source; symbols at the end\n";
  char text[160];
  auto row = lines.rows.begin();
  // Word by word: label, line where it is another one, instruction.
  for (const auto& [begin, s] : code) {
    int line = 0, file = -1;
    while (row != lines.rows.end() && row->address < begin) ++row;
    for (std::uint32_t at = begin; at < begin + s->size / 2; at += 2) {
      if (const auto found = labels.find(at); found != labels.end())
        for (const std::string& label : found->second)
          out += "\n" + label + ":" + (file < 0 ? "  ; " + s->from : "") + "\n";
      // of several rows for one address the last one's code stands here
      const LineTable::Row* here = nullptr;
      for (; row != lines.rows.end() && row->address <= at; ++row)
        if (!row->is_end && row->line > 0) here = &*row;
      if (here && (here->line != line || here->file != file)) {
        if (here->file != file) out += "; " + source_named(lines.files[here->file], options.sources) + "\n";
        file = here->file, line = here->line;
        out += "; " + sources.text(lines.files[here->file], line) + "\n";
      }
      const std::uint32_t word = program.words.at(at);
      const auto next = program.words.find(at + 2);
      std::snprintf(text, sizeof text, "%06X  %06X  %s\n", at, word,
                    disassemble(word, next == program.words.end() ? 0 : next->second, at).c_str());
      out += text;
      if (instruction_words(word) == 2) at += 2;
    }
  }
  return out + "\n; symbols: address, bytes, memory, name, module\n" + symbol_table(program);
}

}  // namespace dspic::link
