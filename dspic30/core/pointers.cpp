// SPDX-License-Identifier: MIT
#include "dspic30/core/pointers.h"

namespace dspic {

namespace {

constexpr SfrBits kXwm = sfr_field("MODCON", "XWM"), kYwm = sfr_field("MODCON", "YWM"),
                  kBwm = sfr_field("MODCON", "BWM"), kXb = sfr_field("XBREV", "XB");
constexpr std::uint16_t kXmoden = sfr_bits("MODCON", "XMODEN"), kYmoden = sfr_bits("MODCON", "YMODEN"),
                        kBren = sfr_bits("XBREV", "BREN");
constexpr unsigned kNoPointer = 15;  // as XWM, YWM or BWM: none is chosen [DS70143 4.2.2]

}  // namespace

std::array<std::uint32_t, 2> special_registers(const Cpu& cpu) {
  const auto chosen = [](unsigned n) { return n == kNoPointer ? 0u : 1u << n; };
  const std::uint32_t read = cpu.modcon & kXmoden ? chosen(kXwm.of(cpu.modcon)) : 0;
  return {read, read | (cpu.xbrev & kBren ? chosen(kBwm.of(cpu.modcon)) : 0)};
}

unsigned stepped(const Cpu& cpu, unsigned reg, unsigned value, int step, bool y_space) {
  const unsigned moved = (value + static_cast<unsigned>(step)) & 0xFFFF;
  const bool on = y_space ? (cpu.modcon & kYmoden) && kYwm.of(cpu.modcon) == reg
                          : (cpu.modcon & kXmoden) && kXwm.of(cpu.modcon) == reg;
  if (!on || reg == kNoPointer) return moved;
  const int start = cpu.modulo[y_space ? 2 : 0], end = cpu.modulo[y_space ? 3 : 1], length = end - start + 1;
  const int place = static_cast<int>(value) + step;
  if (place > end && step > 0) return static_cast<unsigned>(place - length) & 0xFFFF;
  if (place < start && step < 0) return static_cast<unsigned>(place + length) & 0xFFFF;
  return moved;
}

// XB is added from the highest bit down, to words
static unsigned reversed_step(unsigned value, unsigned xb) {
  unsigned sum = value >> 1, carry = xb & kXb.mask;
  while (carry) {
    const unsigned both = sum & carry;
    sum ^= carry;
    carry = both >> 1;
  }
  return (sum << 1 | (value & 1)) & 0xFFFF;
}

unsigned special_pointer(Cpu& cpu, unsigned reg, int pre, int post, bool is_write) {
  const bool reversed = is_write && (cpu.xbrev & kBren) && kBwm.of(cpu.modcon) == reg;
  const auto step = [&](unsigned value, int by) {
    if (reversed && by == 2) return reversed_step(value, cpu.xbrev);
    return by ? stepped(cpu, reg, value, by, false) : value;
  };
  const unsigned ea = step(cpu.w[reg], pre);
  cpu.w[reg] = static_cast<std::uint16_t>(step(ea, post));
  return ea;
}

}  // namespace dspic
