// SPDX-License-Identifier: MIT
#include "hal_sim/debug/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dspic30/asm/expression.h"
#include "hal_sim/chip/program_places.h"
#include "hal_sim/debug/machine.h"

namespace debug {

namespace {

using Kind = dspic::DebugInfo::Kind;
using In = dspic::DebugInfo::Place::In;

unsigned bits_of(const dspic::DebugInfo::Type& type, const dspic::DebugInfo::Found& found) {
  return found.width > 0 ? static_cast<unsigned>(found.width) : 8 * type.bytes;
}

/// A bit-field may reach beyond the type that it was declared with.
unsigned bytes_of(const dspic::DebugInfo::Type& type, const dspic::DebugInfo::Found& found) {
  if (found.width <= 0) return type.bytes;
  return std::min(8u, std::max(type.bytes, (static_cast<unsigned>(found.bit + found.width) + 7) / 8));
}

/// Conditions are judged on a small stack.
bool is_too_deep(const std::string& expression) {
  constexpr int kMost = 8;
  int brackets = 0, stars = 0, deepest = 0;
  for (const char c : expression) {
    brackets += (c == '[') - (c == ']');
    stars = c == '*' ? stars + 1 : c == ' ' ? stars : 0;
    deepest = std::max({deepest, brackets, stars});
  }
  return deepest > kMost;
}

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

bool Values::find_variable(const std::string& scope, const std::string& name, Part& part) const {
  std::string none;
  part = {{}, {}, pc_};
  const auto is_of_scope = [&](const dspic::DebugInfo::Variable& v) {
    return scope.empty() || chip::ProgramPlaces::is_of(runner_.image()->file(), scope, v);
  };
  return debug_info().find(name, pc_, part.found, none, is_of_scope);
}

std::string Values::function_of(const std::string& local) const {
  for (const auto& v : debug_info().variables)
    if (const auto* function =
            v.name == local && v.end > 0 ? runner_.image()->file().code.function_at(v.begin) : nullptr)
      return function->name;
  return "";
}

bool Values::find_other(const std::string& name, CValue& value) const {
  const auto known = [&](CType::Kind kind, unsigned bits, std::int64_t raw) {
    value = {};
    value.type = {kind, bits};
    value.raw = static_cast<std::uint64_t>(raw);
    return true;
  };
  if (name == "pc") return known(CType::Kind::Signed, 64, runner_.processor().pc());
  if (name == "cycle") return known(CType::Kind::Signed, 64, runner_.processor().now());
  if (name == "nesting") return known(CType::Kind::Signed, 64, runner_.device().interrupts().nesting());
  if (const auto data = find_untyped(name)) {
    Data some = *data;
    some.bytes = std::min(data->bytes, 4u);
    known(CType::Kind::Unsigned, some.width > 0 ? static_cast<unsigned>(some.width) : 8 * some.bytes, 0);
    value.data = some;
    return true;
  }
  const auto code = runner_.image()->file().functions.find(name);
  return code != runner_.image()->file().functions.end() &&
         known(CType::Kind::Unsigned, code->second > 0xFFFF ? 32 : 16, code->second);
}

std::optional<std::uint64_t> Values::raw_value(const Data& data) const {
  if (data.bytes > 8) return {};
  return read(data);
}

bool Values::compute(const std::string& expression, Want want, CValue& value, std::string& error) const {
  if (!is_too_deep(expression))
    return debug::compute(*this, dspic::assembly::trimmed(expression), want, is_tried_, value, error);
  error = "got '" + expression + "', expected at most 8 [ or * within one another";
  return false;
}

bool Values::evaluate(const std::string& expression, std::int64_t& value, std::string& error) const {
  CValue number;
  if (!compute(expression, Want::Number, number, error)) return false;
  value = number.whole();
  return true;
}

// --- parts of variables

std::optional<Data> Values::register_at(int n) const {
  if (!frame_ || static_cast<std::size_t>(n) >= frame_->registers.size()) return Machine::register_data(n);
  const Address at = frame_->registers[static_cast<std::size_t>(n)];
  if (at == kLost) return {};
  return Data{at};
}

// registers are data, too
std::optional<Address> Values::address_of(const Part& part) const {
  if (part.pointed) return (*part.pointed + part.found.offset) & kAddressMask;
  const auto* const place = dspic::DebugInfo::place_at(*part.found.variable, part.pc);
  if (!place || place->in == In::Value) return {};
  Address base = static_cast<Address>(static_cast<std::int64_t>(place->value));
  if (place->in == In::Frame) {
    const auto from = register_at(place->base);
    if (!from) return {};
    constexpr int kStackPointer = 15;
    base += frame_ && place->base == kStackPointer ? frame_->sp : read(*from);
  } else if (place->in != In::Memory) {
    const auto in = register_at(place->value);
    if (!in) return {};
    base = in->address;
  }
  return (base + part.found.offset) & kAddressMask;
}

/// Its bits, from the lowest on; none: it is kept nowhere, or no number.
std::optional<std::uint64_t> Values::raw_value(const Part& part) const {
  const auto& type = debug_info().types[static_cast<std::size_t>(part.found.type)];
  if (type.bytes == 0 || type.bytes > 8 || type.kind == Kind::Array || type.kind == Kind::Struct) return {};
  std::uint64_t raw = 0;
  if (const auto address = address_of(part)) {
    raw = read({*address, bytes_of(type, part.found)});
  } else {
    const auto* const place = dspic::DebugInfo::place_at(*part.found.variable, part.pc);
    if (!place || place->in != In::Value) return {};
    raw = static_cast<std::uint64_t>(std::int64_t{place->value});
  }
  const unsigned bits = bits_of(type, part.found);
  return raw << (64 - bits - static_cast<unsigned>(part.found.bit)) >> (64 - bits);
}

std::optional<CValue> Values::number(const Part& whole) const {
  const auto raw = raw_value(whole);
  if (!raw) return {};
  return value_of(whole.found.type, whole.found.width, *raw);
}

CValue Values::value_of(int of_type, int width, std::uint64_t raw) const {
  const auto& debug = debug_info();
  const auto& type = debug.types[static_cast<std::size_t>(of_type)];
  CValue value;
  value.type = type_of(debug, of_type);
  if (width > 0) value.type.bits = static_cast<unsigned>(width);
  value.raw = raw;
  if (value.type.is_float() && value.type.bits > 32) {
    std::memcpy(&value.real, &raw, sizeof value.real);
  } else if (value.type.is_float()) {
    float number;
    std::memcpy(&number, &raw, sizeof number);
    value.real = static_cast<double>(number);
  } else if (value.type.stars == 0 && value.type.kind == CType::Kind::Signed) {
    const unsigned spare = 64 - (width > 0 ? static_cast<unsigned>(width) : 8 * type.bytes);
    value.raw = static_cast<std::uint64_t>(static_cast<std::int64_t>(raw << spare) >> spare);
  }
  return value;
}

std::optional<Values::Shape> Values::shape_of(const std::string& name) const {
  CValue value;
  std::string error;
  if (!compute(name, Want::Place, value, error) || !value.part || !raw_value(*value.part)) return {};
  return Shape{value.part->found.type, value.part->found.width};
}

std::string Values::brief(const std::optional<Shape>& shape, std::uint64_t raw) const {
  if (!shape) return std::to_string(raw);
  const std::string text = number_text(value_of(shape->type, shape->width, raw));
  return text.substr(0, text.find(" ("));
}

std::string Values::typed(const Part& whole) const {
  constexpr unsigned kMostElements = 32;
  const auto& debug = debug_info();
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
  const auto value = number(whole);
  return value ? number_text(*value) : "(not kept here)";
}

std::string Values::shown(const CValue& value) const {
  return value.part ? typed(*value.part) : number_text(value);
}

std::string Values::locals() const {
  std::string text;
  for (const auto& variable : debug_info().variables)
    if (pc_ >= variable.begin && pc_ < variable.end)
      text += "  " + variable.name + " = " + typed({{&variable, variable.type}, {}, pc_}) + "\n";
  return text.empty() ? "no variables of a function are known here\n" : text;
}

std::optional<Data> Values::place_of(const CValue& value) const {
  if (!value.part) return value.data;
  const auto address = address_of(*value.part);
  if (!address) return {};
  const dspic::DebugInfo::Found& found = value.part->found;
  return Data{*address, bytes_of(debug_info().types[static_cast<std::size_t>(found.type)], found), found.bit,
              found.width};
}

std::optional<Data> Values::find_data(const std::string& name) const {
  CValue value;
  std::string error;
  if (compute(name, Want::Place, value, error))
    if (const auto place = place_of(value); place && value.part) return place;
  // a symbol is as large as it is, a register's place its own
  if (const auto known = find_untyped(name)) return known;
  return error.empty() ? value.data : std::nullopt;
}

std::optional<Data> Values::find_untyped(const std::string& name) const {
  const auto& file = runner_.image()->file();
  if (const auto object = file.objects.find(name); object != file.objects.end()) {
    const auto bytes = file.object_bytes.find(name);
    return Data{object->second, bytes == file.object_bytes.end() ? 2u : bytes->second};
  }
  return Machine::find_register(name);
}

std::uint64_t Values::read(const Data& data) const {
  std::uint64_t value = 0;
  runner_.data().read_memory(data.address & kAddressMask, &value, std::min(data.bytes, 8u));
  return data.width > 0 ? value >> data.bit & ((std::uint64_t{1} << data.width) - 1) : value;
}

bool Values::assignment(const std::string& name, const std::string& expression, Data& to, std::uint64_t& raw,
                        std::string& error) const {
  CValue target, value;
  if (!compute(expression, Want::Number, value, error)) return false;
  const auto data = find_data(name);
  const bool is_typed = compute(name, Want::Place, target, error) && (target.part || target.data);
  if (!data || data->bytes > 8 ||
      (is_typed && target.type.kind == CType::Kind::Image && target.type.stars == 0)) {
    error = "got '" + name + "', expected a variable of up to 8 bytes or a register";
    return false;
  }
  const bool is_real = is_typed && target.type.is_float() && target.type.stars == 0;
  if (value.type.is_float() && !is_real && !(std::abs(value.real) < 9.2e18)) {
    error = fmt::format("got {:g}, expected a number of up to 64 bits", value.real);
    return false;
  }
  const CValue held = is_typed                ? converted(value, target.type)
                      : value.type.is_float() ? integer({}, static_cast<std::uint64_t>(value.whole()))
                                              : value;
  to = *data;
  raw = held.raw;
  if (held.type.is_float() && held.type.bits > 32) {
    std::memcpy(&raw, &held.real, sizeof raw);
  } else if (held.type.is_float()) {
    const auto number = static_cast<float>(held.real);
    raw = 0;
    std::memcpy(&raw, &number, sizeof number);
  }
  return true;
}

bool number_of(const chip::ChipRunner& runner, const std::string& expression, bool is_tried, double& value,
               std::string& error) {
  CValue number;
  if (!Values(runner, 0, is_tried).compute(expression, Want::Number, number, error)) return false;
  if (number.type.is_float())
    value = number.real;
  else if (number.type.kind == CType::Kind::Unsigned || number.type.stars > 0)
    value = static_cast<double>(number.raw);
  else
    value = static_cast<double>(static_cast<std::int64_t>(number.raw));
  return true;
}

}  // namespace debug
