// SPDX-License-Identifier: MIT
#include "dspic30/routines/known_routines.h"

#include <algorithm>
#include <unordered_map>

namespace dspic {

namespace {

using Table = std::unordered_multimap<std::uint64_t, const KnownRoutine*>;

Table make_table() {
  Table table;
  for (const KnownRoutine* routine : known_routines()) table.emplace(routine->code, routine);
  return table;
}

// symbols come without the underscore that C puts before each
const char* plain_name(const KnownRoutine& routine) { return routine.name + 1; }

// where an image has no symbols, functions are named by their place
bool is_symbol(const std::string& name) { return name.rfind("sub_", 0) != 0; }

bool is_known_name(const std::string& name) {
  static const auto names = [] {
    std::vector<std::string> all;
    for (const KnownRoutine* routine : known_routines()) all.emplace_back(plain_name(*routine));
    std::sort(all.begin(), all.end());
    return all;
  }();
  return std::binary_search(names.begin(), names.end(), name);
}

}  // namespace

std::vector<const KnownRoutine*> known_routines() {
  std::vector<const KnownRoutine*> all;
  for (const auto* of_kind :
       {&long_division_routines(), &long_long_routines(), &float_routines(), &float_comparison_routines(),
        &float_conversion_routines(), &float_root_routines(), &memory_routines(), &i2c_routines()})
    for (const KnownRoutine& routine : *of_kind) all.push_back(&routine);
  return all;
}

const KnownRoutine* find_known(const std::string& name, const ProgramMemory& program, unsigned address) {
  static const Table table = make_table();
  if (is_symbol(name) && !name.empty() && !is_known_name(name)) return nullptr;
  for (const bool hides_variable : {false, true}) {
    const std::uint64_t code = code_sum(program, address, hides_variable);
    const auto [first, last] = table.equal_range(code);
    for (auto found = first; code != 0 && found != last; ++found)
      if (name.empty() || !is_symbol(name) || name == plain_name(*found->second)) return found->second;
  }
  return nullptr;
}

std::shared_ptr<const KnownCalls> known_calls(const std::map<std::string, std::uint32_t>& functions,
                                              const ProgramMemory& program) {
  auto calls = std::make_shared<KnownCalls>();
  for (const auto& [name, address] : functions)
    if (const KnownRoutine* const routine = find_known(name, program, address)) calls->add(address, *routine);
  calls->add_handlers(uart_handler());
  return calls;
}

}  // namespace dspic
