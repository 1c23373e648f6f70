// SPDX-License-Identifier: MIT
// The converter and its interrupt as a_d/advance_ad_scan runs them, in closed form.
//
//   slot (interrupts since the start mod 65):   3  lit pair arrives, IR LED off, next pair
//                                              62  accelerometer arrives
//                                              63  dark pair arrives, IR LED on
//   every interrupt: 3 microphones. A frame takes 965 cycles: 900 of conversions, and 65 in which the
//   converter stands until the handler has listed the next channels (450 and none with MICRO_ONLY); a pair's
//   samples are the 4th and 5th channel of the frame that ends at its interrupt
//
// Nothing is ticked: the number of interrupts so far follows from the clock by one division, and a sample is
// evaluated when somebody asks for it, at its nominal instant. It is then kept, so it never changes.
// While the program masks the handler (hold()), nothing is filed; of what came meanwhile the newest is.
// Modelled: both rates, stopping and starting the converter, 4 or 5 pairs, the sample before the first flash.
// Accelerometer samples are kept tick by tick from the first time that a program asks for one; those of
// before are worked out then, from poses of at most 40 ms ago. Not modelled: turret sensors 8 and 9 (read 0),
// which in their frames come before the microphones; that four frames of 65 are up to 2 % longer; that the
// converter stands longer when another handler runs at a sequence's end (0.2 % with agendas). Source: [lib:
// a_d/advance_ad_scan/e_ad_conv.c], facts restated.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "hal_sim/drivers/scan_clock.h"

namespace board {
class AnalogueInputs;
class IrCircuit;
}  // namespace board

namespace drivers {

/// Cycles for which the emitter of a ring sensor has been on when its lit sample is held.
Cycle scan_flash_cycles(int sensor);

class AdcScan {
 public:
  /// `inputs`: what it samples; they outlive it.
  explicit AdcScan(const board::AnalogueInputs& inputs);

  /// e_init_ad_scan(): converter and interrupt start. `five_pairs`: selector 10.
  void start(bool micro_only, bool five_pairs, Cycle at);
  /// What 65 frames take from `at` on; of MICRO_ONLY they take what they take.
  void set_round(Cycle round, Cycle at);
  /// ADON bit. Off: the frame under way is lost; on: a full frame begins.
  void switch_converter(bool on, Cycle at);
  /// The driver's statics and arrays return to their start values.
  void reset(Cycle at);

  /// From `at` on the handler is not called, because the program masks it; and is again.
  void hold(Cycle at) {
    if (clock_.held_since < 0) clock_.held_since = at;
  }
  void release(Cycle at);

  /// Calls of start() since the last reset.
  int starts() const { return starts_; }
  /// Does it take the turret's pair, too?
  bool five_pairs() const { return pairs_ == 5; }

  /// When its interrupts come, and have come.
  const ScanClock& clock() const { return clock_; }

  /// When a program sees first, from `at` on, that the accelerometer index is 49: e_init_ad_scan() returns.
  Cycle first_fill(Cycle at) const;

  /// e_ambient_ir[sensor] and e_ambient_and_reflected_ir[sensor] at `at`; 0 before the first
  /// sample. Keeps the value.
  int dark(int sensor, Cycle at);
  int lit(int sensor, Cycle at);
  /// The first at one instant less the second at another, as a program reads a sensor.
  int dark_less_lit(int sensor, Cycle dark_at, Cycle lit_at);
  /// Both, and the cycle before which neither changes.
  struct Pair {
    int dark = 0, lit = 0;
    Cycle until = 0;
  };
  Pair pair(int sensor, Cycle at);
  /// The same without keeping anything.
  int peek_dark(int sensor, Cycle at) const;
  int peek_lit(int sensor, Cycle at) const;

  /// Counts of the `number`-th microphone sample since reset (from 0), which is one of the last 100. Nothing
  /// is kept: its instant is known, and the air's pressure at an instant does not change.
  int mic_sample(int microphone, std::int64_t number) const;
  /// Cycle at which that sample is held.
  Cycle mic_hold(int microphone, std::int64_t number) const;

  using AccRing = std::array<std::array<std::int16_t, kAccSamples>, 3>;
  /// e_acc_scan at `at`: 0 where nothing was sampled yet. Index 0 is filled last, as in the driver.
  const AccRing& acc_scan(Cycle at);
  /// One of its entries without keeping anything.
  int peek_acc(int axis, int index, Cycle at) const;
  /// Cycle at which the next accelerometer sample arrives; kNever when none will.
  Cycle acc_until(Cycle at) const;
  bool keeps_acc() const { return acc_used_; }
  /// Works out the samples so far, if a program has asked for any before.
  void keep_acc(Cycle at) {
    if (acc_used_) fill_acc(clock_.acc_samples(at));
  }

  /// IR emitter lines that the scan holds on: bit = pair; bit 4 the turret's (body and front LED).
  unsigned pulses(Cycle at) const;
  /// Next change of pulses().
  Cycle pulses_horizon(Cycle at) const;

  /// Number of the newest sample of each kind, -1 none: changes exactly when the value does.
  std::int64_t dark_number(int sensor, Cycle at) const;
  std::int64_t lit_number(int sensor, Cycle at) const;

 private:
  /// Is its dark value the one that darkness gives, for as long as nothing shines?
  bool stays_dark(int sensor) const;
  struct Sample {
    Cycle until = 0;           // the next sample of this kind arrives then; 0: not known
    std::int32_t number = -1;  // lasts 3 months at 235 periods a second
    std::int16_t counts = 0;
    bool is_regular = false;  // it does, and the others follow turn by turn
  };
  // a program reads all sensors one after the other: the less memory they take, the fewer waits for it
  static_assert(sizeof(Sample) == 16);
  using Samples = std::array<Sample, 10>;

  int pair_of_lit(std::int64_t period) const;  // pair whose lit sample arrives in this period
  std::int64_t newest(std::int64_t interrupts, int slot, int shift, int pair) const;
  /// When the next sample is filed of `slot` and `pair`, after `filed` interrupts; kNever when none will.
  Cycle next_sample(std::int64_t filed, int slot, int shift, int pair) const;
  int evaluate(int sensor, std::int64_t period, bool lit_sample) const;
  Cycle turn_to(Sample& kept, int sensor, Cycle at) const;
  int read(Sample& kept, int sensor, Cycle at, bool lit_sample);
  int read_anew(Sample& kept, int sensor, Cycle at, bool lit_sample);
  /// dark_less_lit() of two samples that both have to be looked at.
  __attribute__((noinline)) int both_read(int sensor, Cycle dark_at, Cycle lit_at);
  void keep(Sample& kept, int sensor, std::int64_t number, bool lit_sample) const;
  void settle(Cycle at);
  int evaluate_acc(int axis, std::int64_t sample) const;
  void fill_acc(std::int64_t count);

  Samples lit_{};
  const board::IrCircuit& ir_;
  const board::AnalogueInputs& inputs_;
  ScanClock clock_;
  bool acc_used_ = false;
  std::uint16_t regular_dark_ = 0;  // bit i: dark_[i].is_regular
  int pairs_ = 4;
  Samples dark_{};  // in darkness nobody looks at them
  int starts_ = 0;
  std::int64_t period_base_ = 0;      // from this period on ...
  int pair_base_ = 0;                 // ... pairs count from here
  std::vector<ScanClock::Run> runs_;  // those over that the last 100 microphone samples come from
  std::unique_ptr<AccRing> acc_;      // null: all are 0
  std::int64_t acc_kept_ = 0;         // samples in acc_
};

}  // namespace drivers
