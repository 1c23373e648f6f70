// SPDX-License-Identifier: MIT
// Where instructions take their operands from and put their results: one class a place, get() and put() for
// bytes and words. Sources come first, then destinations, as on the chip.
#pragma once
#include "dspic30/core/pointers.h"

namespace dspic::operands {

template <bool Byte>
constexpr unsigned kMask = Byte ? 0xFF : 0xFFFF;

/// W register d takes a value; a byte leaves the upper half.
template <bool Byte>
inline void put_register(Cpu& cpu, const Decoded* d, unsigned value) {
  std::uint16_t& w = cpu.w[d->d];
  w = static_cast<std::uint16_t>((Byte ? (w & 0xFF00) | (value & 0xFF) : value) & d->mask);
}

struct Wb {
  template <bool Byte>
  static unsigned get(Cpu& cpu, const Decoded* d) {
    return cpu.w[d->b] & kMask<Byte>;
  }
};
struct Rs {
  template <bool Byte>
  static unsigned get(Cpu& cpu, const Decoded* d) {
    return cpu.w[d->s] & kMask<Byte>;
  }
};
struct Rd {
  template <bool Byte>
  static unsigned get(Cpu& cpu, const Decoded* d) {
    return cpu.w[d->d] & kMask<Byte>;
  }
  template <bool Byte>
  static void put(Cpu& cpu, const Decoded* d, unsigned value) {
    put_register<Byte>(cpu, d, value);
  }
};
struct W0 {
  template <bool Byte>
  static unsigned get(Cpu& cpu, const Decoded*) {
    return cpu.w[0] & kMask<Byte>;
  }
  template <bool Byte>
  static void put(Cpu& cpu, const Decoded*, unsigned value) {
    cpu.w[0] = static_cast<std::uint16_t>(Byte ? (cpu.w[0] & 0xFF00) | (value & 0xFF) : value);
  }
};
struct Literal {
  template <bool Byte>
  static unsigned get(Cpu&, const Decoded* d) {
    return static_cast<unsigned>(d->imm) & kMask<Byte>;
  }
};
/// The word or byte at imm.
struct File {
  template <bool Byte>
  static unsigned get(Cpu& cpu, const Decoded* d) {
    return cpu.read<Byte>(static_cast<unsigned>(d->imm));
  }
  template <bool Byte>
  static void put(Cpu& cpu, const Decoded* d, unsigned value) {
    cpu.write<Byte>(static_cast<unsigned>(d->imm), value & kMask<Byte>);
  }
};
/// [Ws] and [Wd] with their modes.
struct Memory {
  template <bool Byte>
  static unsigned get(Cpu& cpu, const Decoded* d) {
    return cpu.read<Byte>(source_address(cpu, d));
  }
  template <bool Byte>
  static void put(Cpu& cpu, const Decoded* d, unsigned value) {
    cpu.write<Byte>(destination_address(cpu, d), value & kMask<Byte>);
  }
};
struct Nowhere {
  template <bool Byte>
  static void put(Cpu&, const Decoded*, unsigned) {}
};

}  // namespace dspic::operands
