// SPDX-License-Identifier: MIT
// Names and expressions of the debugger: variables by their symbols, registers by the chip's table.
#include <fmt/format.h>

#include <cstring>
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

// registers are data, too
std::optional<unsigned> Session::address_of(const dspic::DebugInfo::Found& found) const {
  using In = dspic::DebugInfo::Place::In;
  const auto* const place = dspic::DebugInfo::place_at(*found.variable, pc());
  if (!place || place->in == In::Value) return {};
  const auto value = static_cast<unsigned>(place->value);
  const unsigned base = place->in == In::Register ? 2 * value
                        : place->in == In::Frame  ? value + read(2 * static_cast<unsigned>(place->base), 2)
                                                  : value;
  return (base + found.offset) & 0xFFFF;
}

std::string Session::typed(const dspic::DebugInfo::Found& found) const {
  using Kind = dspic::DebugInfo::Kind;
  constexpr unsigned kMostElements = 32;
  const auto& debug = file().debug;
  const auto& type = debug.types[static_cast<std::size_t>(found.type)];
  dspic::DebugInfo::Found part = found;
  if (type.kind == Kind::Array) {
    std::string text;
    for (unsigned i = 0; i < std::min(type.count, kMostElements); ++i) {
      part.type = type.element;
      part.offset = found.offset + i * debug.types[static_cast<std::size_t>(type.element)].bytes;
      text += (i > 0 ? ", " : "") + typed(part);
    }
    return "{" + text + (type.count > kMostElements ? ", ..." : "") + "}";
  }
  if (type.kind == Kind::Struct) {
    std::string text;
    for (const auto& member : type.members) {
      part = {found.variable, member.type, found.offset + member.offset, member.bit, member.width};
      text += (text.empty() ? "" : ", ") + (member.name.empty() ? "" : member.name + " = ") + typed(part);
    }
    return "{" + text + "}";
  }
  const auto* const place = dspic::DebugInfo::place_at(*found.variable, pc());
  if (!place) return "(not kept here)";
  const auto address = address_of(found);
  if (type.bytes == 0 || type.bytes > 8) return "(of no known type)";
  std::uint64_t raw = address ? 0 : static_cast<std::uint64_t>(std::int64_t{place->value});
  if (address) runner_->read_memory(*address, &raw, type.bytes);
  if (type.kind == Kind::Float) {
    float number;
    std::memcpy(&number, &raw, sizeof number);
    return fmt::format("{}", number);
  }
  const unsigned bits = found.width > 0 ? static_cast<unsigned>(found.width) : 8 * type.bytes;
  const std::uint64_t value = raw << (64 - bits - static_cast<unsigned>(found.bit)) >> (64 - bits);
  if (type.kind == Kind::Pointer) return fmt::format("{:#06x}", value);
  if (type.kind == Kind::Signed && (value >> (bits - 1) & 1))
    return fmt::format("{} ({:#x})", static_cast<std::int64_t>(value << (64 - bits)) >> (64 - bits), value);
  return fmt::format("{} ({:#x})", value, value);
}

std::string Session::locals() const {
  std::string text;
  for (const auto& variable : file().debug.variables)
    if (pc() >= variable.begin && pc() < variable.end)
      text += "  " + variable.name + " = " + typed({&variable, variable.type}) + "\n";
  return text.empty() ? "no variables of a function are known here\n" : text;
}

std::optional<Session::Data> Session::find_data(const std::string& name) const {
  dspic::DebugInfo::Found found;
  std::string error;
  if (file().debug.find(name, pc(), found, error))
    if (const auto address = address_of(found)) {
      const auto& type = file().debug.types[static_cast<std::size_t>(found.type)];
      return Data{*address, type.bytes, found.bit, found.width, type.kind == dspic::DebugInfo::Kind::Signed};
    }
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
      const int bits = data->width > 0 ? data->width : 8 * static_cast<int>(std::min(data->bytes, 4u));
      if (data->is_signed && bits > 0 && (out >> (bits - 1) & 1)) out -= std::int64_t{1} << bits;
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
