// SPDX-License-Identifier: MIT
// Names and expressions of the debugger: variables by their symbols, registers by the chip's table.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

#include "dspic30/asm/expression.h"
#include "dspic30/memory/sfr_table.h"
#include "hal_sim/debug/session.h"

namespace debug {

namespace {

using Kind = dspic::DebugInfo::Kind;
using In = dspic::DebugInfo::Place::In;

unsigned bits_of(const dspic::DebugInfo::Type& type, const dspic::DebugInfo::Found& found) {
  return found.width > 0 ? static_cast<unsigned>(found.width) : 8 * type.bytes;
}

float float_of(std::uint64_t raw) {
  float number;
  std::memcpy(&number, &raw, sizeof number);
  return number;
}

double number_of(std::uint64_t raw, unsigned bytes) {
  double number;
  std::memcpy(&number, &raw, sizeof number);
  return bytes == sizeof number ? number : static_cast<double>(float_of(raw));
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

/// End of the name that begins at `at`.
std::size_t end_of_name(const std::string& text, std::size_t at) {
  while (at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_')) ++at;
  return at;
}

/// End of the step .NAME, ->NAME or [INDEX] that begins at `at`; `at` itself: none does.
std::size_t end_of_step(const std::string& text, std::size_t at) {
  if (text.compare(at, 1, ".") == 0 || text.compare(at, 2, "->") == 0) {
    const std::size_t name = at + (text[at] == '.' ? 1 : 2), end = end_of_name(text, name);
    return end > name ? end : at;
  }
  if (text.compare(at, 1, "[") != 0) return at;
  int depth = 0;
  for (std::size_t end = at; end < text.size(); ++end) {
    depth += (text[end] == '[') - (text[end] == ']');
    if (depth == 0) return end + 1;
  }
  return at;
}

/// End of the variable, or part of one, that begins at `at`; `at` itself: none does.
std::size_t end_of_part(const std::string& text, std::size_t at) {
  const std::size_t begin = at;
  while (at < text.size() && (text[at] == '*' || text[at] == ' ')) ++at;
  std::size_t end = at;
  if (at < text.size() && !std::isdigit(static_cast<unsigned char>(text[at]))) end = end_of_name(text, at);
  if (end == at) return begin;
  for (std::size_t next = end_of_step(text, end); next != end; next = end_of_step(text, end)) end = next;
  return end;
}

}  // namespace

// --- parts of variables

bool Session::find_part(const std::string& expression, Part& part, std::string& error,
                        std::optional<std::uint32_t> at_pc) const {
  const std::string text = dspic::assembly::trimmed(expression);
  const auto wrong = [&](const std::string& why) {
    error = "got '" + text + "', " + why;
    return false;
  };
  if (!text.empty() && text[0] == '*')
    return find_part(text.substr(1), part, error, at_pc) && (point(part, 0, error) || wrong(error));
  part = {{}, {}, at_pc.value_or(pc()), at_pc.has_value()};
  std::size_t at = end_of_name(text, 0);
  if (!file().debug.find(text.substr(0, at), part.pc, part.found, error)) return false;
  while (at < text.size()) {
    const std::size_t end = end_of_step(text, at);
    if (end == at) return wrong("expected NAME, then .MEMBER, ->MEMBER and [INDEX] as C writes them");
    std::string step = text.substr(at, end - at);
    at = end;
    if (step[0] == '-') {
      if (!point(part, 0, error)) return wrong(error);
      step = step.substr(1);
      step[0] = '.';
    }
    if (step[0] == '[') {
      std::int64_t index = 0;
      if (!evaluate(step.substr(1, step.size() - 2), index, error, at_pc)) return false;
      if (file().debug.types[static_cast<std::size_t>(part.found.type)].kind == Kind::Pointer) {
        if (!point(part, index, error)) return wrong(error);
        continue;
      }
      step = "[" + std::to_string(index) + "]";
    }
    if (!file().debug.follow(step, part.found, error)) return wrong(error);
  }
  return true;
}

// from a pointer to what it points to
bool Session::point(Part& part, std::int64_t index, std::string& error) const {
  const auto& type = file().debug.types[static_cast<std::size_t>(part.found.type)];
  const unsigned bytes = file().debug.types[static_cast<std::size_t>(type.element)].bytes;
  const auto to = raw_value(part);
  if (type.kind != Kind::Pointer || bytes == 0)
    error = "expected a pointer to something of a known type";
  else if (!to)
    error = "but the optimiser keeps it nowhere here";
  else {
    part.pointed =
        static_cast<Address>(static_cast<std::int64_t>(*to) + index * bytes) & machine_->address_mask();
    part.found = {nullptr, type.element};
    return true;
  }
  return false;
}

// registers are data, too
std::optional<Address> Session::address_of(const Part& part) const {
  const Address mask = machine_->address_mask();
  if (part.pointed) return (*part.pointed + part.found.offset) & mask;
  const auto* const place = dspic::DebugInfo::place_at(*part.found.variable, part.pc);
  if (!place || place->in == In::Value) return {};
  Address base = static_cast<Address>(static_cast<std::int64_t>(place->value));
  if (place->in == In::Frame) {
    base += machine_->register_value(place->base);
  } else if (place->in == In::Memory) {
    base += machine_->data_base();
  } else {
    const auto data = machine_->register_data(place->value);
    if (!data) return {};
    base = data->address;
  }
  return (base + part.found.offset) & mask;
}

/// Its bits, from the lowest on; none: it is kept nowhere, or no number.
std::optional<std::uint64_t> Session::raw_value(const Part& part) const {
  const auto& type = file().debug.types[static_cast<std::size_t>(part.found.type)];
  if (type.bytes == 0 || type.bytes > 8 || type.kind == Kind::Array || type.kind == Kind::Struct) return {};
  std::uint64_t raw = 0;
  if (const auto address = address_of(part)) {
    if (!machine_->read({*address, type.bytes}, &raw) && !part.is_elsewhere) return {};
  } else {
    const auto* const place = dspic::DebugInfo::place_at(*part.found.variable, part.pc);
    if (!place) return {};
    raw = place->in == In::Register ? machine_->register_value(place->value)
                                    : static_cast<std::uint64_t>(std::int64_t{place->value});
  }
  const unsigned bits = bits_of(type, part.found);
  return raw << (64 - bits - static_cast<unsigned>(part.found.bit)) >> (64 - bits);
}

// an array counts as its address
bool Session::value_of(const Part& part, std::int64_t& value) const {
  const auto& type = file().debug.types[static_cast<std::size_t>(part.found.type)];
  if (const auto address = address_of(part); address && type.kind == Kind::Array) {
    value = static_cast<std::int64_t>(*address);
    return true;
  }
  const auto raw = raw_value(part);
  if (!raw) return false;
  if (type.kind == Kind::Float) {
    const double number = number_of(*raw, type.bytes);
    constexpr double kMost = 9e18;
    value = std::isnan(number) ? 0 : static_cast<std::int64_t>(std::clamp(number, -kMost, kMost));
    return true;
  }
  const unsigned bits = bits_of(type, part.found);
  value = static_cast<std::int64_t>(*raw);
  if (type.kind == Kind::Signed) value = static_cast<std::int64_t>(*raw << (64 - bits)) >> (64 - bits);
  return true;
}

std::string Session::typed(const Part& whole) const {
  constexpr unsigned kMostElements = 32;
  const auto& debug = file().debug;
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
  const auto raw = raw_value(whole);
  if (!raw) return "(not kept here)";
  if (type.kind == Kind::Float)
    return type.bytes == sizeof(double) ? fmt::format("{}", number_of(*raw, type.bytes))
                                        : fmt::format("{}", float_of(*raw));
  if (type.kind == Kind::Pointer) return fmt::format("{:#06x}", *raw);
  std::int64_t value = 0;
  value_of(whole, value);
  return value < 0 ? fmt::format("{} ({:#x})", value, *raw) : fmt::format("{} ({:#x})", *raw, *raw);
}

std::string Session::locals() const {
  std::string text;
  for (const auto& variable : file().debug.variables)
    if (pc() >= variable.begin && pc() < variable.end)
      text += "  " + variable.name + " = " + typed({{&variable, variable.type}, {}, pc(), false}) + "\n";
  return text.empty() ? "no variables of a function are known here\n" : text;
}

std::optional<Data> Session::find_data(const std::string& name) const {
  Part part;
  std::string error;
  if (find_part(name, part, error))
    if (const auto address = address_of(part)) {
      const auto& type = file().debug.types[static_cast<std::size_t>(part.found.type)];
      return Data{*address, type.bytes, part.found.bit, part.found.width};
    }
  return find_untyped(name);
}

std::optional<Data> Session::find_untyped(const std::string& name) const {
  if (const auto object = file().objects.find(name); object != file().objects.end()) {
    const auto bytes = file().object_bytes.find(name);
    return Data{machine_->data_base() + object->second,
                bytes == file().object_bytes.end() ? 2u : bytes->second};
  }
  return machine_->find_register(name);
}

std::uint64_t Session::read(const Data& data) const {
  std::uint64_t value = 0;
  Data some = data;
  some.bytes = std::min(data.bytes, 8u);
  if (!machine_->read(some, &value)) return 0;
  return data.width > 0 ? value >> data.bit & ((std::uint64_t{1} << data.width) - 1) : value;
}

bool Session::evaluate(const std::string& expression, std::int64_t& value, std::string& error,
                       std::optional<std::uint32_t> at_pc) const {
  if (is_too_deep(expression)) {
    error = "got '" + expression + "', expected at most 8 [ or * within one another";
    return false;
  }
  const auto symbols = [&](const std::string& name, std::int64_t& out) {
    Part part;
    std::string why;
    if (find_part(name, part, why, at_pc) && value_of(part, out)) return true;
    if (name == "pc")
      out = static_cast<std::int64_t>(pc());
    else if (name == "cycle")
      out = now();
    else if (name == "nesting")
      out = machine_->nesting();
    else if (const auto data = find_untyped(name)) {
      Data some = *data;
      some.bytes = std::min(data->bytes, 4u);
      out = static_cast<std::int64_t>(read(some));
    } else if (const auto code = file().functions.find(name); code != file().functions.end()) {
      out = code->second;
    } else {
      return false;
    }
    return true;
  };
  // what the expressions of assembler text do not have: [ ], -> and the * before a pointer
  std::string text;
  bool is_operand = true;  // what comes next is one, or the sign before one
  for (std::size_t at = 0; at < expression.size();) {
    const auto c = static_cast<unsigned char>(expression[at]);
    std::size_t end = at + 1;
    if (is_operand && !std::isspace(c)) end = std::max(end, end_of_part(expression, at));
    if (std::isdigit(c)) end = end_of_name(expression, at);
    std::string piece = expression.substr(at, end - at);
    at = end;
    if (piece == "*" && is_operand) {
      error = "got '" + expression + "', expected a variable behind the *";
      return false;
    }
    if (piece[0] == '*' ? is_operand : piece.find_first_of("[>") != std::string::npos && piece.size() > 1) {
      Part part;
      std::int64_t number = 0;
      if (!find_part(piece, part, error, at_pc)) return false;
      if (!value_of(part, number)) {
        error = "got '" + piece + "', expected something that has a value here";
        return false;
      }
      piece = "(" + std::to_string(number) + ")";
    }
    text += piece;
    if (!std::isspace(c)) is_operand = piece.size() == 1 && !std::isalnum(c) && c != '_' && c != ')';
  }
  return dspic::assembly::evaluate(
      text, symbols, [](std::int64_t a) { return a; }, value, error);
}

}  // namespace debug
