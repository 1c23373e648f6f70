// SPDX-License-Identifier: MIT
#include "hal_sim/host/program_data.h"

#include <array>

namespace host {

namespace {

constexpr std::size_t kMostBytes = 8;  // of a number
using Bytes = std::array<char, kMostBytes>;

}  // namespace

const Variable* ProgramData::find_number(const std::string& expression, std::string& error) const {
  const Variable* const found = find_variable(expression, error);
  if (!found || (found->kind != Variable::Kind::Aggregate && found->bytes <= kMostBytes)) return found;
  error = "got '" + expression + "', expected a number; name a member or element";
  return nullptr;
}

double ProgramData::number(const Variable& variable) const {
  Bytes bytes{};
  read_memory(variable.address, bytes.data(), variable.bytes);
  return variable_value(variable, bytes.data());
}

bool ProgramData::set_number(const Variable& variable, double value) {
  Bytes bytes{};
  read_memory(variable.address, bytes.data(), variable.bytes);
  const Bytes before = bytes;
  set_variable_value(variable, bytes.data(), value);
  write_memory(variable.address, bytes.data(), variable.bytes);
  return bytes != before;
}

}  // namespace host
