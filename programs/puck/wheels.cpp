// SPDX-License-Identifier: MIT
#include "programs/puck/wheels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace programs {

namespace {

constexpr double kStepsPerRad = kWheelSteps / (2 * 3.14159265358979323846);
constexpr Cycle kLookCycles = 147456;  // 10 ms, for one wheel after the other
constexpr int kGain = 10;              // steps/s for each step that is missing
constexpr double kMostSteps = 1e12;    // far beyond what a wheel gets to

// what the driver calls run_left_motor() and run_right_motor(); only compared
const char kMotors[2] = {0, 0};

board::Wheel wheel_of(int wheel) { return wheel == 0 ? board::Wheel::Left : board::Wheel::Right; }

int steps_s(double rad_s) {
  return static_cast<int>(std::lround(std::clamp(rad_s, -kMostWheelRadS, kMostWheelRadS) * kStepsPerRad));
}

}  // namespace

void Wheels::start(Cycle at) {
  for (const int wheel : {0, 1}) {
    agendas_.name_motor(wheel_of(wheel), &kMotors[wheel]);
    agendas_.activate(&kMotors[wheel], 0, at);
  }
  agendas_.start(at);
}

void Wheels::command(int wheel, int speed, Cycle at) {
  // repeating a speed would begin the motor's half step anew
  if (wheels_[static_cast<std::size_t>(wheel)].command == speed) return;
  wheels_[static_cast<std::size_t>(wheel)].command = speed;
  agendas_.set_speed(wheel_of(wheel), speed, at);
  board_.pins().follow_motor(wheel_of(wheel), at);
}

void Wheels::set_velocity(int wheel, double rad_s, Cycle at) {
  if (std::isnan(rad_s)) return;
  Wheel& w = wheels_[static_cast<std::size_t>(wheel)];
  w.velocity_rad_s = std::clamp(rad_s, -kMostWheelRadS, kMostWheelRadS);
  if (w.is_free) command(wheel, steps_s(w.velocity_rad_s), at);
}

void Wheels::set_position(int wheel, double rad, Cycle at) {
  if (std::isnan(rad)) return;
  Wheel& w = wheels_[static_cast<std::size_t>(wheel)];
  w.is_free = std::isinf(rad);
  if (w.is_free) {
    command(wheel, steps_s(rad > 0 ? w.velocity_rad_s : -w.velocity_rad_s), at);
    if (wheels_[0].is_free && wheels_[1].is_free) next_ = board::kNever;
    return;
  }
  w.target_steps = std::llround(std::clamp(rad * kStepsPerRad, -kMostSteps, kMostSteps));
  if (next_ == board::kNever) next_ = at;
}

double Wheels::angle_rad(int wheel, Cycle at) const {
  return static_cast<double>(agendas_.motors().commanded_steps(wheel_of(wheel), at)) / kStepsPerRad;
}

void Wheels::approach(int wheel, Cycle at) {
  const Wheel& w = wheels_[static_cast<std::size_t>(wheel)];
  if (w.is_free) return;
  const std::int64_t missing = w.target_steps - agendas_.motors().commanded_steps(wheel_of(wheel), at);
  const int most = std::abs(steps_s(w.velocity_rad_s));
  const int speed = static_cast<int>(std::clamp<std::int64_t>(missing * kGain, -most, most));
  if (speed == w.command) return;
  // near the target each step would bring another speed; a tenth is near enough
  const int change = std::abs(speed - w.command), tenth = std::abs(w.command);
  if (speed != 0 && (speed > 0) == (w.command > 0) && change * 10 < tenth) return;
  command(wheel, speed, at);
}

void Wheels::run(Cycle at) {
  while (next_ <= at) {
    approach(turn_, next_);
    turn_ ^= 1;
    next_ += kLookCycles;
  }
}

void Wheels::stop(Cycle at) {
  next_ = board::kNever;
  for (const int wheel : {0, 1}) command(wheel, 0, at);
}

}  // namespace programs
