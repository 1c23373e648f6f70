// SPDX-License-Identifier: MIT
#include "hal_sim/host/mind.h"

#include <algorithm>

#include "hal_sim/host/oscillator.h"
#include "sim_core/world/scene.h"

namespace host {

namespace {
/// The robot as the program's configuration words make it: its clock's rate is theirs.
board::Setup configured(board::Setup setup, Image* image, std::size_t copy) {
  const void* fosc = image ? image->copy(copy).description().fosc : nullptr;
  const double factor = fosc ? clock_factor(*static_cast<const std::uint16_t*>(fosc)) : 1;
  if (factor != 1) setup.clock_ppm = ((1 + setup.clock_ppm * 1e-6) * factor - 1) * 1e6;
  return setup;
}
}  // namespace

FirmwareMind::FirmwareMind(const board::Setup& setup, RobotSettings settings, std::shared_ptr<Image> image,
                           std::size_t copy)
    : board_(configured(setup, image.get(), copy)) {
  if (!image) {
    board_.switch_off();
    return;
  }
  power_up(std::move(settings), std::move(image), copy);
}

void FirmwareMind::flash(RobotSettings settings, std::shared_ptr<Image> image, std::size_t copy) {
  settings.start = now();
  board_.processor_reset(settings.start);  // motors stop where they are
  robot_.reset();
  power_up(std::move(settings), std::move(image), copy);
  course_.until = 0;
  turns_ = 0;
  set_idle_until(0);
}

void FirmwareMind::power_up(RobotSettings settings, std::shared_ptr<Image> image, std::size_t copy) {
  robot_ = std::make_unique<Robot>(std::move(settings), std::move(image), copy, board_);
  robot_->to_world_s = [this](Cycle at) { return sim::to_seconds(board_.clock().click_at(at)); };
}

Cycle FirmwareMind::cycle_at(sim::Clicks at) const { return std::max<Cycle>(0, board_.clock().cycle_at(at)); }

Cycle FirmwareMind::now() const {
  return board_.scene() ? std::max(now_, cycle_at(board_.scene()->now())) : now_;
}

void FirmwareMind::run_until(const sim::Scene& scene, sim::Clicks end) {
  catch_faults_on_this_thread();
  board_.look_at(&scene);
  const Cycle start = now();
  board_.exchange(start);
  now_ = cycle_at(end);
  if (!robot_) return set_idle_until(idle_until());
  robot_->pass_to(start);
  // bytes are on their way: whoever waits for them looks again
  if (board_.uart(1).next_arrival(start) < kNever || board_.uart(2).next_arrival(start) < kNever)
    robot_->wake();
  robot_->begin_window(start);
  robot_->run_until(now_);
  if (robot_->turns() != turns_) {
    turns_ = robot_->turns();
    course_.until = 0;
    hash_ = board_.state_hash(now_) ^ robot_->hash() * 0xD6E8FEB86659FD93u;
  }
  set_idle_until(idle_until());
}

sim::Clicks FirmwareMind::idle_until() const {
  const Cycle quiet = board_.quiet_until(now_), idle = robot_ ? robot_->idle_until() : kNever;
  const Cycle until = std::min(quiet, idle);
  return until >= kNever ? kNever : until <= now_ ? 0 : board_.clock().click_at(until);
}

void FirmwareMind::press_key(const board::KeyPress& key) {
  board_.remote().press(key);
  if (robot_) robot_->remote_changed();
  set_idle_until(0);
}

sim::WheelCourse FirmwareMind::wheel_course(sim::Clicks at) {
  if (at >= course_.until) course_ = course_at(at);
  return course_;
}

sim::WheelCourse FirmwareMind::course_at(sim::Clicks at) const {
  const board::RobotClock& clock = board_.clock();
  const Cycle cycle = cycle_at(at);
  const board::WheelTurn left = board_.wheel_turn(board::Wheel::Left, cycle),
                         right = board_.wheel_turn(board::Wheel::Right, cycle);
  const Cycle until = std::min(left.until, right.until);
  const double cycles_per_click = 1 + static_cast<double>(clock.ppb()) * 1e-9;
  return {{left.angle_rad, right.angle_rad},
          left.rate_rad * cycles_per_click,
          right.rate_rad * cycles_per_click,
          at,
          until >= kNever ? kNever : std::max(at, clock.click_at(until))};
}

sim::MindReport FirmwareMind::report() const {
  const Cycle at = now();
  return {board_.left_steps(at), board_.right_steps(at), board_.leds(at)};
}

int FirmwareMind::proximity_counts(const sim::Scene& scene, int index) {
  board_.look_at(&scene);
  return board_.proximity_counts(index, now());
}

}  // namespace host
