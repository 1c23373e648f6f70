// SPDX-License-Identifier: MIT
// What drives an e-puck in the world: its board and, in the native way, its firmware. Joins the world's clock
// to the robot's own.
#pragma once
#include <memory>

#include "hal_sim/board/board.h"
#include "hal_sim/host/robot.h"
#include "sim_core/world/robot_mind.h"

namespace host {

class FirmwareMind final : public sim::RobotMind {
 public:
  /// `image` null: a robot that is switched off. `copy`: which loaded copy of the image this robot lives in;
  /// robots of one copy never run at the same time.
  FirmwareMind(const board::Setup& setup, RobotSettings settings, std::shared_ptr<Image> image,
               std::size_t copy);

  void run_until(const sim::Scene& scene, sim::Clicks end) override;
  sim::WheelCourse wheel_course(sim::Clicks at) override;
  sim::MindReport report() const override;
  int proximity_counts(const sim::Scene& scene, int index) override;
  std::uint64_t state_hash() const override { return hash_; }
  bool has_sound_news() const override { return board_.codec().has_news(); }
  void publish_sound(sim::SoundField& field, int, sim::Clicks now) override {
    board_.publish_sound(field, now);
  }

  /// Another program is flashed and started where the robot stands; as the constructor's otherwise. Between
  /// ticks.
  void flash(RobotSettings settings, std::shared_ptr<Image> image, std::size_t copy);

  /// Somebody presses a key of a remote control; not before what has already run.
  void press_key(const board::KeyPress& key);

  /// For changing, too: the robot looks at what is new in the next tick.
  board::Board& board() {
    set_idle_until(0);
    return board_;
  }
  const board::Board& board() const { return board_; }
  /// Null when no firmware is loaded.
  Robot* robot() {
    set_idle_until(0);
    return caught_up();
  }
  const Robot* robot() const { return caught_up(); }
  /// Last cycle that has begun, never below 0.
  Cycle cycle_at(sim::Clicks at) const;
  /// Cycle up to which the robot has run, or has been idle.
  Cycle now() const;

 private:
  Robot* caught_up() const {
    if (robot_) robot_->pass_to(now());
    return robot_.get();
  }
  void power_up(RobotSettings settings, std::shared_ptr<Image> image, std::size_t copy);
  sim::Clicks idle_until() const;
  sim::WheelCourse course_at(sim::Clicks at) const;

  board::Board board_;
  std::unique_ptr<Robot> robot_;
  Cycle now_ = 0;  // the last end of run_until()
  sim::WheelCourse course_;
  std::uint64_t hash_ = 0, turns_ = 0;  // of the robot, when they were made
};

}  // namespace host
