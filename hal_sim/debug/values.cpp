// SPDX-License-Identifier: MIT
// Names and values of the debugger: variables by their symbols and types, registers by the chip's table.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hal_sim/debug/program_names.h"
#include "hal_sim/debug/session.h"

namespace debug {

namespace {

using Kind = dspic::DebugInfo::Kind;

/// "-5536 (0xea60)", "1.5", "0x0a3c": as the type wants it.
std::string number_text(const CValue& value) {
  const CType& type = value.type;
  if (type.stars > 0) return fmt::format("{:#06x}", value.raw);
  if (type.is_float())
    return type.bits > 32 ? fmt::format("{}", value.real) : fmt::format("{}", static_cast<float>(value.real));
  const bool is_whole = type.bits >= 64 || type.bits == 0;
  const std::uint64_t raw = is_whole ? value.raw : value.raw & ((std::uint64_t{1} << type.bits) - 1);
  const bool is_negative = type.kind == CType::Kind::Signed && static_cast<std::int64_t>(value.raw) < 0;
  return is_negative ? fmt::format("{} ({:#x})", static_cast<std::int64_t>(value.raw), raw)
                     : fmt::format("{} ({:#x})", raw, raw);
}

}  // namespace

bool Session::compute(const std::string& expression, Want want, CValue& value, std::string& error,
                      std::optional<std::uint32_t> at_pc) const {
  return compute_in(ProgramNames(machine_->runner(), at_pc), expression, want, at_pc.has_value(), value,
                    error);
}

bool Session::evaluate(const std::string& expression, std::int64_t& value, std::string& error,
                       std::optional<std::uint32_t> at_pc) const {
  CValue number;
  if (!compute(expression, Want::Number, number, error, at_pc)) return false;
  value = number.whole();
  return true;
}

ProgramNames Session::names() const { return ProgramNames(machine_->runner()); }

std::uint64_t Session::read(const Data& data) const { return names().read(data); }

// --- parts of variables

std::string Session::typed(const Part& whole) const {
  constexpr unsigned kMostElements = 32;
  const auto& debug = file().debug.info();
  const auto& type = debug.types[static_cast<std::size_t>(whole.found.type)];
  Part part = whole;
  if (type.kind == Kind::Array) {
    std::string text;
    for (unsigned i = 0; i < std::min(type.count, kMostElements); ++i) {
      part.found.type = type.element;
      part.found.offset = whole.found.offset + i * debug.types[static_cast<std::size_t>(type.element)].bytes;
      text += (i > 0 ? ", " : "") + typed(part);
    }
    return "{" + text + (type.count > kMostElements ? ", ..." : "") + "}";
  }
  if (type.kind == Kind::Struct) {
    std::string text;
    for (const auto& member : type.members) {
      part.found = {whole.found.variable, member.type, whole.found.offset + member.offset, member.bit,
                    member.width};
      text += (text.empty() ? "" : ", ") + (member.name.empty() ? "" : member.name + " = ") + typed(part);
    }
    return "{" + text + "}";
  }
  if (type.bytes == 0 || type.bytes > 8) return "(of no known type)";
  const auto raw = names().raw_value(whole);
  if (!raw) return "(not kept here)";
  CValue value;
  value.type = type_of(debug, whole.found.type);
  if (whole.found.width > 0) value.type.bits = static_cast<unsigned>(whole.found.width);
  value.raw = *raw;
  if (value.type.is_float() && value.type.bits > 32) {
    std::memcpy(&value.real, &*raw, sizeof value.real);
  } else if (value.type.is_float()) {
    float number;
    std::memcpy(&number, &*raw, sizeof number);
    value.real = static_cast<double>(number);
  } else if (value.type.stars == 0 && value.type.kind == CType::Kind::Signed) {
    const unsigned spare = 64 - bits_of(type, whole.found);
    value.raw = static_cast<std::uint64_t>(static_cast<std::int64_t>(*raw << spare) >> spare);
  }
  return number_text(value);
}

std::string Session::shown(const CValue& value) const {
  return value.part ? typed(*value.part) : number_text(value);
}

std::string Session::locals() const {
  std::string text;
  for (const auto& variable : file().debug.info().variables)
    if (pc() >= variable.begin && pc() < variable.end)
      text += "  " + variable.name + " = " + typed({{&variable, variable.type}, {}, pc()}) + "\n";
  return text.empty() ? "no variables of a function are known here\n" : text;
}

std::optional<Data> Session::place_of(const CValue& value) const {
  if (!value.part) return value.data;
  const auto address = names().address_of(*value.part);
  if (!address) return {};
  const dspic::DebugInfo::Found& found = value.part->found;
  return Data{*address, bytes_of(file().debug.info().types[static_cast<std::size_t>(found.type)], found),
              found.bit, found.width};
}

std::optional<Data> Session::find_data(const std::string& name) const {
  CValue value;
  std::string error;
  if (compute(name, Want::Place, value, error))
    if (const auto place = place_of(value); place && value.part) return place;
  // a symbol is as large as it is, a register's place its own
  if (const auto known = names().find_untyped(name)) return known;
  return error.empty() ? value.data : std::nullopt;
}

bool Session::assign(const std::string& name, const std::string& expression, std::string& error) {
  CValue to, value;
  if (!compute(expression, Want::Number, value, error)) return false;
  const auto data = find_data(name);
  const bool is_typed = compute(name, Want::Place, to, error) && (to.part || to.data);
  if (!data || data->bytes > 8 || (is_typed && to.type.kind == CType::Kind::Image && to.type.stars == 0)) {
    error = "got '" + name + "', expected a variable of up to 8 bytes or a register";
    return false;
  }
  // as an assignment of C converts it
  const CValue held = is_typed ? converted(value, to.type) : value;
  std::uint64_t raw = held.raw;
  if (held.type.is_float() && held.type.bits > 32) {
    std::memcpy(&raw, &held.real, sizeof raw);
  } else if (held.type.is_float()) {
    const auto number = static_cast<float>(held.real);
    raw = 0;
    std::memcpy(&raw, &number, sizeof number);
  }
  if (write(*data, raw)) return true;
  error = "got '" + name + "', expected a variable of up to 8 bytes or a register";
  return false;
}

}  // namespace debug
