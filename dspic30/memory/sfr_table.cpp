// SPDX-License-Identifier: MIT
#include "dspic30/memory/sfr_table.h"

#include <array>
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

std::string sfr_bit_name(const SfrInfo& info, int bit) {
  std::istringstream fields(info.fields);
  std::string field;
  while (fields >> field) {
    const auto first = field.find(':'), second = field.find(':', first + 1);
    const int lsb = std::atoi(field.c_str() + first + 1), width = std::atoi(field.c_str() + second + 1);
    if (bit >= lsb && bit < lsb + width) return std::string(info.name) + "." + field.substr(0, first);
  }
  return std::string(info.name) + "." + std::to_string(bit);
}

}  // namespace dspic
