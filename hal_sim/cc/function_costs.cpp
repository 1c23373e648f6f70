// SPDX-License-Identifier: MIT
// `twinpuck cycles`: puts callees into callers. Input: section .tpcost, a line a function, written by
// account.cpp.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "build.h"
#include "elf_reader.h"
#include "hal_sim/board/cycle.h"

namespace cc {
namespace {

// of a handler beside what its line tells, which includes w0 to w7 saved and restored: entry 5, RETFIE
// instead of RETURN 0, RCOUNT and PSVPAG about 3  [estimated: DS70143 5.7 and gcc 4.5 prologues]
constexpr double kInterruptCycles = 8;

struct Entry {
  std::string file;
  int line = 0;
  bool is_library = false;
  double cycles[3] = {0, 0, 0};  // least, mean, most; -1 unknown
  std::map<std::string, double> calls[3];
  bool done = false;
};

std::vector<std::string> split(const std::string& s, char at) {
  std::vector<std::string> parts;
  std::string part;
  std::istringstream in(s);
  while (std::getline(in, part, at)) parts.push_back(part);
  return parts;
}

/// Adds the callees' cycles; a function met again on the way (recursion) has no upper bound.
void resolve(const std::string& name, std::map<std::string, Entry>& all, std::set<std::string>& open) {
  Entry& e = all[name];
  if (e.done) return;
  open.insert(name);
  for (int k = 0; k < 3; ++k)
    for (auto& [callee, count] : e.calls[k]) {
      auto found = all.find(callee);
      if (found == all.end()) continue;  // of the host: spends its own cycles there
      if (open.count(callee)) {
        e.cycles[2] = -1;
        continue;
      }
      resolve(callee, all, open);
      double each = found->second.cycles[k];
      if (k == 2 && (each < 0 || e.cycles[2] < 0))
        e.cycles[2] = -1;
      else if (each > 0)
        e.cycles[k] += each * count;
    }
  open.erase(name);
  e.done = true;
}

}  // namespace

double FunctionCycles::mean_us() const { return mean / static_cast<double>(board::kFcyHz) * 1e6; }
double FunctionCycles::cpu_load(double period_s) const {
  return period_s > 0 ? mean / static_cast<double>(board::kFcyHz) / period_s : 0;
}

std::vector<FunctionCycles> function_costs(const std::filesystem::path& image) {
  std::vector<FunctionCycles> result;
  std::string text = read_elf(image).section(".tpcost");
  std::map<std::string, Entry> all;
  for (const auto& line : split(text, '\0')) {
    auto fields = split(line, '|');
    if (fields.size() == 5 && fields[3] == "inlined") {
      FunctionCycles f;
      f.name = fields[0], f.file = fields[1], f.line = std::atoi(fields[2].c_str());
      f.inlined_into = fields[4];
      result.push_back(f);
    }
    if (fields.size() < 6) continue;
    Entry e;
    e.is_library = fields.size() > 9 && fields[9] == "library";
    e.file = fields[1];
    e.line = std::atoi(fields[2].c_str());
    for (int k = 0; k < 3; ++k) {
      e.cycles[k] = std::atof(fields[3 + k].c_str());
      if (fields.size() > size_t(6 + k))
        for (const auto& call : split(fields[6 + k], ',')) {
          auto parts = split(call, ':');
          if (parts.size() == 2) e.calls[k][parts[0]] = std::atof(parts[1].c_str());
        }
    }
    all[fields[0]] = e;
  }
  std::vector<std::string> names;
  for (auto& [name, entry] : all) names.push_back(name);
  for (const auto& name : names) {
    std::set<std::string> open;
    resolve(name, all, open);
  }
  for (const auto& name : names) {
    const Entry& e = all[name];
    FunctionCycles f;
    f.name = name, f.file = e.file, f.line = e.line, f.is_library = e.is_library;
    f.is_interrupt = name.size() > 10 && name[0] == '_' && name.find("Interrupt") == name.size() - 9;
    double extra = f.is_interrupt ? kInterruptCycles : 0;
    f.min = e.cycles[0] < 0 ? -1 : e.cycles[0] + extra;
    f.mean = e.cycles[1] + extra;
    f.max = e.cycles[2] < 0 ? -1 : e.cycles[2] + extra;
    if (f.max >= 0)
      f.mean = std::min(f.mean, f.max);  // the mean assumes ten rounds a loop; the bound may know better
    result.push_back(f);
  }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return result;
}

}  // namespace cc
