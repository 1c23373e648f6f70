// SPDX-License-Identifier: MIT
// motor_led/advance_one_timer/e_motors.h. Source:
// [lib: motor_led/advance_one_timer/e_motors.c], facts restated.
#include "hal_sim/api/host_functions.h"
#include "hal_sim/api/host_library.h"
#include "hal_sim/board/board.h"

namespace api {

namespace {

using board::Wheel;

HostFunction run_of(Wheel wheel) {
  return wheel == Wheel::Left ? HostFunction::run_left_motor : HostFunction::run_right_motor;
}
std::size_t index_of(Wheel wheel) { return wheel == Wheel::Left ? 0 : 1; }

}  // namespace

// --- speeds

/// What setting takes. The coils go off at once; the agenda's cycle is what the function sets last, or for
/// speed 0 all but last.
__attribute__((always_inline)) inline Cycle HostLibrary::set_speed(const Call& call, Wheel wheel, int speed,
                                                                   Cycle at) {
  const CallCycles& c = cycles_;
  const bool left = wheel == Wheel::Left;
  Cycle cost = speed == 0                    ? (left ? c.left_zero : c.right_zero)
               : speed > drivers::kMaxSpeed  ? (left ? c.left_above : c.right_above)
               : speed > 0                   ? (left ? c.left_forward : c.right_forward)
               : speed < -drivers::kMaxSpeed ? (left ? c.left_below : c.right_below)
                                             : (left ? c.left_backward : c.right_backward);
  cost += cost_of_set_cycle(key_of(run_of(wheel)));
  const Cycle then = at + cost - 2 * kReturnCycles;
  if (agendas().set_speed(wheel, speed, then, at + kReturnCycles)) {
    board_.pins().follow_motor(wheel, then);
    changed(call);
  }
  return cost;
}

HostResult HostLibrary::e_set_speed_left(const Call& call) {
  effect(call);
  return HostResult::done(set_speed(call, Wheel::Left, call.number(0), call.at));
}

HostResult HostLibrary::e_set_speed_right(const Call& call) {
  effect(call);
  return HostResult::done(set_speed(call, Wheel::Right, call.number(0), call.at));
}

HostResult HostLibrary::e_set_speed(const Call& call) {
  const CallCycles& c = cycles_;
  const std::uint16_t linear = call.word(0), angular = call.word(1);
  const bool backward = linear & 0x8000, right_turn = angular & 0x8000;
  // magnitudes and sums wrap at 16 bits
  const auto sum =
      static_cast<std::int16_t>((backward ? 0u - linear : linear) + (right_turn ? 0u - angular : angular));
  if (sum > drivers::kMaxSpeed)
    return HostResult::done(backward ? (right_turn ? c.both_refused_nn : c.both_refused_np)
                                     : (right_turn ? c.both_refused_pn : c.both_refused_pp));
  effect(call);
  Cycle cost = backward ? (right_turn ? c.both_nn : c.both_np) : (right_turn ? c.both_pn : c.both_pp);
  cost += set_speed(call, Wheel::Left, static_cast<std::int16_t>(linear - angular), call.at + cost / 2);
  cost += set_speed(call, Wheel::Right, static_cast<std::int16_t>(linear + angular), call.at + cost);
  return HostResult::done(cost);
}

HostResult HostLibrary::e_init_motors(const Call& call) {
  effect(call);
  Cycle cost = cycles_.init_motors;
  for (Wheel wheel : {Wheel::Left, Wheel::Right})
    cost += activate(call, key_of(run_of(wheel)), 0, call.at + cost);
  board_.pins().follow_motors(call.at + cost);
  changed(call);
  return HostResult::done(cost);
}

// --- steps

HostResult HostLibrary::get_steps(const Call& call, Wheel wheel, Cycle cost) {
  call.cpu.note_look(agendas().motors().steps_horizon(wheel, call.at));
  call.give(
      static_cast<int>(agendas().motors().commanded_steps(wheel, call.at) - zero_steps_[index_of(wheel)]));
  return HostResult::done(cost);
}

HostResult HostLibrary::set_steps(const Call& call, Wheel wheel, Cycle cost) {
  effect(call);
  zero_steps_[index_of(wheel)] = agendas().motors().commanded_steps(wheel, call.at) - call.number(0);
  return HostResult::done(cost);
}

HostResult HostLibrary::e_get_steps_left(const Call& call) {
  return get_steps(call, Wheel::Left, cycles_.get_left);
}
HostResult HostLibrary::e_get_steps_right(const Call& call) {
  return get_steps(call, Wheel::Right, cycles_.get_right);
}
HostResult HostLibrary::e_set_steps_left(const Call& call) {
  return set_steps(call, Wheel::Left, cycles_.set_left);
}
HostResult HostLibrary::e_set_steps_right(const Call& call) {
  return set_steps(call, Wheel::Right, cycles_.set_right);
}

// --- one firing, called as a function

/// Setting the half's cycle, beside what the firing takes when no agenda runs and its own is the newest.
Cycle HostLibrary::cost_of_half(Wheel wheel) const {
  const CallCycles& c = cycles_;
  const Function own = key_of(run_of(wheel)), running = agendas().list().running(agendas().ticks());
  if (running == own) return c.run_half_own;
  return (running ? c.run_half_other : 0) + cost_of_set_cycle(own) - c.set_cycle_found;
}

HostResult HostLibrary::run_motor(const Call& call, Wheel wheel) {
  effect(call);
  const CallCycles& c = cycles_;
  const bool left = wheel == Wheel::Left;
  const int speed = agendas().motors().speed(wheel);
  const auto choose = [&](Cycle left_forward, Cycle left_backward, Cycle right_forward,
                          Cycle right_backward) {
    if (left) return speed > 0 ? left_forward : left_backward;
    return speed < 0 ? right_backward : right_forward;
  };
  Cycle cost = 0;
  if (agendas().motors().switches_off(wheel, call.at))
    cost = choose(c.run_left_forward_off, c.run_left_backward_off, c.run_right_forward_off,
                  c.run_right_backward_off) +
           cost_of_half(wheel);
  else if (speed > -drivers::kPowerSaveBelow && speed < drivers::kPowerSaveBelow)
    cost = choose(c.run_left_forward_half, c.run_left_backward_half, c.run_right_forward_half,
                  c.run_right_backward_half) +
           cost_of_half(wheel);
  else
    cost = choose(c.run_left_forward_step, c.run_left_backward_step, c.run_right_forward_step,
                  c.run_right_backward_step);
  const bool fine = agendas().run_motor(wheel, call.at);
  board_.pins().follow_motor(wheel, call.at);
  changed(call);
  if (!fine) {
    call.cpu.trap(dspic::Trap::MathError);
    return HostResult::done(c.run_divides);
  }
  return HostResult::done(cost);
}

HostResult HostLibrary::run_left_motor(const Call& call) { return run_motor(call, Wheel::Left); }
HostResult HostLibrary::run_right_motor(const Call& call) { return run_motor(call, Wheel::Right); }

}  // namespace api
