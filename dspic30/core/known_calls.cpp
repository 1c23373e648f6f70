// SPDX-License-Identifier: MIT
#include "dspic30/core/known_calls.h"

#include <algorithm>

#include "dspic30/core/cpu.h"

namespace dspic {

namespace {

constexpr unsigned kReturnAddress = 4;  // bytes on the stack

std::uint64_t first_registers(const Cpu& cpu) {
  std::uint64_t all;
  std::memcpy(&all, cpu.w.data(), sizeof all);
  return all;
}

// nobody looks on, no loop of the chip can end in it, and pointers and stack are as everywhere
bool can_be_answered(const Cpu& cpu) {
  const unsigned top = cpu.w[15], full = top + KnownCalls::kStack;
  return !(cpu.watching | cpu.repeating | (cpu.rcount | cpu.modcon) | (cpu.loop_end != nullptr)) &&
         top >= Cpu::kRamStart + kReturnAddress && full <= Cpu::kRamEnd &&
         (!cpu.splim_on || full <= cpu.splim);
}

}  // namespace

void KnownCalls::put(const Place& place) {
  std::size_t i = slot(place.address);
  while (places_[i].routine) i = (i + 1) & (places_.size() - 1);
  places_[i] = place;
}

void KnownCalls::add(unsigned address, const KnownRoutine& routine) {
  if (find(address)) return;
  if (2 * ++count_ > places_.size()) {
    const std::vector<Place> old = std::move(places_);
    places_.assign(std::max<std::size_t>(16, 2 * old.size()), {});
    for (const Place& place : old)
      if (place.routine) put(place);
  }
  put({address, &routine});
}

const Decoded* recall(Cpu& cpu, const Decoded* d, const KnownRoutine& routine) {
  cpu.note_written(KnownCalls::kWrites);
  if (!can_be_answered(cpu)) return nullptr;
  const unsigned top = cpu.w[15];
  std::uint32_t address;
  std::memcpy(&address, &cpu.ram[top - kReturnAddress - Cpu::kRamStart], sizeof address);
  address &= 0x7FFFFE;
  if (address == 0 || address >= kFlashEnd) return nullptr;
  // what comes at its very end may come before its RETURN is over, which is shorter then
  const Cycle begin = cpu.now + d->lead, limit = cpu.deadline - begin - 1;
  Cycle cycles;
  cpu.at = d;
  if (routine.function) {
    const KnownAnswer answer = routine.function(first_registers(cpu));
    cycles = answer.cycles;
    if (cycles <= 0 || cycles > limit) return nullptr;
    std::memcpy(cpu.w.data(), &answer.w0_to_w3, sizeof answer.w0_to_w3);
  } else {
    cycles = limit > 0 ? routine.action(cpu, limit) : 0;
    if (cycles == 0) return nullptr;
  }
  cpu.w[15] = static_cast<std::uint16_t>(top - kReturnAddress);
  cpu.now = begin + cycles - d->cycles;
  return cpu.jump(address, d);
}

}  // namespace dspic
