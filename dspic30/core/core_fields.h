// SPDX-License-Identifier: MIT
// What instructions see and change of the core, W registers and flags before all. Functions of instructions
// use it freely. Flags are kept as they fall out of an operation.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "dspic30/core/decoded.h"
#include "dspic30/memory/cycle.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

class CoreFields {
 public:
  template <bool Byte>
  void set_nz(unsigned result) {
    n = static_cast<std::uint16_t>(Byte ? result << 8 : result);
    z = static_cast<std::uint16_t>(Byte ? result & 0xFF : result);
  }
  /// a + b + carry, with all flags; Sticky: Z only falls.
  template <bool Byte, bool Sticky>
  unsigned add(unsigned a, unsigned b, unsigned carry) {
    constexpr int shift = Byte ? 8 : 0;
    a = (a << shift) & 0xFFFF;
    b = (b << shift) & 0xFFFF;
    const unsigned r = a + b + (carry << shift);
    n = static_cast<std::uint16_t>(r);
    z = static_cast<std::uint16_t>(Sticky ? z | r : r);
    c = r >> 16;
    ov = (a ^ r) & (b ^ r);
    dc = (a ^ b ^ r) >> (Byte ? 4 : 0);
    return (r & 0xFFFF) >> shift;
  }
  bool flag_n() const { return (n & 0x8000) != 0; }
  bool flag_z() const { return z == 0; }
  bool flag_c() const { return (c & 1) != 0; }
  bool flag_ov() const { return (ov & 0x8000) != 0; }
  bool flag_dc() const { return (dc & 0x100) != 0; }
  void set_z(bool on) { z = on ? 0 : 1; }
  void ask_reset(ResetKind kind) {
    reset_due = kind;
    deadline = 0;
  }

  std::array<std::uint16_t, 16> w{};
  std::uint16_t n = 0, z = 1;
  unsigned c = 0, ov = 0, dc = 0;
  Cycle now = 0, deadline = 0;
  const Decoded* at = nullptr;        ///< the instruction that runs
  const Decoded* next = nullptr;      ///< the one that comes
  const Decoded* loop_end = nullptr;  ///< last instruction of the DO loop; null: none runs
  bool repeating = false;             ///< RA
  bool repeat_is_fresh = false;  ///< the next iteration is the first one, or the first after an interrupt
  enum class Window : std::uint8_t { Plain, RepeatEdge, Free } window = Window::Plain;
  bool window_was_free = false;  ///< the last iteration read through the window at no cost
  bool code_is_stale = false;    ///< choose_code() before the next instruction
  bool end_loop = false;         ///< CORCON.EDT
  bool splim_on = false;
  unsigned stack_most = kNoLimit;  ///< SPLIM, if it is on
  static constexpr unsigned kNoLimit = 0xFFFF;
  enum class Power : std::uint8_t { On, Idle, Sleep } power = Power::On;
  std::optional<ResetKind> reset_due;
  unsigned written = 0;  ///< W registers that were written since the reset
  std::uint16_t splim = 0, tblpag = 0, psvpag = 0, rcount = 0, corcon = 0, modcon = 0, xbrev = 0;
  bool oa = false, ob = false, sa = false, sb = false;
  /// What of the flash the PSV window shows; null: nothing, or nobody has looked through it since PSVPAG,
  /// CORCON or the flash changed.
  const std::uint32_t* window_words = nullptr;
};

}  // namespace dspic
