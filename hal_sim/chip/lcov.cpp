// SPDX-License-Identifier: MIT
#include "hal_sim/chip/lcov.h"

#include <charconv>
#include <sstream>
#include <vector>

namespace chip {

namespace {

/// "12,3,0,-" apart.
std::vector<std::string> fields_of_record(const std::string& text) {
  std::vector<std::string> fields{""};
  for (const char c : text)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

template <class Number>
bool to_number(const std::string& text, Number& number) {
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
  return wrong == std::errc() && end == text.data() + text.size();
}

/// One record of a source; false: it is none.
bool read_record(const std::string& kind, const std::string& rest, Lcov::Source& source) {
  const std::vector<std::string> f = fields_of_record(rest);
  int line = 0, block = 0, way = 0;
  std::uint64_t count = 0;
  if (kind == "DA") {
    if (f.size() < 2 || !to_number(f[0], line) || !to_number(f[1], count)) return false;
    source.lines[line] += count;
  } else if (kind == "FN") {
    // newer ones have the last line between
    if (f.size() < 2 || !to_number(f[0], line)) return false;
    source.functions[f.back()].line = line;
  } else if (kind == "FNDA") {
    if (f.size() != 2 || !to_number(f[0], count)) return false;
    source.functions[f[1]].calls += count;
  } else if (kind == "BRDA") {
    if (f.size() != 4 || !to_number(f[0], line) || !to_number(f[1], block) || !to_number(f[2], way))
      return false;
    Lcov::Ways& ways = source.branches[{line, block, way}];
    if (f[3] == "-") return true;
    if (!to_number(f[3], count)) return false;
    ways.is_known = true;
    ways.count += count;
  }
  return true;
}

bool have_same_lines(const Lcov::Source& a, const Lcov::Source& b) {
  if (a.lines.size() != b.lines.size()) return false;
  for (auto x = a.lines.begin(), y = b.lines.begin(); x != a.lines.end(); ++x, ++y)
    if (x->first != y->first) return false;
  return true;
}

}  // namespace

bool Lcov::read(const std::string& text, std::string& error) {
  std::istringstream in(text);
  std::string line;
  Source* source = nullptr;
  for (int number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::size_t colon = line.find(':');
    const std::string kind = line.substr(0, colon),
                      rest = colon == std::string::npos ? "" : line.substr(colon + 1);
    const bool is_of_source = source && colon != std::string::npos;
    if (line.empty() || kind == "TN") continue;
    if (kind == "SF" && !rest.empty())
      source = &sources[rest];
    else if (line == "end_of_record")
      source = nullptr;
    else if (is_of_source && kind == "VER")
      source->version = rest;
    else if (!is_of_source || !read_record(kind, rest, *source)) {
      error = "line " + std::to_string(number) + ": got '" + line.substr(0, 60) +
              "', expected a record of lcov's, such as DA:12,3";
      return false;
    }
  }
  return true;
}

bool Lcov::add(const Lcov& other, std::string& error) {
  for (const auto& [file, theirs] : other.sources) {
    const auto mine = sources.find(file);
    if (mine == sources.end()) continue;
    const bool has_versions = !mine->second.version.empty() && !theirs.version.empty();
    if (has_versions ? mine->second.version == theirs.version : have_same_lines(mine->second, theirs))
      continue;
    error = "got counts of another text of " + file + ", expected those of the one that runs";
    return false;
  }
  for (const auto& [file, theirs] : other.sources) {
    Source& mine = sources[file];
    if (mine.version.empty()) mine.version = theirs.version;
    for (const auto& [line, count] : theirs.lines) mine.lines[line] += count;
    for (const auto& [branch, ways] : theirs.branches) {
      Ways& sum = mine.branches[branch];
      sum.is_known |= ways.is_known;
      sum.count += ways.count;
    }
    for (const auto& [name, function] : theirs.functions) {
      Function& sum = mine.functions[name];
      sum.line = function.line;
      sum.calls += function.calls;
    }
  }
  return true;
}

std::string Lcov::text() const {
  std::ostringstream out;
  for (const auto& [file, source] : sources) {
    std::size_t hit = 0;
    const auto totals = [&](const char* all, const char* of_those, std::size_t count) {
      out << all << ':' << count << '\n' << of_those << ':' << hit << '\n';
      hit = 0;
    };
    // In the order in which lcov itself writes: functions, branches, lines, each with its totals.
    out << "TN:\nSF:" << file << '\n';
    if (!source.version.empty()) out << "VER:" << source.version << '\n';
    for (const auto& [name, function] : source.functions)
      out << "FN:" << function.line << ',' << name << '\n';
    for (const auto& [name, function] : source.functions) {
      out << "FNDA:" << function.calls << ',' << name << '\n';
      hit += function.calls > 0;
    }
    totals("FNF", "FNH", source.functions.size());
    for (const auto& [branch, ways] : source.branches) {
      const auto& [line, block, way] = branch;
      out << "BRDA:" << line << ',' << block << ',' << way << ','
          << (ways.is_known ? std::to_string(ways.count) : "-") << '\n';
      hit += ways.count > 0;
    }
    totals("BRF", "BRH", source.branches.size());
    for (const auto& [line, count] : source.lines) {
      out << "DA:" << line << ',' << count << '\n';
      hit += count > 0;
    }
    totals("LF", "LH", source.lines.size());
    out << "end_of_record\n";
  }
  return out.str();
}

}  // namespace chip
