// SPDX-License-Identifier: MIT
// The handlers that the native way does not run: the converter's and Timer 2's quiet ticks. When they come
// and what they take is known in closed form, so the program's own cycles become cycles of the clock, and
// back, as if each of them had interrupted it:
//
//   program  ====      =======    ==    clock: `work` cycles begun at `from` end where work and the calls
//   that handlers     [adc]        [t2]      came before are done
//
// Modelled: both handlers' times, the motors' firings in them, the converter's that interrupts Timer 2's.
// Not modelled: handlers that wait for one of the same or a higher level which runs for real.
#pragma once
#include <algorithm>

#include "hal_sim/board/adc_scan.h"
#include "hal_sim/board/agenda_timer.h"
#include "hal_sim/board/epuck_params.h"

namespace board {

class Handlers {
 public:
  Handlers(const AdcScan& scan, const AgendaTimer& agendas) : scan_(scan), agendas_(agendas) {}

  /// Does any of them come at all?
  bool come() const { return scan_.is_on() || agendas_.is_running(); }
  /// When `work` cycles are done that a program at priority `level`, 0 to 7, begins at `from`.
  Cycle done(Cycle from, Cycle work, int level) const {
    for (Cycle end = from + work;;) {
      const Cycle later = from + work + taken(from, end, level);
      if (later == end) return end;
      end = later;
    }
  }
  /// Most work from `from` on that is done by `until`; not below 0.
  Cycle work(Cycle from, Cycle until, int level) const {
    Cycle most = until - from - taken(from, until, level);
    // `until` may lie within a handler: what had been done before it came
    for (Cycle at = until; at > from && at > until - kHandlersInARow;) {
      at = last_call(at, level);
      if (at >= from) most = std::max(most, at - from - taken(from, at, level));
    }
    return std::max<Cycle>(most, 0);
  }
  /// What they take of each cycle on average, as a fraction of 2^32.
  std::uint64_t share_q32() const { return scan_.share_q32() + agendas_.share_q32(); }
  /// When the first of them comes that interrupts a program at `level`, from `at` on.
  Cycle next(Cycle at, int level) const {
    Cycle first = host::kNever;
    if (level < kScanPriority) first = scan_.next_call(at);
    if (level < kAgendaPriority) first = std::min(first, agendas_.next_call(at));
    return first;
  }
  /// `at`, or the end of the handler above `level` that runs then.
  Cycle free_from(Cycle at, int level) const { return level < kScanPriority ? scan_.free_from(at) : at; }

 private:
  /// Longer than handlers together can keep the processor.
  static constexpr Cycle kHandlersInARow = 600;

  Cycle taken(Cycle from, Cycle to, int level) const {
    Cycle cycles = 0;
    if (level < kScanPriority) cycles += scan_.handler_cycles(from, to);
    if (level < kAgendaPriority) cycles += agendas_.handler_cycles(from, to);
    return cycles;
  }
  Cycle last_call(Cycle at, int level) const {
    Cycle last = -1;
    if (level < kScanPriority) last = std::max(last, scan_.last_call(at).at);
    if (level < kAgendaPriority) last = std::max(last, agendas_.last_call(at));
    return last;
  }

  const AdcScan& scan_;
  const AgendaTimer& agendas_;
};

}  // namespace board
