// SPDX-License-Identifier: MIT
// What drives an e-puck in the world: its board and whatever executes its firmware. Joins the world's clock
// to the robot's own.
#pragma once
#include <memory>

#include "hal_sim/board/board.h"
#include "hal_sim/host/runner.h"
#include "sim_core/world/robot_mind.h"

namespace host {

class FirmwareMind final : public sim::RobotMind {
 public:
  /// `make_runner` empty: a robot that is switched off.
  FirmwareMind(const board::Setup& setup, const RunnerFactory& make_runner);

  void run_until(const sim::Scene& scene, sim::Clicks end) override;
  sim::WheelCourse wheel_course(sim::Clicks at) override;
  sim::MindReport report() const override;
  int proximity_counts(const sim::Scene& scene, int index) override;
  /// What e_get_prox() would give: of the program's newest scan, dark less lit (counts). Without one, what a scan
  /// would find now, without noise.
  int proximity_reading(int sensor) const;
  std::uint64_t state_hash() const override {
    return runner_ && runner_->hashes_events() ? runner_->hash() : hash_;
  }
  bool has_sound_news() const override { return board_.has_sound_news(); }
  void publish_sound(sim::SoundField& field, int, sim::Clicks now) override {
    board_.publish_sound(field, now);
  }

  /// Another program is flashed and started where the robot stands; as the constructor's
  /// otherwise. Between ticks.
  void flash(const RunnerFactory& make_runner);

  /// The robot is, from world time `now` on, as when the world began (Board::begin_again()). Between ticks,
  /// behind a restart.
  void begin_again(sim::Clicks now);

  /// Somebody presses a key of a remote control; not before what has already run.
  void press_key(const board::KeyPress& key);

  /// Something outside has changed: the robot looks at what is new in the next tick.
  void wake() {
    board_horizon_ = 0;
    set_idle_until(0);
  }
  /// The same, and its wheels may turn otherwise from now on.
  void disturb() {
    course_.until = 0;
    turns_ = 0;
    wake();
  }
  /// For changing, too.
  board::Board& board() {
    wake();
    if (is_observed()) tell_asked(now());
    return board_;
  }
  const board::Board& board() const {
    if (is_observed()) tell_asked(now());
    return board_;
  }
  /// Null when no firmware is loaded.
  Runner* runner() {
    wake();
    return caught_up();
  }
  const Runner* runner() const { return caught_up(); }
  /// Last cycle that has begun, never below 0.
  Cycle cycle_at(sim::Clicks at) const;
  /// Cycle up to which the robot has run, or has been idle.
  Cycle now() const;

 private:
  bool is_observed() const { return runner_ && runner_->is_observed(); }
  void tell_asked(Cycle at) const {
    if (runner_) runner_->tell_asked(at);
  }
  Runner* caught_up() const {
    if (is_observed()) tell_asked(now());
    if (runner_) runner_->pass_to(now());
    return runner_.get();
  }
  void power_up(const RunnerFactory& make_runner);
  sim::Clicks find_idle_until();
  sim::WheelCourse course_at(sim::Clicks at) const;

  // what every run looks at lies together, and the board's own head follows
  Cycle now_ = 0;  // the last end of run_until()
  Cycle board_horizon_ = 0;
  std::uint64_t hash_ = 0, turns_ = 0;  // of the robot, when they were made
  sim::WheelCourse course_;
  std::uint64_t commands_ = 0;  // of its motors, when it was made
  board::Board board_;
  std::unique_ptr<Runner> runner_;  // uses the board to its end
};

}  // namespace host
