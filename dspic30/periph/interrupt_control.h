// SPDX-License-Identifier: MIT
// INTCON1 and INTCON2: the traps' flags, and what holds for all interrupts. Source: [chip C11].
#pragma once
#include <cstdint>
#include <optional>

#include "dspic30/memory/sfr_bus.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

/// Level of trap 1 to 4 [chip C11].
constexpr int trap_level(int trap) { return 15 - trap; }
/// Its flag in INTCON1, where the order is another than that of the vectors.
constexpr std::uint16_t trap_flag(int trap) {
  constexpr std::uint16_t kFlags[] = {0, sfr_bits("INTCON1", "OSCFAIL"), sfr_bits("INTCON1", "ADDRERR"),
                                      sfr_bits("INTCON1", "STKERR"), sfr_bits("INTCON1", "MATHERR")};
  return kFlags[trap];
}
inline constexpr std::uint16_t kTrapFlags = trap_flag(1) | trap_flag(2) | trap_flag(3) | trap_flag(4);

class InterruptControl {
 public:
  /// INTCON1's flags of the traps.
  std::uint16_t traps() const { return intcon1_ & kTrapFlags; }
  bool has_trap(Trap trap) const { return (intcon1_ & trap_flag(static_cast<int>(trap))) != 0; }
  /// The highest trap above a CPU level; kNoVector: none.
  int trap_above(int cpu_level) const {
    for (int trap = 1; traps() && trap <= 4; ++trap)
      if ((intcon1_ & trap_flag(trap)) && trap_level(trap) > cpu_level) return trap;
    return kNoVector;
  }
  /// INTCON1.NSTDIS
  bool nesting_disabled() const { return (intcon1_ & kNstdis) != 0; }
  /// INTCON2.ALTIVT
  bool uses_alternate_table() const { return (intcon2_ & kAltivt) != 0; }
  /// 1: external interrupt n waits for the falling edge.
  bool falling_edge(int n) const { return (intcon2_ >> n & 1) != 0; }
  /// A hard trap came during another one.
  const std::optional<ResetKind>& reset_due() const { return reset_due_; }

  // --- for the controller
  std::uint16_t intcon1() const { return intcon1_; }
  std::uint16_t intcon2() const { return intcon2_; }
  void set_intcon1(std::uint16_t value) { intcon1_ = value; }
  void set_intcon2(std::uint16_t value) { intcon2_ = value; }
  void raise(Trap trap) { intcon1_ |= trap_flag(static_cast<int>(trap)); }
  void ask_reset() { reset_due_ = ResetKind::TrapConflict; }

 private:
  static constexpr std::uint16_t kNstdis = sfr_bits("INTCON1", "NSTDIS"),
                                 kAltivt = sfr_bits("INTCON2", "ALTIVT");
  std::uint16_t intcon1_ = 0, intcon2_ = 0;
  std::optional<ResetKind> reset_due_;
};

}  // namespace dspic
