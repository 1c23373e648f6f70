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

// where the routine returns to that was called when W15 was `top`
std::uint32_t return_address(const Cpu& cpu, unsigned top) {
  std::uint32_t address;
  std::memcpy(&address, &cpu.ram[top - kReturnAddress - Cpu::kRamStart], sizeof address);
  return address & 0x7FFFFE;
}

// no loop of the chip can end in it, and pointers and stack are as everywhere
bool can_be_answered(const Cpu& cpu) {
  const unsigned full = cpu.w[15] + KnownCalls::kStack;
  return !(cpu.rcount | cpu.modcon) && !cpu.loop_end && full <= Cpu::kRamEnd && full <= cpu.stack_most;
}

// of registers alone
__attribute__((noinline)) Cycle answered_by_function(Cpu& cpu, const KnownRoutine& routine, Cycle limit) {
  const KnownAnswer answer = routine.function(first_registers(cpu));
  if (answer.cycles > limit || answer.cycles == 0) return 0;
  std::memcpy(cpu.w.data(), &answer.w0_to_w3, sizeof answer.w0_to_w3);
  return answer.cycles;
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

Cycle answered(Cpu& cpu, const Decoded* d, const KnownRoutine& routine, Cycle begin) {
  cpu.note_written(KnownCalls::kWrites);
  // what comes at its very end may come before its RETURN is over, which is shorter then
  const Cycle limit = cpu.deadline - begin - 1;
  if (limit <= 0 || !can_be_answered(cpu)) return 0;
  cpu.at = d;
  const Cycle cycles =
      routine.action ? routine.action(cpu, limit) : answered_by_function(cpu, routine, limit);
  if (cycles != 0) cpu.w[15] = static_cast<std::uint16_t>(cpu.w[15] - kReturnAddress);
  return cycles;
}

// nobody looks on
const Decoded* recall(Cpu& cpu, const Decoded* d, const KnownRoutine& routine) {
  cpu.note_written(KnownCalls::kWrites);
  const unsigned top = cpu.w[15];
  if (cpu.watching || cpu.repeating || top < Cpu::kRamStart + kReturnAddress || top > Cpu::kRamEnd)
    return nullptr;
  const std::uint32_t address = return_address(cpu, top);
  if (address == 0 || address >= kFlashEnd) return nullptr;
  const Cycle begin = cpu.now + d->lead, cycles = answered(cpu, d, routine, begin);
  if (cycles == 0) return nullptr;
  cpu.now = begin + cycles - d->cycles;
  return cpu.jump(address, d);
}

}  // namespace dspic
