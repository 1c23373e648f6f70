// SPDX-License-Identifier: MIT
#include "hal_sim/chip/coverage.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "dspic30/memory/program_memory.h"
#include "sim_core/base/hash.h"

namespace chip {

namespace {

/// A sum of a source's text; empty: it cannot be read.
std::string version_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return "";
  std::uint64_t sum = 0;
  for (std::istreambuf_iterator<char> at(in), end; at != end; ++at)
    sum = sim::mix64(sum ^ static_cast<unsigned char>(*at));
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum));
  return text;
}

class Collector {
 public:
  Collector(const dspic::FirmwareFile& file, const StepCounts* counts,
            const std::function<bool(const std::string&)>& is_own)
      : file_(file), counts_(counts), sources_(file.code.lines().files.size()) {
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (is_own(file.code.lines().files[i])) sources_[i] = &lcov_.sources[file.code.lines().files[i]];
  }

  Lcov collect() {
    lines();
    branches();
    functions();
    left_out();
    for (auto at = lcov_.sources.begin(); at != lcov_.sources.end();) {
      at->second.version = version_of(at->first);
      at = at->second.lines.empty() ? lcov_.sources.erase(at) : std::next(at);
    }
    return std::move(lcov_);
  }

 private:
  using Row = dspic::CodeMap::Line;
  std::uint64_t ran(std::uint32_t address) const { return counts_ ? counts_->ran(address) : 0; }
  Lcov::Source* source_of(const Row& row) const { return row.line > 0 ? sources_[row.file] : nullptr; }

  // within a function the busiest piece counts, several functions hold copies of it
  void lines() {
    std::map<std::tuple<std::uint16_t, int, std::uint32_t>, std::uint64_t> pieces;
    const auto& rows = file_.code.lines().rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool has_code = i + 1 < rows.size() && rows[i + 1].address > rows[i].address;
      if (!source_of(rows[i]) || !has_code || !file_.words.count(rows[i].address)) continue;
      const auto* const function = file_.code.function_at(rows[i].address);
      auto& count = pieces[{rows[i].file, rows[i].line, function ? function->begin : 0}];
      count = std::max(count, ran(rows[i].address));
    }
    for (const auto& [piece, count] : pieces)
      sources_[std::get<0>(piece)]->lines[std::get<1>(piece)] += count;
  }

  void branches() {
    // of a line so far, in each function that holds a copy of it
    std::map<std::tuple<std::uint16_t, int, std::uint32_t>, int> conditions;
    for (const auto& [address, word] : file_.words) {
      if (address >= dspic::kFlashEnd) break;
      const Row* const row = is_conditional(word) ? file_.code.line_at(address) : nullptr;
      Lcov::Source* const source = row ? source_of(*row) : nullptr;
      if (!source) continue;
      const auto* const function = file_.code.function_at(address);
      const int block = conditions[{row->file, row->line, function ? function->begin : 0}]++;
      const std::uint64_t all = ran(address), jumped = counts_ ? counts_->jumped(address) : 0;
      add(source->branches[{row->line, block, 0}], all > 0, all - jumped);
      add(source->branches[{row->line, block, 1}], all > 0, jumped);
    }
  }

  static void add(Lcov::Ways& ways, bool is_known, std::uint64_t count) {
    ways.is_known |= is_known;
    ways.count += count;
  }

  void functions() {
    for (const auto& f : file_.code.functions) {
      const Row* const row = file_.code.line_at(f.begin);
      Lcov::Source* const source = row && row->address == f.begin ? source_of(*row) : nullptr;
      if (!source) continue;
      const int declared = line_of(f.name, f.begin);
      Lcov::Function& function = source->functions[f.name];  // a static one of a header: several
      function.line = declared > 0 ? declared : row->line;
      function.calls += ran(f.begin);
    }
  }

  /// Where a function's name stands; 0: nobody says.
  int line_of(const std::string& name, std::uint32_t begin) const {
    for (const auto& f : file_.debug.value().functions)
      if (f.begin == begin && f.name == name) return f.line;
    return 0;
  }

  // a function of its own each: the one that was declared last before it
  void left_out() {
    const auto& rows = file_.code.lines().left_out;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Lcov::Source* const source = source_of(rows[i]);
      if (!source) continue;
      source->lines[rows[i].line];
      if (i > 0 && !rows[i - 1].is_end) continue;
      const dspic::DebugInfo::Function* last = nullptr;
      for (const auto& f : file_.debug.value().functions)
        if (f.is_left_out && f.line <= rows[i].line && (!last || f.line > last->line) &&
            dspic::source_of(file_, f) == rows[i].file)
          last = &f;
      if (last) source->functions.emplace(last->name, Lcov::Function{last->line, 0});
    }
  }

  const dspic::FirmwareFile& file_;
  const StepCounts* const counts_;
  Lcov lcov_;
  std::vector<Lcov::Source*> sources_;  // by number of the file; null: does not count
};

}  // namespace

Lcov coverage_of(const dspic::FirmwareFile& file, const StepCounts* counts,
                 const std::function<bool(const std::string&)>& is_own) {
  return Collector(file, counts, is_own).collect();
}

}  // namespace chip
