// SPDX-License-Identifier: MIT
// Whoever moves pins of the board without being asked at each change: the library's drivers in closed form.
// The board asks when somebody looks at what they move; it knows no driver.
#pragma once
#include <cstdint>
#include <optional>

#include "hal_sim/board/stepper.h"

namespace board {

class PinDriver {
 public:
  virtual ~PinDriver() = default;

  // --- motors
  /// Brings the board's motor of a wheel to `at`; pins are written next.
  virtual void bring_motor(Wheel wheel, Cycle at) = 0;
  /// The motor as it is at `at`; valid until the next call of anything here.
  virtual const Stepper& motor_at(Wheel wheel, Cycle at) const = 0;
  /// How the rotor turns on: over steps to come at their mean rate, as far as the driver knows them.
  virtual RotorCourse motor_course(Wheel wheel, Cycle at) const = 0;
  /// Is another number once a wheel may turn otherwise than motor_course() said of it.
  virtual std::uint64_t motor_commands() const = 0;
  /// Cycle before which the driver energises no other coils, or switches none off.
  virtual Cycle steps_horizon(Wheel wheel, Cycle at) const = 0;
  virtual Cycle coils_horizon(Wheel wheel, Cycle at) const = 0;
  /// Share of the time for which both coils are energised, 0 to 1; empty: the driver rests.
  virtual std::optional<double> coil_duty(Wheel wheel) const = 0;

  // --- IR emitters
  /// Lines that are high at `at`: bit = pair; bit 4 the turret's (body and front LED). Next change of these.
  virtual unsigned pulses(Cycle at) const = 0;
  virtual Cycle pulses_horizon(Cycle at) const = 0;
  /// How many lines are high on average; 0 and no others' business when it does not own them.
  virtual double mean_pulses() const = 0;
  virtual bool owns_emitters() const = 0;
  /// Dark minus lit of the newest samples that it has taken; empty: it takes none.
  virtual std::optional<int> proximity_counts(int sensor, Cycle at) const = 0;

  // --- the rest
  /// Tick boundary; until when there is nothing to do at the next ones.
  virtual void exchange(Cycle at) = 0;
  virtual Cycle horizon(Cycle at) const = 0;
  virtual void processor_reset(Cycle at) = 0;
  /// State at `at` as a sum of products, for a hash: the caller mixes it.
  virtual std::uint64_t state_sum(Cycle at) const = 0;
};

}  // namespace board
