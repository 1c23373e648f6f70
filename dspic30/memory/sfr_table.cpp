// SPDX-License-Identifier: MIT
#include "dspic30/memory/sfr_table.h"

#include <cstdlib>
#include <sstream>

namespace dspic {

void detail::no_such_register() { std::abort(); }

namespace {

std::array<const SfrInfo*, kSfrBytes / 2> by_address() {
  std::array<const SfrInfo*, kSfrBytes / 2> table{};
  for (const SfrInfo& row : kSfrRows) table[row.address / 2] = &row;
  return table;
}

}  // namespace

const SfrInfo* sfr_info(unsigned address) {
  static const auto table = by_address();
  return address < kSfrBytes ? table[address / 2] : nullptr;
}

const SfrInfo* sfr_named(const std::string& name) {
  for (const SfrInfo& row : kSfrRows)
    if (name == row.name) return &row;
  return nullptr;
}

std::vector<SfrField> fields_of(const SfrInfo& info) {
  std::vector<SfrField> all;
  std::istringstream fields(info.fields);
  for (std::string field; fields >> field;) {
    const auto first = field.find(':'), second = field.find(':', first + 1);
    all.push_back({field.substr(0, first), std::atoi(field.c_str() + first + 1),
                   std::atoi(field.c_str() + second + 1)});
  }
  return all;
}

std::string sfr_bit_name(const SfrInfo& info, int bit) {
  for (const SfrField& field : fields_of(info))
    if (bit >= field.bit && bit < field.bit + field.width) return std::string(info.name) + "." + field.name;
  return std::string(info.name) + "." + std::to_string(bit);
}

}  // namespace dspic
