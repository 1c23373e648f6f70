// SPDX-License-Identifier: MIT
// The chip's interrupts by their vectors, as debuggers, reports and a host without a core see them.
#pragma once
#include <cstdint>

#include "dspic30/memory/cycle.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

struct ChipParts;

class ChipInterrupts {
 public:
  explicit ChipInterrupts(ChipParts& parts) : parts_(parts) {}

  /// Vector to serve at the instruction boundary before cycle `now`; kNoVector if none. A flag set in cycle f
  /// is seen from the boundary f + 1 on. Highest priority above the CPU's level, lowest vector among equals.
  int pending(Cycle now);
  /// The same for who only looks: by what has happened up to now.
  int next(Cycle now) const;
  /// The handler of `vector` starts at the boundary before `now`: raises the CPU level,
  /// remembers the old one.
  InterruptEntry enter(int vector, Cycle now);
  /// RETFIE executes in cycle `now`: the level of before. Returns the cycle of the next instruction.
  Cycle leave(Cycle now);
  /// SR.IPL, and IPL3 above 7.
  int cpu_level() const;
  /// Handlers entered and not yet left.
  int nesting() const;
  /// DISI #count executes in cycle `now`: priorities 1 to 6 wait for count + 1 cycles. Also
  /// a write of DISICNT.
  void disi(unsigned count, Cycle now);
  bool disi_active(Cycle now) const;
  /// A trap of the core: sets its INTCON1 flag. A hard trap during another one asks for a reset instead.
  void raise_trap(Trap trap, Cycle now);
  bool has_flag(int vector, Cycle now);
  bool is_enabled(int vector) const;
  int priority(int vector) const;
  /// Cycle at which the flag was set last.
  Cycle flag_since(int vector) const;
  /// An enabled interrupt's flag is set, whatever its priority: the processor wakes.
  bool wakes(Cycle now);
  /// Events that found their enabled flag still set, from power-up to `now`; handlers that began.
  std::int64_t missed(int vector, Cycle now) const;
  std::int64_t served(int vector) const;

 private:
  ChipParts& parts_;
};

}  // namespace dspic
