// SPDX-License-Identifier: MIT
// What may be asked of a chip by whoever writes its course down: registers, flags, handlers. Nothing of it
// changes the course.
#pragma once
#include <cstdint>

#include "hal_sim/board/cycle.h"

namespace host {

using board::Cycle;

class ChipView {
 public:
  virtual ~ChipView() = default;
  /// What happens in the chip by itself up to `at` has happened.
  virtual void carry_out(Cycle at) = 0;
  /// A register as the program would read it at `at`, without the effects of reading.
  virtual std::uint16_t peek(unsigned address, Cycle at) = 0;
  /// The first cycle after `at` at which a register may change by itself.
  virtual Cycle register_horizon(unsigned address, Cycle at) = 0;
  /// Whether the flag of an interrupt (natural order) is set at `at`, not before what has already run; and
  /// the first cycle after `at` at which it may change by itself, kNever if none.
  virtual bool flag(int vector, Cycle at) = 0;
  virtual Cycle flag_horizon(int vector, Cycle at) = 0;
};

}  // namespace host
