// SPDX-License-Identifier: MIT
#include "hal_sim/chip/chip_data.h"

namespace chip {

namespace {

constexpr unsigned kIfs0 = dspic::sfr("IFS0"), kPsvStart = 0x8000, kPsvpag = dspic::sfr("PSVPAG");
using dspic::Processor;

/// At the observer's own instants, which may lie before the latest of the program: what comes between them
/// must not be carried out while somebody looks.
class View final : public host::ChipView {
 public:
  explicit View(dspic::Dspic30f6014a& device) : device_(device) {}
  void carry_out(Cycle at) override { device_.run_events(at); }
  std::uint16_t peek(unsigned address, Cycle at) override { return device_.peek(address, at); }
  Cycle register_horizon(unsigned address, Cycle at) override { return device_.horizon(address, at); }
  bool flag(int vector, Cycle at) override {
    return device_.interrupts().has_flag(vector + dspic::kFirstIrqVector, at);
  }
  Cycle flag_horizon(int vector, Cycle at) override {
    return device_.horizon(kIfs0 + 2 * static_cast<unsigned>(vector / 16), at);
  }

 private:
  dspic::Dspic30f6014a& device_;
};

}  // namespace

std::unique_ptr<host::ChipView> view_of(dspic::Dspic30f6014a& device) {
  return std::make_unique<View>(device);
}

bool ChipData::is_served(unsigned address) const {
  return address >= Processor::kRamStart && address < p_.plain_from;
}

const host::Variable* ChipData::find_variable(const std::string& expression, std::string& error) const {
  using Kind = dspic::DebugInfo::Kind;
  const auto known = variables_.find(expression);
  if (known != variables_.end()) return &known->second;
  // main.c:count and tick:count are statics of a file and of a function
  const std::size_t colon = expression.find(':');
  const std::string scope = colon == std::string::npos ? "" : expression.substr(0, colon);
  const std::string plain_name = colon == std::string::npos ? expression : expression.substr(colon + 1);
  const auto is_in_scope = [&](const dspic::DebugInfo::Variable& v) {
    return scope.empty() || ProgramPlaces::is_of(p_.file, scope, v);
  };
  dspic::DebugInfo::Found found;
  if (!p_.file.debug.value().find(plain_name, 0, found, error, is_in_scope)) {
    if (!scope.empty()) {
      if (!found.variable) error += ", in '" + scope + "'";
      return nullptr;
    }
    const auto object = p_.file.objects.find(expression);  // assembler text has no types
    const auto bytes = p_.file.object_bytes.find(expression);
    if (object == p_.file.objects.end() || bytes == p_.file.object_bytes.end() || bytes->second > 4)
      return nullptr;
    const host::Variable plain{object->second, bytes->second, host::Variable::Kind::Unsigned};
    return &variables_.emplace(expression, plain).first->second;
  }
  const auto& type = p_.file.debug.value().types[static_cast<std::size_t>(found.type)];
  host::Variable v;
  v.address = static_cast<std::uintptr_t>(found.variable->places[0].value) + found.offset;
  v.bytes = type.bytes;
  v.kind = type.kind == Kind::Signed                                   ? host::Variable::Kind::Signed
           : type.kind == Kind::Float                                  ? host::Variable::Kind::Float
           : type.kind == Kind::Unsigned || type.kind == Kind::Pointer ? host::Variable::Kind::Unsigned
                                                                       : host::Variable::Kind::Aggregate;
  v.first_bit = found.bit;
  v.bits = found.width;
  return &variables_.emplace(expression, v).first->second;
}

std::vector<char> ChipData::read_variable(const std::string& variable, std::size_t bytes) const {
  const auto found = p_.file.objects.find(variable);
  if (found == p_.file.objects.end()) return {};
  const auto size = p_.file.object_bytes.find(variable);
  if (size != p_.file.object_bytes.end() && bytes > size->second) return {};
  std::vector<char> data(bytes ? bytes : 2);
  read_memory(found->second, data.data(), data.size());
  return data;
}

void ChipData::read_memory(std::uintptr_t address, void* to, std::size_t bytes) const {
  auto* out = static_cast<unsigned char*>(to);
  for (std::size_t i = 0; i < bytes; ++i) {
    const auto at = static_cast<unsigned>(address + i);
    const auto in_register = [&](unsigned reg) { return p_.chip.device().peek(reg, p_.chip.latest()); };
    const auto in_flash = [&] {  // through the PSV window
      return p_.program.read(in_register(kPsvpag) << 15 | (at & 0x7FFE));
    };
    const std::uint32_t word = at < Processor::kRamStart ? in_register(at & ~1u)
                               : at >= kPsvStart         ? in_flash()
                                                         : 0;
    if (is_served(at))
      out[i] = static_cast<unsigned char>(p_.library->peek(at & ~1u, p_.chip.latest()) >> 8 * (at & 1));
    else
      out[i] = at >= Processor::kRamStart && at < Processor::kRamEnd
                   ? p_.processor.ram(at)
                   : static_cast<unsigned char>(word >> 8 * (at & 1));
  }
}

void ChipData::write_memory(std::uintptr_t address, const void* from, std::size_t bytes) {
  const auto* in = static_cast<const unsigned char*>(from);
  for (std::size_t i = 0; i < bytes; ++i) {
    const auto at = static_cast<unsigned>(address + i);
    if (is_served(at))
      p_.library->write(at & ~1u, static_cast<std::uint16_t>(in[i] << 8 * (at & 1)),
                        static_cast<std::uint16_t>(0xFF << 8 * (at & 1)), p_.chip.latest());
    else if (at >= Processor::kRamStart && at < Processor::kRamEnd)
      p_.processor.set_ram(at, in[i]);
    if (at < Processor::kRamStart) p_.chip.device().write(at, in[i], 8, p_.chip.latest());
    written_(at, in[i]);
  }
  done_();
}

host::Place ChipData::place_of(std::uintptr_t code) const {
  return p_.places.place_of(static_cast<unsigned>(code));
}

host::Place ChipData::place_now() const { return place_of(p_.places.own(p_.processor.pc())); }

}  // namespace chip
