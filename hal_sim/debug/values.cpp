// SPDX-License-Identifier: MIT
// Names and expressions of the debugger: variables by their symbols, registers by the chip's table.
#include <sstream>

#include "dspic30/asm/expression.h"
#include "dspic30/memory/sfr_table.h"
#include "hal_sim/debug/session.h"

namespace debug {

namespace {

/// A field's place within its register; width 0: there is none of that name.
void find_field(const dspic::SfrInfo& info, const std::string& name, int& bit, int& width) {
  std::istringstream fields(info.fields);
  for (std::string field; fields >> field;) {
    const auto first = field.find(':'), second = field.find(':', first + 1);
    if (field.substr(0, first) != name) continue;
    bit = std::stoi(field.substr(first + 1));
    width = std::stoi(field.substr(second + 1));
    return;
  }
}

}  // namespace

std::optional<Session::Data> Session::find_data(const std::string& name) const {
  if (const auto object = file().objects.find(name); object != file().objects.end()) {
    const auto bytes = file().object_bytes.find(name);
    return Data{object->second, bytes == file().object_bytes.end() ? 2u : bytes->second};
  }
  if (name == "sp") return Data{2 * 15, 2};
  if (name == "sr") return Data{dspic::sfr("SR"), 2};
  if (name.size() >= 2 && name.size() <= 3 && (name[0] == 'w' || name[0] == 'W') &&
      name.find_first_not_of("0123456789", 1) == std::string::npos && std::stoi(name.substr(1)) < 16)
    return Data{2 * static_cast<unsigned>(std::stoi(name.substr(1))), 2};
  // REG, REG.FIELD, REGbits.FIELD
  const std::size_t dot = name.find('.');
  std::string of = name.substr(0, dot);
  if (dot != std::string::npos && of.size() > 4 && of.compare(of.size() - 4, 4, "bits") == 0)
    of.resize(of.size() - 4);
  const dspic::SfrInfo* info = dspic::sfr_named(of);
  if (!info) return {};
  Data data{info->address, 2};
  if (dot == std::string::npos) return data;
  find_field(*info, name.substr(dot + 1), data.bit, data.width);
  return data.width > 0 ? std::optional(data) : std::nullopt;
}

unsigned Session::read(unsigned address, unsigned bytes) const {
  unsigned value = 0;
  runner_->read_memory(address, &value, std::min(bytes, 4u));
  return value;
}

bool Session::evaluate(const std::string& expression, std::int64_t& value, std::string& error) const {
  const auto symbols = [this](const std::string& name, std::int64_t& out) {
    if (name == "pc")
      out = static_cast<std::int64_t>(pc());
    else if (name == "cycle")
      out = now();
    else if (name == "nesting")
      out = runner_->device().nesting();
    else if (const auto data = find_data(name)) {
      out = read(data->address, data->bytes);
      if (data->width > 0) out = out >> data->bit & ((1 << data->width) - 1);
    } else if (const auto code = file().functions.find(name); code != file().functions.end()) {
      out = code->second;
    } else {
      return false;
    }
    return true;
  };
  return dspic::assembly::evaluate(
      expression, symbols, [](std::int64_t a) { return a; }, value, error);
}

}  // namespace debug
