// SPDX-License-Identifier: MIT
// When the interrupts of a_d/advance_ad_scan come: a line, from the converter's start, its last stop or change
// of pace on. Their numbers count on from run to run. What is sampled is AdcScan's.
#pragma once
#include <cstdint>

#include "hal_sim/drivers/driver_params.h"

namespace drivers {

struct ScanClock {
  /// A run of frames without a break.
  struct Run {
    std::int64_t first = 0;   ///< number of its first interrupt
    std::int64_t full = 0;    ///< ALL_ADC interrupts before it: the driver's slot counter
    Cycle origin = 0;         ///< its first sequence begins
    bool micro_only = false;  ///< its frames are those of microphones alone

    Cycle round = kScanRoundCycles;  ///< 65 frames
    Cycle sequence() const { return micro_only ? kScanMicroFrameCycles : kScanSequenceCycles; }
    /// When interrupt `number` comes.
    Cycle cycle_of(std::int64_t number) const { return origin + sequence() + take(number - first); }
    /// What so many frames take on average.
    Cycle take(std::int64_t frames) const { return floor_quotient(frames * round, kScanPeriod); }
  };

  bool is_on = false;                   ///< the converter
  Cycle held_since = -1;                ///< the program masks the handler; -1: it does not
  Run run;                              ///< the present one
  Cycle full_round = kScanRoundCycles;  ///< of its frames when they are not MICRO_ONLY's

  /// Interrupts so far, in both modes.
  std::int64_t interrupts(Cycle at) const { return run.first + frames(at); }
  /// Those of ALL_ADC mode.
  std::int64_t full_interrupts(Cycle at) const { return run.full + (run.micro_only ? 0 : frames(at)); }
  /// Of ALL_ADC interrupt number (from 0).
  Cycle full_cycle(std::int64_t interrupt) const {
    return run.origin + kScanSequenceCycles + run.take(interrupt - run.full);
  }
  /// Accelerometer samples so far; and after so many interrupts of ALL_ADC mode.
  std::int64_t acc_samples(Cycle at) const { return acc_samples_of(full_interrupts(at - kScanFileCycles)); }
  static std::int64_t acc_samples_of(std::int64_t full_interrupts) {
    return (full_interrupts + kScanPeriod - 1 - kScanAccSlot) / kScanPeriod;
  }
  /// Cycle of the next interrupt; kNever when the converter is off.
  Cycle next_interrupt(Cycle at) const { return interrupt_cycle(interrupts(at) + 1); }
  /// Cycle of the interrupt that completes the `count`-th microphone sample from power-up on.
  Cycle interrupt_cycle(std::int64_t count) const { return is_on ? run.cycle_of(count - 1) : kNever; }
  /// The first interrupt after `after`, also of a converter that nobody serves; kNever: it is off.
  Cycle interrupt_after(Cycle after) const {
    const Cycle next = next_interrupt(after);
    if (held_since < 0 || !is_on || next > after) return next;
    return next + ((after - next) / run.sequence() + 1) * run.sequence();
  }
  /// Frames of the present run.
  std::int64_t frames(Cycle at) const {
    if (held_since >= 0 && at > held_since) at = held_since;
    const Cycle begin = run.origin + run.sequence();
    if (!is_on || at < begin) return 0;
    // the last one that has come by then: cycle_of() is a floor
    return 1 + static_cast<std::int64_t>(static_cast<std::uint64_t>((at - begin + 1) * kScanPeriod - 1) /
                                         static_cast<std::uint64_t>(run.round));
  }

 private:
  static std::int64_t floor_quotient(std::int64_t a, std::int64_t b) {
    const std::int64_t q = a / b;
    return a % b < 0 ? q - 1 : q;
  }
};

}  // namespace drivers
