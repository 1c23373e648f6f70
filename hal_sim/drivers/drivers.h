// SPDX-License-Identifier: MIT
// The library's drivers that the native way knows by heart: what each would do to the board's pins follows
// from the clock, and is worked out when somebody looks.
//
//   e_* API -- exports --> Drivers --> board's pins, lazily (board::PinDriver)
//
// Time: their handlers are not run. What these take is a share of all cycles (handler_share_q32()); while the
// program masks them they do not come (mask_handlers()).
#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "hal_sim/board/pin_driver.h"
#include "hal_sim/drivers/adc_scan.h"
#include "hal_sim/drivers/agenda_timer.h"
#include "hal_sim/drivers/basic_prox.h"
#include "hal_sim/drivers/camera_capture.h"
#include "hal_sim/drivers/i2c_master.h"
#include "hal_sim/drivers/sound_driver.h"
#include "hal_sim/drivers/timer_motors.h"
#include "hal_sim/drivers/uart_ring.h"

namespace drivers {

class Drivers final : public board::PinDriver {
 public:
  /// Busy: agendas and scan alone, as hal_sim has them; the others must not be asked for.
  enum class Which { All, Busy };
  /// Drives this board's pins from now on; the board outlives it.
  explicit Drivers(board::Board& board, Which which = Which::All);
  ~Drivers() override;
  Drivers(const Drivers&) = delete;
  Drivers& operator=(const Drivers&) = delete;

  AgendaTimer& agendas() { return agendas_; }
  const AgendaTimer& agendas() const { return agendas_; }
  AdcScan& scan() { return scan_; }
  const AdcScan& scan() const { return scan_; }
  TimerMotors& timer_motors() { return others_->timer_motors; }
  BasicProx& basic_prox() { return others_->basic_prox; }
  I2cMaster& i2c_master() { return others_->i2c_master; }
  SoundDriver& sound() { return others_->sound; }
  CameraCapture& camera() { return others_->camera; }
  UartRing& uart_ring(int number) { return others_->uart_rings[number == 2 ? 1 : 0]; }

  /// What the handlers of the scan and of the agenda tick take of each cycle, as a fraction of 2^32.
  std::uint64_t handler_share_q32() const { return scan_.share_q32() + agendas_.share_q32(); }
  /// Somebody else tells of motors that were never started, and of interrupts that were missed.
  void leave_telling_to_others() { tells_ = false; }
  /// The program masks these handlers from `at` on, or does no longer.
  void mask_handlers(bool masked, Cycle at);

  /// What the exported functions last asked of the host, so that they ask only when it changed.
  struct Requests {
    static constexpr Cycle kUnknown = -2;
    Cycle agenda_interrupt = -1;
    std::array<Cycle, 16> background_period{};
    std::array<Cycle, 16> background_cost{};
  };
  Requests& requests() { return others_->requests; }

  void bring_motor(Wheel wheel, Cycle at) override;
  const Stepper& motor_at(Wheel wheel, Cycle at) const override;
  Cycle steps_horizon(Wheel wheel, Cycle at) const override;
  Cycle coils_horizon(Wheel wheel, Cycle at) const override;
  board::RotorCourse motor_course(Wheel wheel, Cycle at) const override;
  std::optional<double> coil_duty(Wheel wheel) const override;
  unsigned pulses(Cycle at) const override {
    return scan_.pulses(at) | (others_ ? others_->basic_prox.pulses(at) : 0);
  }
  Cycle pulses_horizon(Cycle at) const override;
  double mean_pulses() const override;
  bool owns_emitters() const override { return scan_.is_on() || (others_ && others_->basic_prox.is_on()); }
  std::optional<int> proximity_counts(int sensor, Cycle at) const override;
  void exchange(Cycle at) override { scan_.keep_acc(at); }
  Cycle horizon(Cycle at) const override { return scan_.keeps_acc() ? at + kAccKeepCycles : kNever; }
  void processor_reset(Cycle at) override;
  void add_diagnoses(std::vector<board::Diagnosis>& all, Cycle at) const override;
  std::uint64_t state_sum(Cycle at) const override;
  std::uint64_t bus_state() const override { return others_ ? others_->i2c_master.state_hash() : 0; }
  /// e_init_port(): the board's pins, then a question over the bus that leaves the module on, its interrupt
  /// off.
  void init_ports(Cycle at);

 private:
  struct Others {
    explicit Others(board::Board& board);
    TimerMotors timer_motors;
    BasicProx basic_prox;
    I2cMaster i2c_master;
    SoundDriver sound;
    CameraCapture camera;
    std::array<UartRing, 2> uart_rings;
    Stepper seen{+1};  // what motor_at() shows of a timer's train
    Requests requests;
  };
  /// Does a timer's train move this wheel?
  bool is_on_timer(Wheel wheel) const { return others_ && others_->timer_motors.drives(wheel); }

  board::Board& board_;
  std::unique_ptr<Others> others_;
  bool tells_ = true;
  AgendaTimer agendas_;
  AdcScan scan_;
};

}  // namespace drivers
