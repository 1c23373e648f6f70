// SPDX-License-Identifier: MIT
// What a standing program waits for: the loop that it goes round in, what it reads there, who could change
// that, and which interrupts are pending but held off. Read from the code and the chip's registers; nothing
// runs. Writes through pointers are not seen.
#include "hal_sim/debug/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "dspic30/core/host_calls.h"
#include "dspic30/memory/sfr_table.h"

namespace debug {

namespace {

constexpr std::uint32_t kLongestLoop = 2 * 200;  // program addresses

struct Loop {
  std::uint32_t begin = 0, end = 0;
};

/// The smallest loop of the function that holds `at`; end 0: none.
Loop loop_around(Machine& machine, const dspic::CodeMap::Function& function, std::uint32_t at) {
  Loop best;
  for (const Instruction& i : machine.code().of(function)) {
    if (!i.is_branch() || *i.target > at || i.address < at || i.address - *i.target > kLongestLoop) continue;
    if (*i.target < function.begin || (best.end && best.end - best.begin <= i.address - *i.target)) continue;
    best = {*i.target, i.address};
  }
  return best;
}

struct Place {
  unsigned address;
  int bit;
  bool operator<(const Place& o) const { return address != o.address ? address < o.address : bit < o.bit; }
};

/// What is read between two addresses by name, and by the functions that are called there directly.
void collect_reads(Machine& machine, std::uint32_t begin, std::uint32_t end, int depth,
                   std::set<Place>& reads) {
  for (std::uint32_t a = begin; a <= end;) {
    const auto i = machine.code().at(a);
    if (!i) return;
    if (i->access && i->access->reads) reads.insert({i->access->address, i->access->bit});
    if (i->is_call() && i->target && depth > 0)
      if (const auto* callee = machine.file().code.function_at(*i->target))
        collect_reads(machine, callee->begin, callee->end - 2, depth - 1, reads);
    a = i->next();
  }
}

std::string name_of(Machine& machine, const Place& place) {
  if (const auto* info = dspic::sfr_info(place.address))
    return place.bit >= 0 ? dspic::sfr_bit_name(*info, place.bit) : info->name;
  std::string best;
  for (const auto& [name, address] : machine.file().objects) {
    const auto bytes = machine.file().object_bytes.find(name);
    const unsigned size = bytes == machine.file().object_bytes.end() ? 2 : bytes->second;
    if (place.address < address || place.address >= address + size) continue;
    best = place.address == address ? name : fmt::format("{} + {}", name, place.address - address);
  }
  return best.empty() ? fmt::format("{:#06x}", place.address) : best;
}

std::string state_of(Machine& machine, int vector) {
  dspic::ChipInterrupts& interrupts = machine.runner().device().interrupts();
  const Cycle now = machine.now();
  return told_interrupt(std::string(dspic::vector_name(vector)), interrupts.has_flag(vector, now),
                        interrupts.is_enabled(vector), interrupts.priority(vector), interrupts.cpu_level(),
                        interrupts.disi_active(now));
}

bool is_known_by_heart(Machine& machine, int vector) {
  const dspic::HostCalls* const host = machine.runner().host();
  for (int h = 0; host && h < dspic::HostCalls::kHandlers; ++h)
    if (host->vector(h) == vector) return true;
  return false;
}

/// The timer that a handler serves, if it stands still.
std::string idle_timer(Machine& machine, int vector) {
  if (is_known_by_heart(machine, vector)) return "";
  return told_timer(std::string(dspic::vector_name(vector)),
                    [&](unsigned address) { return machine.word(address); });
}

/// Who writes a variable, and whether he can come.
std::string writers(Machine& machine, const Place& place) {
  std::string text;
  for (const auto& function : machine.file().code.functions) {
    const std::vector<Instruction> all = machine.code().of(function);
    const auto writes = std::find_if(all.begin(), all.end(), [&](const Instruction& i) {
      return i.access && i.access->writes && (i.access->address & ~1u) == (place.address & ~1u);
    });
    if (writes == all.end()) continue;
    const std::vector<int> vectors = machine.code().vectors_of(function.begin);
    if (vectors.empty())
      text += fmt::format("    {} writes it\n", machine.file().code.describe(writes->address));
    for (const int vector : vectors)
      text += fmt::format("    the handler {} writes it; {}{}\n", function.name, state_of(machine, vector),
                          idle_timer(machine, vector));
  }
  return text.empty() ? "    no instruction writes it by its address\n" : text;
}

/// What an interrupt flag that is polled depends on.
std::string about_register(Machine& machine, const Place& place) {
  static constexpr unsigned kIfs0 = dspic::sfr("IFS0"), kIec0 = dspic::sfr("IEC0");
  if (place.address < kIfs0 || place.address >= kIec0 || place.bit < 0) return "";
  const int vector = dspic::kFirstIrqVector + static_cast<int>(place.address - kIfs0) * 8 + place.bit;
  if (vector >= dspic::kVectors) return "";
  return "    " + state_of(machine, vector) + idle_timer(machine, vector) + "\n";
}

}  // namespace

std::string Machine::interrupts() {
  Machine& machine = *this;
  dspic::ChipInterrupts& interrupts = machine.runner().device().interrupts();
  std::string text = fmt::format("the processor is at level {}{}, {} handlers deep\n", interrupts.cpu_level(),
                                 interrupts.disi_active(machine.now()) ? ", DISI" : "", interrupts.nesting());
  for (int v = dspic::kFirstIrqVector; v < dspic::kVectors; ++v)
    if (interrupts.is_enabled(v) || interrupts.has_flag(v, machine.now()))
      text +=
          fmt::format("  {}{}, {}\n", state_of(machine, v), idle_timer(machine, v),
                      is_known_by_heart(machine, v) ? "served by hal_sim's driver, without a count"
                                                    : fmt::format("served {} times", interrupts.served(v)));
  return text;
}

std::string Machine::why() {
  Machine& machine = *this;
  if (machine.runner().processor().is_asleep())
    return "it sleeps (PWRSAV) until an enabled interrupt\n" + interrupts();
  // The innermost loop around the program, of the function that runs or of one that called it.
  Loop loop;
  Frame where;
  for (const Frame& frame : machine.frames()) {
    if (!frame.function) break;
    loop = loop_around(machine, *frame.function, frame.call);
    where = frame;
    if (loop.end) break;
  }
  std::string text;
  if (!loop.end) {
    text = fmt::format("it is in no loop of {} words or less\n", kLongestLoop / 2);
  } else {
    // what leads back is the loop's own; its first instruction may be of a function that was inlined
    text = fmt::format("it goes round in {}, {:#08x} to {:#08x}", machine.file().code.describe(loop.end),
                       loop.begin, loop.end);
    // What the loop reads may end it: so that is shown, with what it is now and who could change it.
    std::set<Place> reads;
    collect_reads(machine, loop.begin, loop.end, 1, reads);
    text += reads.empty() ? ", and reads nothing by its address\n" : ", and reads\n";
    for (const Place& place : reads) {
      const unsigned value = machine.word(place.address & ~1u);
      text += fmt::format("  {} = {:#x}\n", name_of(machine, place),
                          place.bit >= 0 ? value >> place.bit & 1 : value >> 8 * (place.address & 1));
      text += place.address < dspic::kSfrBytes ? about_register(machine, place) : writers(machine, place);
    }
  }
  // Interrupts that would come, and are held off.
  std::string pending;
  dspic::ChipInterrupts& interrupts = machine.runner().device().interrupts();
  for (int v = dspic::kFirstIrqVector; v < dspic::kVectors; ++v)
    if (interrupts.has_flag(v, machine.now()) &&
        (!interrupts.is_enabled(v) || interrupts.priority(v) <= interrupts.cpu_level() ||
         interrupts.disi_active(machine.now())))
      pending += "  " + state_of(machine, v) + "\n";
  if (!pending.empty()) text += "pending, but not served:\n" + pending;
  return text;
}

}  // namespace debug
