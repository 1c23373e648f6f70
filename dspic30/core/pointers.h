// SPDX-License-Identifier: MIT
// Addresses that registers form: [Ws] and [Wd] with their modes, modulo and bit-reversed pointers, pointers on
// the stack. Source: [chip C5].
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/core/cpu.h"

namespace dspic {

/// Register n's address as it is accessed, moved by `pre` before and by `post` behind it; one that needs more
/// than an addition.
unsigned special_pointer(Cpu& cpu, unsigned n, int pre, int post, bool write);
/// ... of W15: an even address within the stack.
inline unsigned stack_address(Cpu& cpu, int pre, int post) {
  const unsigned ea = static_cast<unsigned>(cpu.w[15] + pre) & 0xFFFE;
  cpu.w[15] = static_cast<std::uint16_t>((ea + static_cast<unsigned>(post)) & 0xFFFE);
  return cpu.stack_checked(ea);
}
/// ... of any register, as `kind` says.
inline unsigned pointer_address(Cpu& cpu, Pointer kind, unsigned n, int pre, int post, bool write) {
  if (kind == Pointer::Stack) return stack_address(cpu, pre, post);
  if (kind == Pointer::Special) return special_pointer(cpu, n, pre, post, write);
  const auto ea = static_cast<std::uint16_t>(cpu.w[n] + pre);
  cpu.w[n] = static_cast<std::uint16_t>(ea + post);
  return ea;
}
inline unsigned source_address(Cpu& cpu, const Decoded* d) {
  return pointer_address(cpu, d->s_kind, d->s, d->s_pre, d->s_post, false);
}
inline unsigned destination_address(Cpu& cpu, const Decoded* d) {
  return pointer_address(cpu, d->d_kind, d->d, d->d_pre, d->d_post, true);
}
/// A register moved by `step` within its modulo buffer, if it has one. `y_space`: by the Y address generator.
unsigned stepped(const Cpu& cpu, unsigned n, unsigned value, int step, bool y_space);
/// Pointers that need more than an addition, one bit a register: when they read, and when they write.
std::array<std::uint32_t, 2> special_registers(const Cpu& cpu);

}  // namespace dspic
