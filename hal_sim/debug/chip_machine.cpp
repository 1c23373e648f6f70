// SPDX-License-Identifier: MIT
#include "hal_sim/debug/chip_machine.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspic30/core/disassembler.h"
#include "dspic30/memory/sfr_table.h"

namespace debug {

namespace {
constexpr unsigned kRepeating = 0x10;  // SR.RA
constexpr int kStackPointer = 15;
}  // namespace

void ChipMachine::watch(Watcher* watcher, bool on) {
  if (on != is_watched_) runner_.watch_steps(watcher, on);
  is_watched_ = on;
}

unsigned ChipMachine::word(Address address) const {
  unsigned value = 0;
  runner_.read_memory(address & 0xFFFF, &value, 2);
  return value;
}

Address ChipMachine::base() {
  const auto depth = code_.stack_depth(pc());
  return depth ? runner_.processor().w(kStackPointer) - static_cast<unsigned>(*depth) : 0;
}

std::vector<Frame> ChipMachine::frames() {
  return trace_back(code_, pc(), runner_.processor().w(kStackPointer),
                    [this](unsigned address) { return word(address); });
}

// what a reset jumps to runs, or something that it has called, and not yet main()
bool ChipMachine::is_starting_up() {
  if (!file().functions.count("main") || nesting() > 0) return false;
  const auto first = code_.at(0);
  if (pc() == 0) return true;
  const auto* reset = first && first->target ? file().code.function_at(*first->target) : nullptr;
  const std::vector<Frame> all = frames();
  const auto is_main = [](const Frame& f) { return f.function && f.function->name == "main"; };
  return reset && reset->name != "main" && !all.empty() && all.back().function == reset &&
         std::none_of(all.begin(), all.end(), is_main);
}

bool ChipMachine::repeats(const chip::Step& step) const {
  static constexpr unsigned kSr = dspic::sfr("SR");
  return !step.slept && step.next == step.pc && (word(kSr) & kRepeating);
}

// --- code

bool ChipMachine::is_code(std::uint32_t address) const {
  return address < dspic::kFlashEnd && address % 2 == 0;
}

std::uint32_t ChipMachine::code_end() const { return dspic::kFlashEnd; }

std::string ChipMachine::instruction(std::uint32_t address, std::uint32_t& next) const {
  const auto& words = file().words;
  const auto first = words.find(address), second = words.find(address + 2);
  const auto decoded = code_.at(address);
  next = decoded ? decoded->next() : address + 2;
  if (first == words.end()) return "";
  return fmt::format("{:06x}  {:<28}", first->second,
                     dspic::disassemble(first->second, second == words.end() ? 0 : second->second, address));
}

// --- data

bool ChipMachine::read(const Data& data, void* to) const {
  runner_.read_memory(data.address & 0xFFFF, to, data.bytes);
  return true;
}

bool ChipMachine::write(const Data& data, const void* from) {
  if (data.address + data.bytes > dspic::Processor::kRamEnd) return false;
  runner_.write_memory(data.address, from, data.bytes);
  return true;
}

std::optional<Data> ChipMachine::register_data(int number) const {
  return Data{2 * static_cast<Address>(number)};
}

std::optional<Data> ChipMachine::find_register(const std::string& name) const {
  if (name == "sp") return register_data(kStackPointer);
  if (name == "sr") return find_sfr("SR");
  if (name.size() >= 2 && name.size() <= 3 && (name[0] == 'w' || name[0] == 'W') &&
      name.find_first_not_of("0123456789", 1) == std::string::npos && std::stoi(name.substr(1)) < 16)
    return register_data(std::stoi(name.substr(1)));
  return find_sfr(name);
}

std::string ChipMachine::registers() const {
  const dspic::Processor& processor = runner_.processor();
  std::string text;
  for (int n = 0; n < 16; ++n)
    text += fmt::format("w{:<2} {:04x}{}", n, processor.w(n), n % 8 == 7 ? "\n" : "   ");
  const unsigned sr = processor.sr();
  text += fmt::format("pc  {:06x}  sr {:04x} (IPL {}{}{}{}{}{})  RCOUNT {:04x}  A {:#x}  B {:#x}\n", pc(), sr,
                      runner_.device().cpu_level(), sr & 1 ? " C" : "", sr & 2 ? " Z" : "",
                      sr & 4 ? " OV" : "", sr & 8 ? " N" : "", sr & 0x10 ? " RA" : "",
                      word(dspic::sfr("RCOUNT")), processor.accumulator(0), processor.accumulator(1));
  return text;
}

std::vector<std::pair<std::string, std::string>> ChipMachine::register_list() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (int n = 0; n < 16; ++n)
    all.emplace_back("w" + std::to_string(n), fmt::format("{:#06x}", runner_.processor().w(n)));
  all.emplace_back("sr", fmt::format("{:#06x}", runner_.processor().sr()));
  return all;
}

}  // namespace debug
