// SPDX-License-Identifier: MIT
#include "hal_sim/host/mind.h"

#include <algorithm>
#include <cstring>

#include "sim_core/world/scene.h"

namespace host {

namespace {

/// A word of one of the library's arrays, of an image that has it.
std::optional<int> word_of(const Runner& program, const char* array, int index) {
  const auto at = 2 * static_cast<std::size_t>(index);
  const std::vector<char> words = program.data().read_variable(array, at + 2);
  if (words.empty()) return {};
  std::int16_t word = 0;
  std::memcpy(&word, words.data() + at, sizeof word);
  return word;
}

/// What the scan of the image's own library has filed of a sensor, dark less lit; nothing: it has not yet.
std::optional<int> filed_proximity(const Runner& program, int sensor) {
  const auto dark = word_of(program, "e_ambient_ir", sensor),
             lit = word_of(program, "e_ambient_and_reflected_ir", sensor);
  if (!dark || !lit || (*dark == 0 && *lit == 0)) return {};
  return *dark - *lit;
}

}  // namespace

FirmwareMind::FirmwareMind(const board::Setup& setup, const RunnerFactory& make_runner) : board_(setup) {
  if (!make_runner) {
    board_.power().switch_off();
    return;
  }
  power_up(make_runner);
}

void FirmwareMind::flash(const RunnerFactory& make_runner) {
  board_.processor_reset(now());  // motors stop where they are
  runner_.reset();
  power_up(make_runner);
  course_.until = 0;
  turns_ = 0;
  wake();
}

void FirmwareMind::begin_again(sim::Clicks at) {
  now_ = cycle_at(at);
  board_.begin_again(at, now_);
  if (runner_) runner_->begin_again();
  course_.until = 0;
  turns_ = 0;
  wake();
}

void FirmwareMind::power_up(const RunnerFactory& make_runner) {
  runner_ = make_runner(board_);
  // of the board its first half
  own_hot_memory().clear();
  own_hot_memory().add(this, sizeof *this - sizeof board_ / 2);
  runner_->add_hot(own_hot_memory());
  runner_->to_world_s = [this](Cycle at) { return sim::to_seconds(board_.clock().click_at(at)); };
}

Cycle FirmwareMind::cycle_at(sim::Clicks at) const { return std::max<Cycle>(0, board_.clock().cycle_at(at)); }

Cycle FirmwareMind::now() const {
  return board_.scene() ? std::max(now_, cycle_at(board_.scene()->now())) : now_;
}

void FirmwareMind::run_until(const sim::Scene& scene, sim::Clicks end) {
  board_.look_at(&scene);
  const Cycle start = now();
  tell_asked(start);
  if (start >= board_horizon_) board_.exchange(start);
  const Cycle until = cycle_at(end);
  if (runner_) {
    runner_->begin_window(start);
    runner_->run_until(until);
  }
  now_ = until;  // who looks while a debugger holds the program up looks at the window's begin, not ahead
  if (runner_) tell_asked(now_);
  if (runner_ && runner_->turns() != turns_) {
    turns_ = runner_->turns();
    if (!runner_->hashes_events()) hash_ = board_.state_hash(now_) ^ runner_->hash() * 0xD6E8FEB86659FD93u;
  }
  set_idle_until(find_idle_until());
}

sim::Clicks FirmwareMind::find_idle_until() {
  board_horizon_ = board_.horizon(now_);
  const Cycle until = std::min(board_horizon_, runner_ ? runner_->idle_until() : kNever);
  return until >= kNever ? kNever : until <= now_ ? 0 : board_.clock().click_at(until);
}

void FirmwareMind::press_key(const board::KeyPress& key) {
  board_.remote().press(key);
  if (runner_) runner_->remote_changed();
  wake();
}

sim::WheelCourse FirmwareMind::wheel_course(sim::Clicks at) {
  const std::uint64_t commands = board_.motors().commands();
  if (at >= course_.until || commands != commands_) {
    course_ = course_at(at);
    commands_ = commands;
  }
  return course_;
}

sim::WheelCourse FirmwareMind::course_at(sim::Clicks at) const {
  const board::RobotClock& clock = board_.clock();
  const Cycle cycle = cycle_at(at);
  tell_asked(cycle);
  const board::WheelTurn left = board_.motors().turn(board::Wheel::Left, cycle),
                         right = board_.motors().turn(board::Wheel::Right, cycle);
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
  tell_asked(at);
  return {board_.motors().left_steps(at), board_.motors().right_steps(at), board_.pins().leds(at)};
}

int FirmwareMind::proximity_counts(const sim::Scene& scene, int index) {
  board_.look_at(&scene);
  return proximity_reading(index);
}

int FirmwareMind::proximity_reading(int sensor) const {
  const Runner* const program = caught_up();
  if (const auto scanned = board_.scanned_proximity(sensor, now())) return *scanned;
  if (const auto filed = program ? filed_proximity(*program, sensor) : std::nullopt) return *filed;
  return board_.proximity_counts(sensor, now());
}

}  // namespace host
