// SPDX-License-Identifier: MIT
// The infrared circuit: four emitter lines, each beside two of the eight proximity sensors, and what the
// converter makes of a sensor's phototransistor.
//
//   line 0..3 high --> emitters n and n + 4 --> reflection --> phototransistor --> 0 to 4095 counts
//
// It is told when a line's level changes (pins.h) and remembers that: results of the converter are asked for
// later. A sample depends on the instant and on how long its emitter has been on, on nothing else.
#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "hal_sim/board/specimen.h"
#include "hal_sim/board/wiring.h"

namespace board {

/// One conversion of a proximity sensor's phototransistor, before any noise.
struct IrConversion {
  double irradiance_w_m2 = 0;    ///< W/m2, lamps and ambient light
  double light_counts = 0;       ///< counts that this light pulls the sample below darkness
  double reflection_counts = 0;  ///< counts that the flash adds to that, this sensor's gain included
  double relative_noise = 0;     ///< of the reflection: standard deviation, or half width when uniform; the
                                 ///< board's own noise scale is not in it
  bool uniform_noise = false;
  double offset_counts = 0;  ///< of a lit sample
  double settled = 1;        ///< part of the flash that the phototransistor has followed, 0 to 1
  /// Without noise, not rounded and not held within the converter's range.
  double counts() const { return kAdcMax - light_counts - (reflection_counts + offset_counts) * settled; }
};

/// What the converter makes of a level given in counts: rounded, 0 to 4095.
inline int adc_counts(double level) {
  level += 0.5;
  if (!(level >= 1)) return 0;
  return level < kAdcMax ? static_cast<int>(level) : kAdcMax;
}

class IrCircuit {
 public:
  /// A flash that has lasted so long has nothing left to settle.
  static constexpr Cycle kSettled = 40 * kIrSettleCycles;

  explicit IrCircuit(const Specimen& robot) : robot_(robot) {}

  // --- emitters
  /// The level of a line 0 to 3 is this from `at` on.
  void set_line(int line, bool high, Cycle at);
  /// Lines that the processor can drive, a bit each: the others' emitters stay dark, whoever flashes them. All, at
  /// the beginning.
  void set_driven(unsigned lines) { driven_ = lines; }
  /// Lines that are high.
  int lines_on() const { return lines_on_; }
  /// Cycles for which the emitter beside a sensor has been on by its line at `at`; -1: it was off.
  Cycle lit_for(int sensor, Cycle at) const;
  /// Times that a line stayed high too long (checks_params.h), the one that goes on at `at` included.
  struct LongPulses {
    std::int64_t count = 0;
    Cycle first = 0;    ///< when the first of them began
    Cycle longest = 0;  ///< cycles
  };
  LongPulses long_pulses(int line, Cycle at) const;

  // --- samples; `lit_for` cycles for which the emitter has been on, negative: it is off
  /// Counts of a sensor's phototransistor that is held at `at`, noise (noise.h) and damage included.
  int counts(int sensor, Cycle at, Cycle lit_for) const;
  /// The same of a lit sample while is_dark().
  int counts_in_dark(int sensor, Cycle at, Cycle lit_for) const;
  /// The same sample without noise: what a conversion is made of.
  IrConversion conversion(int sensor, Cycle at, Cycle lit_for) const;
  /// Dark minus lit of a noise-free pair taken at `at`.
  int proximity_counts(int sensor, Cycle at) const;
  /// Is every dark sample at the converter's top: no light, no noise?
  bool is_dark() const {
    return robot_.setup().ambient_noise_counts == 0 && !robot_.is_lit() && !robot_.damage();
  }

 private:
  /// When a line went up and down, in turns.
  struct Line {
    static constexpr int kRemembered = 16;
    std::array<Cycle, kRemembered> changed{};
    int changes = 0;
    LongPulses too_long;

    bool is_on() const { return changes % 2 != 0; }
    /// When change `n` came, from 0; -1: there was none, or it is forgotten.
    Cycle when(int n) const {
      return n < 0 || n < changes - kRemembered ? -1 : changed[static_cast<std::size_t>(n % kRemembered)];
    }
    void note_pulse(LongPulses& pulses, Cycle end) const;
  };
  /// Sensors n and n + 4 are beside line n.
  bool is_driven(int sensor) const { return (driven_ >> sensor % kEmitterLines & 1) != 0; }
  /// Counts that light pulls a dark sample down, and that its noise adds to this.
  double light_counts(int sensor, Cycle at) const;
  double ambient_noise(int sensor, Cycle at, bool lit) const;
  /// Counts that the flash adds to a lit sample, noise included.
  double reflected_counts(int sensor, Cycle at, Cycle lit_for) const;
  /// Part of the flash that a phototransistor has followed, 0 to 1.
  double settled_share(int sensor, Cycle lit_for) const;
  __attribute__((noinline)) int damaged_counts(int sensor, Cycle at, Cycle lit_for) const;

  const Specimen& robot_;
  int lines_on_ = 0;
  unsigned driven_ = (1u << kEmitterLines) - 1;
  std::unique_ptr<std::array<Line, kEmitterLines>> lines_;  // null: no line was ever high
  struct Settled {
    Cycle lit_for = -1;
    double share = 0;
    __attribute__((noinline)) void settle(Cycle flash);
  };
  mutable std::array<Settled, 2>
      settled_;  // flashes have two lengths nearly always: their exponentials, once
};

}  // namespace board
