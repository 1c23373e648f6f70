// SPDX-License-Identifier: MIT
#include "dspic30/load/code_map.h"

#include <algorithm>
#include <cstdio>

#include "dspic30/load/rows.h"

namespace dspic {

bool ends_path(const std::string& path, const std::string& end) {
  if (path.size() < end.size() || path.compare(path.size() - end.size(), end.size(), end) != 0) return false;
  return path.size() == end.size() || path[path.size() - end.size() - 1] == '/' || end[0] == '/';
}

void CodeMap::sort() {
  sort_rows(functions, [](const Function& a, const Function& b) { return a.begin < b.begin; });
  for (std::size_t i = 0; i + 1 < functions.size(); ++i)
    functions[i].end = std::min(functions[i].end, functions[i + 1].begin);
}

const CodeMap::Function* CodeMap::function_at(std::uint32_t address) const {
  const auto found = last_before(functions, address, [](const Function& f) { return f.begin; });
  return found != functions.end() && address < found->end ? &*found : nullptr;
}

const CodeMap::Function* CodeMap::function_named(const std::string& name) const {
  const auto found =
      std::find_if(functions.begin(), functions.end(), [&](const Function& f) { return f.name == name; });
  return found == functions.end() ? nullptr : &*found;
}

std::vector<std::uint32_t> CodeMap::addresses_of(const std::string& file, int line, int& found) const {
  std::vector<std::size_t> among;
  const std::vector<std::string>& files = lines().files;
  for (std::size_t i = 0; i < files.size(); ++i)
    if (ends_path(files[i], file)) among.push_back(i);
  return addresses_of(among, line, found);
}

std::vector<std::uint32_t> CodeMap::addresses_of(const std::vector<std::size_t>& among, int line,
                                                 int& found) const {
  const LineTable& table = lines();
  std::vector<std::uint32_t> addresses;
  std::vector<char> is_meant(table.files.size());
  for (const std::size_t file : among) is_meant[file] = 1;
  found = 0;
  for (const Line& l : table.rows)
    if (l.is_statement && l.line >= line && (found == 0 || l.line < found) && is_meant[l.file])
      found = l.line;
  if (found == 0) return addresses;
  const Line* before = nullptr;
  for (const Line& l : table.rows) {
    const bool is_it = l.line == found && is_meant[l.file];
    const bool goes_on = before && before->line == l.line && before->file == l.file;
    // of a loop's several pieces only the first in each function
    if (is_it && l.is_statement && !goes_on &&
        (addresses.empty() || function_at(addresses.back()) != function_at(l.address)))
      addresses.push_back(l.address);
    before = &l;
  }
  return addresses;
}

std::uint32_t CodeMap::body_of(std::uint32_t begin) const {
  const Function* const function = function_at(begin);
  if (!function || function->begin != begin) return begin;
  for (const Line& l : lines().rows)
    if (l.is_body && l.address >= begin && l.address < function->end) return l.address;
  return begin;
}

std::string CodeMap::describe(std::uint32_t address) const {
  const Function* function = function_at(address);
  const Line* line = line_at(address);
  char plain[16];
  std::snprintf(plain, sizeof plain, "0x%06x", address);
  if (!function && !line) return plain;
  const std::string file = line ? lines().files[line->file] : "";
  const std::string place =
      line ? file.substr(file.rfind('/') + 1) + ":" + std::to_string(line->line) : plain;
  return function ? function->name + "() (" + place + ")" : place;
}

}  // namespace dspic
