// SPDX-License-Identifier: MIT
// What forms of routines are made of: they take operands from the core's registers, and where their cycles
// fit, leave registers, flags and the stack below W15 as the routine does. So not even a program that reads
// what it never wrote can tell one from the other.
//
//   int form(Cpu& cpu, std::int64_t limit) {
//     from the operands: the cycles it takes
//     more than `limit`: return 0, with nothing changed
//     leave registers, flags and stack; return the cycles
//   }
#pragma once
#include <cstdint>
#include <cstring>

#include "dspic30/core/cpu.h"

namespace dspic::forms {

/// Wn, by a load of its own: translated code stores registers one by one, and a load wider than the stores
/// before it has to wait for them.
inline std::uint32_t one(const Cpu& cpu, unsigned n) {
  std::uint32_t word = cpu.w[n];
  __asm__("" : "+r"(word));
  return word;
}
/// Wn+1:Wn.
inline std::uint32_t pair(const Cpu& cpu, unsigned n) { return one(cpu, n) | one(cpu, n + 1) << 16; }
inline void set_pair(Cpu& cpu, unsigned n, std::uint32_t value) {
  cpu.w[n] = static_cast<std::uint16_t>(value);
  cpu.w[n + 1] = static_cast<std::uint16_t>(value >> 16);
}
/// W3..W0 or W7..W4.
inline std::uint64_t four(const Cpu& cpu, unsigned n) {
  return pair(cpu, n) | static_cast<std::uint64_t>(pair(cpu, n + 2)) << 32;
}
inline void set_four(Cpu& cpu, unsigned n, std::uint64_t value) {
  set_pair(cpu, n, static_cast<std::uint32_t>(value));
  set_pair(cpu, n + 2, static_cast<std::uint32_t>(value >> 32));
}
inline void set(Cpu& cpu, unsigned n, unsigned value) { cpu.w[n] = static_cast<std::uint16_t>(value); }

/// A word that the routine leaves on the stack, `place` words above where it found W15.
inline void leave(Cpu& cpu, unsigned place, unsigned value) {
  const auto word = static_cast<std::uint16_t>(value);
  std::memcpy(&cpu.ram[cpu.w[15] - Cpu::kRamStart + 2 * place], &word, 2);
}
/// Wn, Wn+1 ... from there on.
inline void leave_registers(Cpu& cpu, unsigned place, unsigned n, unsigned count) {
  std::uint8_t* const to = &cpu.ram[cpu.w[15] - Cpu::kRamStart + 2 * place];
  for (unsigned i = 0; i < count; ++i) {
    const auto word = static_cast<std::uint16_t>(one(cpu, n + i));
    std::memcpy(to + 2 * i, &word, sizeof word);
  }
}
inline void leave_return(Cpu& cpu, unsigned place, unsigned address) {
  leave(cpu, place, address & 0xFFFF);
  leave(cpu, place + 1, address >> 16);
}

/// Where the BRA or RCALL at an address leads.
inline unsigned target(const Cpu& cpu, unsigned address) {
  return address + 2 +
         2 * static_cast<unsigned>(static_cast<std::int16_t>(cpu.program.read(address) & 0xFFFF));
}

// --- the chip's operations, for their flags
inline unsigned add(Cpu& cpu, unsigned a, unsigned b) { return cpu.add<false, false>(a, b, 0); }
inline unsigned addc(Cpu& cpu, unsigned a, unsigned b) { return cpu.add<false, true>(a, b, cpu.flag_c()); }
inline unsigned sub(Cpu& cpu, unsigned a, unsigned b) { return cpu.add<false, false>(a, ~b & 0xFFFF, 1); }
inline unsigned subb(Cpu& cpu, unsigned a, unsigned b) {
  return cpu.add<false, true>(a, ~b & 0xFFFF, cpu.flag_c());
}
/// 32 bits.
inline void sub_pair(Cpu& cpu, std::uint32_t a, std::uint32_t b) {
  sub(cpu, a & 0xFFFF, b & 0xFFFF);
  subb(cpu, a >> 16, b >> 16);
}
/// AND, IOR, XOR, COM, shifts by several bits: N and Z.
inline void logic(Cpu& cpu, unsigned result) { cpu.set_nz<false>(result & 0xFFFF); }
/// RETURN behind a change of W15 and the like: flags of SUB W15, #bytes, W15 that gives back the stack.
inline void give_back(Cpu& cpu, unsigned bytes) { sub(cpu, cpu.w[15] + bytes, bytes); }

}  // namespace dspic::forms
