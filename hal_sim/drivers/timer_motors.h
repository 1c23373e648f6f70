// SPDX-License-Identifier: MIT
// The two motor drivers that own a timer, in closed form: a step at every interrupt of a train that began
// with the last command.
//
//   basic:   Timer 5 left, Timer 4 right; period (57600/|v| + 1) x 256 cycles, restarted by every command;
//            coils stay on while it runs; 0 stops the timer and switches them off.
//   timer 3: one tick of 1536 cycles for both; a step every 10000/|v| ticks; at speed 0 every tick switches
//            the coils off.
//
// The drivers' statics (phase, counter) are theirs; the motor they move is the AgendaTimer's, handed in at
// each call.
// Not modelled: this driver and the agenda driver moving the same wheel at the same time, which needs two
// copies of the library in one program; steps then come in the wrong order.
// Sources: [lib: motor_led/e_motors.c], [lib: motor_led/e_motors_timer3.c], facts restated.
#pragma once
#include <cstdint>

#include "hal_sim/board/stepper.h"
#include "hal_sim/drivers/agenda_timer.h"

namespace drivers {

/// Steps at `next`, `next` + `period`, ...; both drivers of one wheel are this.
struct StepTrain {
  bool running = false;
  Cycle next = 0;
  Cycle period = 0;
  Cycle coils_off_at = -1;  ///< timer 3 at speed 0: the next tick; -1 otherwise
  int speed = 0;
  int phase = 0;
  std::int64_t commanded = 0;  ///< steps counted by the driver, not wrapped

  /// Performs everything up to and including `at`.
  void advance_to(Cycle at, Stepper& stepper);

 private:
  int direction(const Stepper& stepper) const;
};

class TimerMotors {
 public:
  enum class Driver { Basic, Timer3 };

  /// e_init_motors() of the timer 3 driver: its timer starts. (The basic driver has nothing to start.)
  void start_timer3(Cycle at);
  void set_speed(Driver driver, Wheel wheel, int speed, Cycle at, Stepper& stepper);
  std::int64_t commanded_steps(Driver driver, Wheel wheel, Cycle at, const Stepper& stepper) const;
  /// Cycle before which the step counters, or the coils, keep their state without a command.
  Cycle steps_horizon(Wheel wheel, Cycle at) const;
  Cycle coils_horizon(Wheel wheel, Cycle at) const;
  /// Applies what happened up to `at` to the wheel's motor, or to a copy of it.
  void move(Wheel wheel, Cycle at, Stepper& stepper);
  void peek(Wheel wheel, Cycle at, Stepper& copy) const;
  bool drives(Wheel wheel) const {
    return was_used_ && (trains_[0][index(wheel)].running || trains_[1][index(wheel)].running ||
                         trains_[1][index(wheel)].coils_off_at >= 0);
  }
  /// The last commands, for a hash.
  std::uint64_t state_sum() const {
    constexpr std::uint64_t kFactor = 4099, kRest = 2048;
    if (!was_used_) return ((kRest * kFactor + kRest) * kFactor + kRest) * kFactor + kRest;
    std::uint64_t sum = 0;
    for (const auto& of_driver : trains_)
      for (const StepTrain& t : of_driver) sum = sum * kFactor + static_cast<std::uint64_t>(t.speed) + kRest;
    return sum;
  }
  /// Cycles between two interrupts of the basic driver; 0 when stopped.
  Cycle interrupt_period(Wheel wheel) const;
  void reset();

 private:
  static int index(Wheel wheel) { return static_cast<int>(wheel); }
  StepTrain& train(Driver driver, Wheel wheel) { return trains_[static_cast<int>(driver)][index(wheel)]; }
  const StepTrain& train(Driver driver, Wheel wheel) const {
    return trains_[static_cast<int>(driver)][index(wheel)];
  }

  bool was_used_ = false;   // since the reset; else the trains need not be looked at
  StepTrain trains_[2][2];  // [driver][wheel]
  bool timer3_runs_ = false;
  Cycle timer3_origin_ = 0;
};

}  // namespace drivers
