// SPDX-License-Identifier: MIT
#include "hal_sim/debug/program_names.h"

#include <algorithm>

#include "dspic30/asm/expression.h"
#include "hal_sim/debug/machine.h"

namespace debug {

/// Conditions are judged on a small stack.
static bool is_too_deep(const std::string& expression) {
  constexpr int kMost = 8;
  int brackets = 0, stars = 0, deepest = 0;
  for (const char c : expression) {
    brackets += (c == '[') - (c == ']');
    stars = c == '*' ? stars + 1 : c == ' ' ? stars : 0;
    deepest = std::max({deepest, brackets, stars});
  }
  return deepest > kMost;
}

unsigned bits_of(const dspic::DebugInfo::Type& type, const dspic::DebugInfo::Found& found) {
  return found.width > 0 ? static_cast<unsigned>(found.width) : 8 * type.bytes;
}

unsigned bytes_of(const dspic::DebugInfo::Type& type, const dspic::DebugInfo::Found& found) {
  if (found.width <= 0) return type.bytes;
  return std::min(8u, std::max(type.bytes, (static_cast<unsigned>(found.bit + found.width) + 7) / 8));
}

ProgramNames::ProgramNames(const chip::ChipRunner& runner, std::optional<std::uint32_t> pc)
    : runner_(runner), pc_(pc.value_or(runner.processor().pc())) {}

const dspic::DebugInfo& ProgramNames::debug_info() const { return runner_.file().debug.info(); }

bool ProgramNames::find_variable(const std::string& name, Part& part) const {
  std::string none;
  part = {{}, {}, pc_};
  return debug_info().find(name, pc_, part.found, none);
}

bool ProgramNames::find_other(const std::string& name, CValue& value) const {
  const auto known = [&](CType::Kind kind, unsigned bits, std::int64_t raw) {
    value = {};
    value.type = {kind, bits};
    value.raw = static_cast<std::uint64_t>(raw);
    return true;
  };
  if (name == "pc") return known(CType::Kind::Signed, 64, runner_.processor().pc());
  if (name == "cycle") return known(CType::Kind::Signed, 64, runner_.processor().now());
  if (name == "nesting") return known(CType::Kind::Signed, 64, runner_.device().nesting());
  if (const auto data = find_untyped(name)) {
    Data some = *data;
    some.bytes = std::min(data->bytes, 4u);
    known(CType::Kind::Unsigned, some.width > 0 ? static_cast<unsigned>(some.width) : 8 * some.bytes, 0);
    value.data = some;
    return true;
  }
  const auto code = runner_.file().functions.find(name);
  return code != runner_.file().functions.end() &&
         known(CType::Kind::Unsigned, code->second > 0xFFFF ? 32 : 16, code->second);
}

// registers are data, too
std::optional<Address> ProgramNames::address_of(const Part& part) const {
  using In = dspic::DebugInfo::Place::In;
  if (part.pointed) return (*part.pointed + part.found.offset) & kAddressMask;
  const auto* const place = dspic::DebugInfo::place_at(*part.found.variable, part.pc);
  if (!place || place->in == In::Value) return {};
  Address base = static_cast<Address>(static_cast<std::int64_t>(place->value));
  if (place->in == In::Frame) {
    base += read(Machine::register_data(place->base));
  } else if (place->in != In::Memory) {
    base = Machine::register_data(place->value).address;
  }
  return (base + part.found.offset) & kAddressMask;
}

/// Its bits, from the lowest on; none: it is kept nowhere, or no number.
std::optional<std::uint64_t> ProgramNames::raw_value(const Part& part) const {
  using Kind = dspic::DebugInfo::Kind;
  using In = dspic::DebugInfo::Place::In;
  const auto& type = debug_info().types[static_cast<std::size_t>(part.found.type)];
  if (type.bytes == 0 || type.bytes > 8 || type.kind == Kind::Array || type.kind == Kind::Struct) return {};
  std::uint64_t raw = 0;
  if (const auto address = address_of(part)) {
    raw = read({*address, bytes_of(type, part.found)});
  } else {
    const auto* const place = dspic::DebugInfo::place_at(*part.found.variable, part.pc);
    if (!place) return {};
    raw = place->in == In::Register ? read(Machine::register_data(place->value))
                                    : static_cast<std::uint64_t>(std::int64_t{place->value});
  }
  const unsigned bits = bits_of(type, part.found);
  return raw << (64 - bits - static_cast<unsigned>(part.found.bit)) >> (64 - bits);
}

std::optional<std::uint64_t> ProgramNames::raw_value(const Data& data) const {
  if (data.bytes > 8) return {};
  return read(data);
}

std::optional<Data> ProgramNames::find_untyped(const std::string& name) const {
  const dspic::FirmwareFile& file = runner_.file();
  if (const auto object = file.objects.find(name); object != file.objects.end()) {
    const auto bytes = file.object_bytes.find(name);
    return Data{object->second, bytes == file.object_bytes.end() ? 2u : bytes->second};
  }
  return Machine::find_register(name);
}

std::uint64_t ProgramNames::read(const Data& data) const {
  std::uint64_t value = 0;
  runner_.read_memory(data.address & kAddressMask, &value, std::min(data.bytes, 8u));
  return data.width > 0 ? value >> data.bit & ((std::uint64_t{1} << data.width) - 1) : value;
}

bool compute_in(const ProgramNames& names, const std::string& expression, Want want, bool is_tried,
                CValue& value, std::string& error) {
  if (!is_too_deep(expression))
    return compute(names, dspic::assembly::trimmed(expression), want, is_tried, value, error);
  error = "got '" + expression + "', expected at most 8 [ or * within one another";
  return false;
}

bool number_of(const chip::ChipRunner& runner, const std::string& expression, bool is_tried, double& value,
               std::string& error) {
  CValue number;
  // names of functions' own variables mean nothing to somebody who looks at any time
  if (!compute_in(ProgramNames(runner, 0), expression, Want::Number, is_tried, number, error)) return false;
  if (number.type.is_float())
    value = number.real;
  else if (number.type.kind == CType::Kind::Unsigned || number.type.stars > 0)
    value = static_cast<double>(number.raw);
  else
    value = static_cast<double>(static_cast<std::int64_t>(number.raw));
  return true;
}

}  // namespace debug
