// SPDX-License-Identifier: MIT
#include "hal_sim/debug/machine.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspic30/core/cpu.h"
#include "dspic30/core/disassembler.h"
#include "dspic30/core/host_calls.h"
#include "dspic30/memory/sfr_table.h"

namespace debug {

namespace {
constexpr unsigned kRepeating = 0x10;  // SR.RA
constexpr int kStackPointer = 15;

/// Bytes that a handler known by heart saves on the stack behind the address that it returns to.
unsigned saved_by(const dspic::HostCalls* host) {
  return host ? 2 * static_cast<unsigned>(__builtin_popcount(host->saved_registers()) + host->saved_words())
              : 0;
}

}  // namespace

bool Machine::watch(chip::StepWatch* watcher, bool on) {
  const bool is_new = on != is_watched_;
  if (is_new) runner_.watch_steps(watcher, on);
  is_watched_ = on;
  return is_new && on;
}

unsigned Machine::word(Address address) const {
  unsigned value = 0;
  runner_.data().read_memory(address & kAddressMask, &value, 2);
  return value;
}

Address Machine::base() {
  const auto* const stack = code_.stack_at(pc());
  return stack ? runner_.processor().w(kStackPointer) - static_cast<unsigned>(stack->bytes) : 0;
}

std::vector<Frame> Machine::frames() {
  return trace_back(code_, pc(), runner_.processor().w(kStackPointer), saved_by(runner_.host()),
                    [this](unsigned address) { return word(address); });
}

// what a reset jumps to runs, or something that it has called, and not yet main()
bool Machine::is_starting_up() {
  if (!file().functions.count("main") || nesting() > 0) return false;
  const auto first = code_.at(0);
  if (pc() == 0) return true;
  const auto* reset = first && first->target ? file().code.function_at(*first->target) : nullptr;
  const std::vector<Frame> all = frames();
  const auto is_main = [](const Frame& f) { return f.function && f.function->name == "main"; };
  return reset && reset->name != "main" && !all.empty() && all.back().function == reset &&
         std::none_of(all.begin(), all.end(), is_main);
}

bool Machine::repeats(const chip::Step& step) const {
  static constexpr unsigned kSr = dspic::sfr("SR");
  return !step.slept && step.next == step.pc && (word(kSr) & kRepeating);
}

// --- code

std::uint32_t Machine::body_of(std::uint32_t begin) const {
  const auto known = runner_.image()->code()->known();
  const bool is_answered =
      dspic::is_host_place(chip::goto_target(file(), begin)) || (known && known->find(begin));
  return is_answered ? begin : file().code.body_of(begin);
}

std::string Machine::instruction(std::uint32_t address, std::uint32_t& next) const {
  const auto& words = file().words;
  const auto first = words.find(address), second = words.find(address + 2);
  const auto decoded = code_.at(address);
  next = decoded ? decoded->next() : address + 2;
  if (first == words.end()) return "";
  return fmt::format("{:06x}  {:<28}", first->second,
                     dspic::disassemble(first->second, second == words.end() ? 0 : second->second, address));
}

// --- data

void Machine::read(const Data& data, void* to) const {
  runner_.data().read_memory(data.address & kAddressMask, to, data.bytes);
}

bool Machine::write(const Data& data, const void* from) {
  if (data.address + data.bytes > dspic::Processor::kRamEnd) return false;
  runner_.data().write_memory(data.address, from, data.bytes);
  return true;
}

std::optional<Data> Machine::find_register(const std::string& name) {
  if (name == "sp") return register_data(kStackPointer);
  if (name == "sr") return find_sfr("SR");
  if (name.size() >= 2 && name.size() <= 3 && (name[0] == 'w' || name[0] == 'W') &&
      name.find_first_not_of("0123456789", 1) == std::string::npos && std::stoi(name.substr(1)) < 16)
    return register_data(std::stoi(name.substr(1)));
  return find_sfr(name);
}

std::string Machine::registers() const {
  const dspic::Processor& processor = runner_.processor();
  std::string text;
  for (int n = 0; n < 16; ++n)
    text += fmt::format("w{:<2} {:04x}{}", n, processor.w(n), n % 8 == 7 ? "\n" : "   ");
  const unsigned sr = processor.sr();
  text += fmt::format("pc  {:06x}  sr {:04x} (IPL {}{}{}{}{}{})  RCOUNT {:04x}  A {:#x}  B {:#x}\n", pc(), sr,
                      runner_.device().interrupts().cpu_level(), sr & 1 ? " C" : "", sr & 2 ? " Z" : "",
                      sr & 4 ? " OV" : "", sr & 8 ? " N" : "", sr & 0x10 ? " RA" : "",
                      word(dspic::sfr("RCOUNT")), processor.cpu().acc[0], processor.cpu().acc[1]);
  return text;
}

std::vector<std::pair<std::string, std::string>> Machine::register_list() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (int n = 0; n < 16; ++n)
    all.emplace_back("w" + std::to_string(n), fmt::format("{:#06x}", runner_.processor().w(n)));
  all.emplace_back("sr", fmt::format("{:#06x}", runner_.processor().sr()));
  return all;
}

// --- for people

std::optional<Data> find_sfr(const std::string& name) {
  const std::size_t dot = name.find('.');
  std::string of = name.substr(0, dot);
  if (dot != std::string::npos && of.size() > 4 && of.compare(of.size() - 4, 4, "bits") == 0)
    of.resize(of.size() - 4);
  const dspic::SfrInfo* info = dspic::sfr_named(of);
  if (!info) return {};
  if (dot == std::string::npos) return Data{info->address};
  for (const dspic::SfrField& field : dspic::fields_of(*info))
    if (field.name == name.substr(dot + 1)) return Data{info->address, 2, field.bit, field.width};
  return {};
}

std::string told_interrupt(const std::string& name, bool flag, bool enabled, int priority, int level,
                           bool is_held_by_disi) {
  std::string held;
  if (!enabled)
    held = "not enabled";
  else if (priority <= level)
    held = fmt::format("held off: priority {}, the processor is at {}", priority, level);
  else if (is_held_by_disi && priority < 7)
    held = "held off by DISI";
  else
    held = fmt::format("enabled, priority {} above the processor's {}", priority, level);
  return fmt::format("{}: {}, flag {}", name, held, flag ? "set" : "clear");
}

std::string told_timer(const std::string& name, const std::function<unsigned(unsigned address)>& word) {
  if (name.size() != 2 || name[0] != 'T') return "";
  const auto* control = dspic::sfr_named(name + "CON");
  const bool is_on = control && (word(control->address) & 0x8000);
  return is_on ? "" : fmt::format("; timer {} is off ({}CON.TON = 0)", name[1], name);
}

}  // namespace debug
