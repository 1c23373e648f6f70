// SPDX-License-Identifier: MIT
#include "hal_sim/host/mind.h"

#include <algorithm>

#include "hal_sim/host/oscillator.h"

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
  robot_ = std::make_unique<Robot>(std::move(settings), std::move(image), copy, board_);
  robot_->to_world_s = [this](Cycle at) { return sim::to_seconds(board_.clock().click_at(at)); };
}

Cycle FirmwareMind::cycle_at(sim::Clicks at) const { return std::max<Cycle>(0, board_.clock().cycle_at(at)); }

void FirmwareMind::run_until(const sim::Scene& scene, sim::Clicks end) {
  catch_faults_on_this_thread();
  board_.look_at(&scene);
  board_.exchange(now_);
  // bytes are on their way: whoever waits for them looks again
  if (robot_ && (board_.uart(1).next_arrival(now_) < kNever || board_.uart(2).next_arrival(now_) < kNever))
    robot_->wake();
  if (robot_) robot_->begin_window(now_);
  now_ = cycle_at(end);
  if (robot_) robot_->run_until(now_);
}

void FirmwareMind::press_key(const board::KeyPress& key) {
  board_.remote().press(key);
  if (robot_) robot_->remote_changed();
}

sim::WheelCourse FirmwareMind::wheel_course(sim::Clicks at) {
  const Cycle cycle = cycle_at(at);
  return {
      {board_.wheel_angle_rad(board::Wheel::Left, cycle), board_.wheel_angle_rad(board::Wheel::Right, cycle)},
      0,
      0,
      at,
      at};
}

sim::MindReport FirmwareMind::report() const {
  return {board_.left_steps(now_), board_.right_steps(now_), board_.leds(now_)};
}

int FirmwareMind::proximity_counts(const sim::Scene& scene, int index) {
  board_.look_at(&scene);
  return board_.proximity_counts(index, now_);
}

std::uint64_t FirmwareMind::state_hash() const {
  const std::uint64_t h = board_.state_hash(now_);
  return robot_ ? h ^ (robot_->hash() * 0xD6E8FEB86659FD93u) : h;
}

}  // namespace host
