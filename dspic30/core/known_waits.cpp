// SPDX-License-Identifier: MIT
#include "dspic30/core/known_waits.h"

#include <cstring>

#include "dspic30/core/cpu.h"

namespace dspic {

CoreState::CoreState(const Cpu& c) {
  std::memcpy(words.data(), c.w.data(), sizeof c.w);
  std::memcpy(&words[4], c.shadow.w.data(), sizeof c.shadow.w);
  const std::uint64_t z = c.z == 0, carry = c.c & 1, ov = c.ov & 0x8000, dc = c.dc & 0x100;
  words[5] = std::uint64_t{c.n} << 48 | std::uint64_t{c.rcount} << 32 | ov << 16 | dc << 16 | z << 16 |
             carry << 17 | c.shadow.flags;
  words[6] = static_cast<std::uint64_t>(c.acc[0]);
  words[7] = static_cast<std::uint64_t>(c.acc[1]);
  words[8] = static_cast<std::uint64_t>(c.loop_depth) << 32 | c.loop.count;
  words[9] = static_cast<std::uint64_t>(c.oa | c.ob << 1 | c.sa << 2 | c.sb << 3 | c.repeating << 4 |
                                        c.end_loop << 5);
}

std::size_t KnownWaits::place_of(const Decoded* first) {
  return reinterpret_cast<std::uintptr_t>(first) / sizeof(Decoded) % std::tuple_size_v<decltype(waits_)>;
}

Cycle KnownWaits::round(const Cpu& cpu, const CoreState& now) const {
  const Wait& wait = waits_[place_of(cpu.next)];
  if (wait.first != cpu.next || wait.corcon != cpu.corcon || cpu.loop_end || wait.state != now) return 0;
  for (std::size_t i = 0; i < wait.words; ++i)
    if (std::memcmp(&cpu.ram[wait.index[i]], &wait.value[i], 2) != 0) return 0;
  return wait.took;
}

// notes what an instruction reads of RAM; false: that is more, or something else, than can be told from it
bool KnownWaits::Wait::read(const Cpu& cpu, const Decoded* instruction) {
  const Row* const row = find_row(cpu.program.read(cpu.address_of(instruction)));
  if (!row || instruction->pointers || instruction->stores || row->id == Insn::Daw_B_Wn) return false;
  if (!row->has(Operand::File) && !row->has(Operand::FileWord)) return true;
  const unsigned at = (static_cast<unsigned>(instruction->imm) & ~1u) - Cpu::kRamStart;
  if (at >= Cpu::kRamBytes || words == kMostWords) return false;
  index[words] = static_cast<std::uint16_t>(at);
  std::memcpy(&value[words++], &cpu.ram[at], 2);
  return true;
}

void KnownWaits::add(const Cpu& cpu, const Course& course, Cycle took, const CoreState& now) {
  if (cpu.loop_end) return;
  Wait wait;
  wait.first = cpu.next;
  wait.took = took;
  wait.corcon = cpu.corcon;
  wait.state = now;
  for (std::size_t i = 0; i < course.count; ++i)
    if (!wait.read(cpu, course.at[i])) return;
  waits_[place_of(cpu.next)] = wait;
}

}  // namespace dspic
