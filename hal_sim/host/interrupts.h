// SPDX-License-Identifier: MIT
// The chip's interrupt controller as native firmware meets it: flags that rise at known cycles, enables,
// priorities, nesting, DISI. Source: DS70143 section 5.
//
//   flag rises (due) --> IFS bit --+-- IEC bit set? --+-- priority > CPU's? --+-- not held by DISI? -->
//   handler
//
// Modelled: natural order among equals, nesting by priority, NSTDIS, DISI (holds priorities 1 to 6).
// Not modelled: the alternate vector table; the exact entry latency inside a block (one block at most).
#pragma once
#include <array>
#include <cstdint>
#include <functional>

#include "hal_sim/host/context.h"
#include "hal_sim/host/image_abi.h"

namespace host {

/// One line of the PC's cache each: most programs use two or three.
struct alignas(64) InterruptSource {
  Cycle due = kNever;    ///< cycle at which the flag rises next
  Cycle period = 0;      ///< > 0: after rising, due moves on by this many cycles
  bool flag = false;     ///< IFS bit
  bool enabled = false;  ///< IEC bit
  int priority = 4;      ///< IPC field, 0 (off) to 7
  void (*handler)() = nullptr;
  bool self_clearing =
      false;  ///< handler of our API: the flag falls on entry; a program's own handler clears it itself
  Cycle entry_cycles = 0;  ///< latency, context saving and RETFIE
  Cycle flag_since = 0;    ///< when the flag rose
};

class InterruptController {
 public:
  InterruptController() { reset(); }
  /// Power-up values: nothing enabled, priorities 4.
  void reset();

  /// For changing; call touch() afterwards. The source is looked at from now on.
  InterruptSource& source(int vector) {
    used_ |= std::uint64_t{1} << vector;
    return sources_[static_cast<std::size_t>(vector)];
  }
  const InterruptSource& source(int vector) const { return sources_[static_cast<std::size_t>(vector)]; }

  /// A source was changed from outside: the cached next due time is wrong now.
  void touch() { next_due_ = kUnknown; }

  /// The handler of this vector begins, and its flag falls.
  void take(int vector) {
    source(vector).flag = false;
    ready_ &= ~(std::uint64_t{1} << vector);
  }

  /// External interrupt 0 rises at the edges of a line: `next_edge` answers the first one after a cycle.
  void watch_int0(std::function<Cycle(Cycle)> next_edge, Cycle now);
  /// The line's future or the polarity has changed.
  void refresh_int0(Cycle now);

  /// Raises every flag that is due at `now` or before.
  void raise_due(Cycle now);

  /// Earliest cycle at which an enabled flag rises, kNever if none. Flags of disabled sources rise too but
  /// wake nobody.
  Cycle next_due();

  /// Vector to serve now, -1 if none: highest priority above `cpu_priority`, lowest number among equals.
  int select(int cpu_priority, bool held_by_disi);

  /// Vector of the longest-waiting enabled flag that cannot be served now, -1 if none.
  int longest_waiting(int cpu_priority, bool held_by_disi);

 private:
  static constexpr Cycle kUnknown = -1;
  std::uint64_t used_ = 0;     // bit v: somebody has touched vector v
  Cycle next_due_ = kUnknown;  // over enabled sources
  Cycle next_raise_ = 0;       // over all sources
  std::uint64_t ready_ = 0;    // bit v: flag and enable of vector v are both set
  std::function<Cycle(Cycle)> next_int0_edge_;
  std::array<InterruptSource, TP_VECTORS> sources_;
};

}  // namespace host
