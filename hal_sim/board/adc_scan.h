// SPDX-License-Identifier: MIT
// The converter and its interrupt as a_d/advance_ad_scan runs them, in closed form.
//
//   slot (interrupts since the start mod 65):   3  lit pair arrives, IR LED off, next pair
//                                              62  accelerometer arrives
//                                              63  dark pair arrives, IR LED on
//   every interrupt: 3 microphones. 65 frames = 58500 cycles (450 each with MICRO_ONLY); single ones are
//   longer or shorter, because the converter stands while its list changes (scan_handler()) a pair's samples
//   are the 4th and 5th channel of the frame that ends at its interrupt
//
// Nothing is ticked: the number of interrupts so far follows from the clock, and a sample is evaluated when
// somebody asks for it, at the instant at which it was taken. It is then kept, so it never changes.
// Modelled: both rates, stopping and starting the converter, 4 or 5 pairs, the sample before the first flash.
// Accelerometer samples are kept tick by tick from the first time that a program asks for one; those of
// before are worked out then, from poses of at most 40 ms ago. Not modelled: turret sensors 8 and 9 (read 0),
// which in their frames come before the microphones.
// Source: [lib: a_d/advance_ad_scan/e_ad_conv.c], facts restated.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "hal_sim/board/epuck_params.h"

namespace board {

class AgendaTimer;
class Board;

/// Cycles for which the emitter of a ring sensor has been on when its lit sample is held.
Cycle scan_flash_cycles(int sensor);

class AdcScan {
 public:
  explicit AdcScan(const Board& board) : board_(board) {}

  /// e_init_ad_scan(): converter and interrupt start. `five_pairs`: selector 10.
  void start(bool micro_only, bool five_pairs, Cycle at);
  /// ADON bit. Off: the frame under way is lost; on: a full frame begins.
  void switch_converter(bool on, Cycle at);
  /// The driver's statics and arrays return to their start values.
  void reset(Cycle at);

  /// The driver's counter of interrupts is set to 0.
  void restart_ticks(Cycle at) { ticks_base_ = interrupts(at); }

  /// Calls of start() since the last reset.
  int starts() const { return starts_; }
  bool is_on() const { return on_; }
  bool micro_only() const { return micro_only_; }

  /// Interrupts so far, in both modes.
  std::int64_t interrupts(Cycle at) const { return total_base_ + frames(at); }
  /// Accelerometer samples so far.
  std::int64_t acc_samples(Cycle at) const { return acc_samples_of(full_interrupts(at - kScanFileCycles)); }
  /// Cycle of the next interrupt; kNever when the converter is off.
  Cycle next_interrupt(Cycle at) const { return next_call(at + 1); }
  /// Cycle of the interrupt that completes the `count`-th microphone sample from power-up on.
  Cycle interrupt_cycle(std::int64_t count) const;

  // --- the time that its handler takes from the program ----------------------------------------------
  /// A call of a handler: when it is asked for, and how long it takes. None: `at` below 0, 0 cycles.
  struct Call {
    Cycle at = -host::kNever, cycles = 0;
  };
  /// Cycles of the calls asked for in [from, to), neither before the last start() or switch_converter().
  Cycle handler_cycles(Cycle from, Cycle to) const { return cycles_before(to) - cycles_before(from); }
  /// What they take of each cycle on average, as a fraction of 2^32.
  std::uint64_t share_q32() const;
  /// The newest call before `at`.
  Call last_call(Cycle at) const;
  /// When the first call from `at` on is asked for; kNever.
  Cycle next_call(Cycle at) const;
  /// `at`, or when the next handler's turn comes after the call that runs then.
  Cycle free_from(Cycle at) const { return free_from(last_call(at), at); }
  /// When `work` cycles of another handler, begun at `from`, are done that calls interrupt.
  Cycle done(Cycle from, Cycle work) const;
  /// The same of a handler that is asked for at `asked`: free_from() and done().
  Cycle served(Cycle asked, Cycle work) const;
  /// A call that must wait for a cycle or two, because the processor is on its way into Timer 2's handler or
  /// out of it, while the converter stands: everything after comes as much later.
  struct Delay {
    std::int64_t stops = 0;  ///< of the converter, looked at so far
    Cycle at = 0;            ///< when the call is asked for
    Cycle cycles = 0;        ///< 0: none
  };
  /// The first since the last note() and before `until`; `ticks` settled no later than that.
  Delay next_delay(const AgendaTimer& ticks, Cycle until) const;
  /// That of a call that comes during a RETFIE at `at`; calls since the last note() did not wait.
  Delay delay_at_exit(Cycle at) const;
  /// Calls before `at` did not wait.
  void pass(Cycle at) {
    if (on_ && !micro_only_) noted_stops_ = stops_before(at);
  }
  void note(const Delay& d) {
    noted_stops_ = d.stops;
    round_ += d.cycles;
  }

  /// When a program sees first, from `at` on, that the accelerometer index is 49: e_init_ad_scan() returns.
  Cycle first_fill(Cycle at) const;

  /// e_ambient_ir[sensor] and e_ambient_and_reflected_ir[sensor] at `at`; 0 before the first sample. Keeps
  /// the value.
  int dark(int sensor, Cycle at);
  int lit(int sensor, Cycle at);
  /// Cycle before which what dark() or lit() returned last stays true.
  Cycle dark_until(int sensor) const { return dark_[static_cast<std::size_t>(sensor)].until; }
  Cycle lit_until(int sensor) const { return lit_[static_cast<std::size_t>(sensor)].until; }
  /// The same without keeping anything.
  int peek_dark(int sensor, Cycle at) const;
  int peek_lit(int sensor, Cycle at) const;
  /// Cycle before which neither of the two changes.
  Cycle horizon(int sensor, Cycle at);

  /// Counts of the `number`-th microphone sample since reset (from 0), which is one of the last 100. Nothing
  /// is kept: its instant is known, and the air's pressure at an instant does not change.
  int mic_sample(int microphone, std::int64_t number) const;
  /// Cycle at which that sample is held.
  Cycle mic_hold(int microphone, std::int64_t number) const;

  using AccRing = std::array<std::array<std::int16_t, kAccSamples>, 3>;
  /// e_acc_scan at `at`: 0 where nothing was sampled yet. Index 0 is filled last, as in the driver.
  const AccRing& acc_scan(Cycle at);
  /// Cycle at which the next accelerometer sample arrives; kNever when none will.
  Cycle acc_until(Cycle at) const;
  /// Works out the samples so far, if a program has asked for any before.
  void keep_acc(Cycle at) {
    if (acc_used_) fill_acc(acc_samples(at));
  }

  /// IR emitter lines that the scan holds on: bit = pair; bit 4 the turret's (body and front LED).
  unsigned pulses(Cycle at) const;
  /// Next change of pulses().
  Cycle pulses_horizon(Cycle at) const;

  /// Number of the newest sample of each kind, -1 none: changes exactly when the value does.
  std::int64_t dark_number(int sensor, Cycle at) const;
  std::int64_t lit_number(int sensor, Cycle at) const;

 private:
  struct Sample {
    std::int64_t number = -1;
    int counts = 0;
    Cycle until = 0;  // the next sample of this kind arrives then; 0: not known
  };

  /// A run of frames that is over.
  struct Run {
    std::int64_t first = 0;  // number of its first interrupt
    std::int64_t full = 0;   // ALL_ADC interrupts before it
    Cycle round = 0;         // round_
    bool micro_only = false;
  };

  /// Of the present run.
  std::int64_t frames(Cycle at) const;
  static std::int64_t acc_samples_of(std::int64_t full_interrupts) {
    return (full_interrupts + kScanPeriod - 1 - kScanAccSlot) / kScanPeriod;
  }
  std::int64_t full_interrupts(Cycle at) const { return full_base_ + (micro_only_ ? 0 : frames(at)); }
  /// A call: round since round_, and slot in it; MICRO_ONLY: its number and 0.
  struct Place {
    std::int64_t round;
    int slot;
  };
  Place place(Cycle at) const;
  /// Of interrupts since reset, in either mode.
  std::int64_t number(Place p) const {
    return total_base_ + (micro_only_ ? p.round : p.round * kScanPeriod + p.slot - first_slot_);
  }
  /// Of these, those that found the counter of interrupts at its end; below 0: it still counts.
  std::int64_t uncounted(Place p) const { return number(p) - ticks_base_ - kScanTicksMost; }
  bool is_wrap(Place p) const { return number(p) % kMicSamples == kMicSamples - 1; }
  static Cycle free_from(Call before, Cycle at) {
    return at < before.at + before.cycles ? before.at + before.cycles + kChainCycles : at;
  }
  Place after(Place p) const;
  Cycle cycle_of(Place p) const;
  Call call(Place p) const;
  Call call_before(Place p) const;
  Cycle done(Place next, Cycle end) const;
  void find_round(Cycle at);
  std::int64_t stops_before(Cycle at) const;
  Cycle cycles_before(Cycle at) const;
  int pair_of_lit(std::int64_t period) const;  // pair whose lit sample arrives in this period
  std::int64_t newest(std::int64_t interrupts, int slot, int shift, int pair) const;
  Cycle full_cycle(std::int64_t interrupt) const;  // of ALL_ADC interrupt number (from 0)
  /// When the next sample is filed of `slot` and `pair`, after `filed` interrupts; kNever when none will.
  Cycle next_sample(std::int64_t filed, int slot, int shift, int pair) const;
  int evaluate(int sensor, std::int64_t period, bool lit_sample) const;
  int read(Sample& kept, int sensor, Cycle at, bool lit_sample);
  void keep(Sample& kept, int sensor, std::int64_t number, bool lit_sample) const;
  void settle(Cycle at);
  void fill_acc(std::int64_t count);

  const Board& board_;
  bool on_ = false;
  bool micro_only_ = false;
  int starts_ = 0;
  int pairs_ = 4;
  Cycle round_ = 0;                // calls of this run are counted in rounds from here on
  std::int64_t first_period_ = 0;  // of the first round
  int first_slot_ = 0;             // in it
  std::int64_t noted_stops_ = 0;   // of the converter, since round_
  std::int64_t ticks_base_ = 0;    // interrupts before the counter of interrupts stood at 0
  std::int64_t total_base_ = 0;    // interrupts before this run
  std::int64_t full_base_ = 0;     // of these, in ALL_ADC mode: the driver's slot counter
  std::int64_t period_base_ = 0;   // from this period on ...
  int pair_base_ = 0;              // ... pairs count from here
  std::vector<Run> runs_;          // those that the last 100 microphone samples come from
  std::array<Sample, 10> dark_{};
  std::array<Sample, 10> lit_{};
  AccRing acc_{};
  bool acc_used_ = false;
  std::int64_t acc_kept_ = 0;  // samples in acc_
};

}  // namespace board
