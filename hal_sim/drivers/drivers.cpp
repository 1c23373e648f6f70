// SPDX-License-Identifier: MIT
#include "hal_sim/drivers/drivers.h"

#include <algorithm>
#include <cstdlib>

#include "hal_sim/board/board.h"

namespace drivers {

Drivers::Others::Others(board::Board& board)
    : basic_prox(board),
      i2c_master(board.i2c()),
      sound(board.codec()),
      camera(board.camera()),
      uart_rings{UartRing(board.uart(1)), UartRing(board.uart(2))} {}

Drivers::Drivers(board::Board& board, Which which)
    : board_(board),
      others_(which == Which::All ? std::make_unique<Others>(board) : nullptr),
      agendas_(board.own_motor(Wheel::Left), board.own_motor(Wheel::Right)),
      scan_(board) {
  board_.attach(this);
}

Drivers::~Drivers() { board_.attach(nullptr); }

void Drivers::mask_handlers(bool masked, Cycle at) {
  if (masked) {
    scan_.hold(at);
    agendas_.hold(at);
  } else {
    scan_.release(at);
    agendas_.release(at);
  }
}

void Drivers::init_ports(Cycle at) {
  board_.init_ports(at);
  i2c_master().switch_on(kI2cLibraryBrg, at);
}

void Drivers::bring_motor(Wheel wheel, Cycle at) {
  Stepper& motor = agendas_.stepper(wheel, at);
  if (is_on_timer(wheel)) others_->timer_motors.move(wheel, at, motor);
}

const Stepper& Drivers::motor_at(Wheel wheel, Cycle at) const {
  const Stepper& motor = agendas_.stepper_at(wheel, at);
  if (!is_on_timer(wheel)) return motor;
  others_->seen = motor;
  others_->timer_motors.peek(wheel, at, others_->seen);
  return others_->seen;
}

board::RotorCourse Drivers::motor_course(Wheel wheel, Cycle at) const {
  if (!is_on_timer(wheel)) return agendas_.course(wheel, at);
  board::RotorCourse course = motor_at(wheel, at).course(at);
  course.until = std::min(course.until, steps_horizon(wheel, at));
  return course;
}

Cycle Drivers::steps_horizon(Wheel wheel, Cycle at) const {
  const Cycle own = agendas_.steps_horizon(wheel, at);
  return others_ ? std::min(own, others_->timer_motors.steps_horizon(wheel, at)) : own;
}

Cycle Drivers::coils_horizon(Wheel wheel, Cycle at) const {
  const Cycle own = agendas_.coils_horizon(wheel, at);
  return others_ ? std::min(own, others_->timer_motors.coils_horizon(wheel, at)) : own;
}

std::optional<double> Drivers::coil_duty(Wheel wheel) const {
  if (is_on_timer(wheel)) return 1;  // these drivers leave the coils on from step to step
  if (!agendas_.runs(wheel)) return std::nullopt;
  const int magnitude = std::abs(agendas_.speed(wheel));
  if (magnitude >= kPowerSaveBelow) return 1;
  const int period = magnitude > 0 ? kSpeedUnit / magnitude : 0;
  return period > 0 ? std::min(1.0, static_cast<double>(kPowerSaveTicks) / period) : 0;
}

Cycle Drivers::pulses_horizon(Cycle at) const {
  const Cycle own = scan_.pulses_horizon(at);
  return others_ ? std::min(own, others_->basic_prox.horizon(at)) : own;
}

double Drivers::mean_pulses() const {
  double lines = 0;
  if (scan_.is_on() && !scan_.micro_only()) lines += static_cast<double>(kScanLitInterrupts) / kScanPeriod;
  if (others_ && others_->basic_prox.is_on())
    lines +=
        static_cast<double>(kBasicPulseCycles) / static_cast<double>(kBasicPulseCycles + kBasicRestCycles);
  return lines;
}

std::optional<int> Drivers::proximity_counts(int sensor, Cycle at) const {
  if (scan_.is_on() && !scan_.micro_only()) return scan_.peek_dark(sensor, at) - scan_.peek_lit(sensor, at);
  if (others_ && others_->basic_prox.is_on()) return others_->basic_prox.peek_reflected(sensor, at);
  return std::nullopt;
}

void Drivers::processor_reset(Cycle at) {
  // whatever another driver did to the wheels by now, before its train is forgotten
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) bring_motor(wheel, at);
  if (others_) others_->timer_motors.reset();
  agendas_.reset(at);
  scan_.reset(at);
  if (!others_) return;
  others_->basic_prox.reset(at);
  others_->i2c_master.processor_reset(at);
  others_->camera.reset();
  for (UartRing& ring : others_->uart_rings) ring.reset();
  others_->requests = Requests{};
}

void Drivers::add_diagnoses(std::vector<board::Diagnosis>& all, Cycle at) const {
  if (!tells_) return;
  const auto missed = [&all](const char* vector, std::int64_t count, Cycle first) {
    if (count == 0) return;
    all.push_back({"missed interrupt", vector,
                   std::string(vector) +
                       ": an event came while its flag was still set and enabled; the handler runs once for "
                       "several (too slow, or held off too long)",
                   "make agendas' functions and handlers shorter, or mask interrupts for less", first, 0,
                   count});
  };
  missed("ADC", scan_.lost_frames(), scan_.first_lost());
  missed("T2", agendas_.lost_ticks(), agendas_.first_lost());
  // a speed that nothing turns into steps; programs may set it a little before they start the motors
  const Cycle since = agendas_.first_speed();
  if (since < 0 || at - since < kSpeedGrace) return;
  const bool never_made = !agendas_.has(Wheel::Left) && !agendas_.has(Wheel::Right);
  if (!never_made && agendas_.is_enabled()) return;
  const std::string missing = never_made ? "e_init_motors()" : "e_start_agendas_processing()";
  all.push_back({"motors stand", never_made ? "e_init_motors()" : "e_start_agendas_processing()",
                 "speed set, but " + missing + " was never called: no motor turns",
                 "call " + missing + " before the loop", since, 0, 1});
}

std::uint64_t Drivers::state_sum(Cycle at) const {
  return agendas_.state_sum(at) + (others_ ? others_->timer_motors.state_sum() : 0) * 0xD6E8FEB86659FD93u +
         static_cast<std::uint64_t>(scan_.interrupts(at)) * 0x9E3779B97F4A7C15u;
}

}  // namespace drivers
