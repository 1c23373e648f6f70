// SPDX-License-Identifier: MIT
// The library's drivers that are known by heart: what each would do to the board's pins follows from the
// clock, and is worked out when somebody looks.
//
//   hal_sim's e_* functions, or a program's Puck --> Drivers --> board's pins, lazily (board::PinDriver)
//
// Time: their handlers are not run; what these take is the caller's to count.
#pragma once
#include <cstdint>
#include <optional>

#include "hal_sim/board/pin_driver.h"
#include "hal_sim/drivers/adc_scan.h"
#include "hal_sim/drivers/agenda_timer.h"

namespace board {
class Board;
class Pins;
}  // namespace board

namespace drivers {

class Drivers final : public board::PinDriver {
 public:
  /// Drives this board's pins from now on; the board outlives it.
  explicit Drivers(board::Board& board);
  ~Drivers() override;
  Drivers(const Drivers&) = delete;
  Drivers& operator=(const Drivers&) = delete;

  AgendaTimer& agendas() { return agendas_; }
  const AgendaTimer& agendas() const { return agendas_; }
  AdcScan& scan() { return scan_; }
  const AdcScan& scan() const { return scan_; }

  void bring_motor(Wheel wheel, Cycle at) override { agendas_.stepper(wheel, at); }
  const Stepper& motor_at(Wheel wheel, Cycle at) const override {
    return agendas_.motors().stepper_at(wheel, at);
  }
  Cycle steps_horizon(Wheel wheel, Cycle at) const override {
    return agendas_.motors().steps_horizon(wheel, at);
  }
  Cycle coils_horizon(Wheel wheel, Cycle at) const override {
    return agendas_.motors().coils_horizon(wheel, at);
  }
  board::RotorCourse motor_course(Wheel wheel, Cycle at) const override {
    return agendas_.motors().course(wheel, at);
  }
  std::uint64_t motor_commands() const override { return agendas_.motors().commands(); }
  std::optional<double> coil_duty(Wheel wheel) const override;
  unsigned pulses(Cycle at) const override { return scan_.pulses(at); }
  Cycle pulses_horizon(Cycle at) const override { return scan_.pulses_horizon(at); }
  double mean_pulses() const override;
  bool owns_emitters() const override { return scan_.clock().is_on; }
  std::optional<int> proximity_counts(int sensor, Cycle at) const override;
  void exchange(Cycle at) override { scan_.keep_acc(at); }
  Cycle horizon(Cycle at) const override { return scan_.keeps_acc() ? at + kAccKeepCycles : kNever; }
  void processor_reset(Cycle at) override;
  std::uint64_t state_sum(Cycle at) const override;

 private:
  board::Pins& pins_;
  AgendaTimer agendas_;
  AdcScan scan_;
};

}  // namespace drivers
