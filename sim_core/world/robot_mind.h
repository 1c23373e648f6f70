// SPDX-License-Identifier: MIT
// Seam A seen from the world: whatever drives a robot. hal_sim implements it with a board and a
// firmware; tests implement it with three lines. The world hands over a frozen scene and a span of time;
// it gets wheel angles back.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/base/hot_memory.h"

namespace sim {

class Scene;
class SoundField;

/// Angle each wheel has turned since the world began, rad, forward positive, not wrapped.
struct WheelAngles {
  double left_rad = 0;
  double right_rad = 0;
};

/// How both wheels turn for a while: the angles at `from`, and how fast they grow until `until`.
struct WheelCourse {
  WheelAngles angle;
  double left_rate = 0, right_rate = 0;  ///< rad per click
  Clicks from = 0, until = 0;            ///< from == until: known at that instant only

  WheelAngles at(Clicks instant) const {
    const double turned = static_cast<double>(instant - from);
    return {angle.left_rad + left_rate * turned, angle.right_rad + right_rate * turned};
  }
};

/// What recorders and pictures show of a robot's inside.
struct MindReport {
  std::int64_t left_steps = 0;   ///< motor full steps since power-up, forward positive, not wrapped
  std::int64_t right_steps = 0;  ///< same, right wheel
  std::uint32_t leds = 0;        ///< bits 0 to 7 the ring, 8 body, 9 front
};

class RobotMind {
 public:
  virtual ~RobotMind() = default;

  /// Runs the robot's inside up to `end` (clicks). May read the scene (frozen at the last tick) and nothing
  /// else that changes; may be called on any thread, never on two at once for one robot. Must not block.
  virtual void run_until(const Scene& scene, Clicks end) = 0;

  /// The course that holds at `at`, and until when it does unless run_until() is called; at is the last end.
  virtual WheelCourse wheel_course(Clicks at) = 0;

  /// Steps and LEDs at the last end.
  virtual MindReport report() const = 0;

  /// Proximity reading of sensor `index` as the robot would get it now (counts), for
  /// recorders; no side effects.
  virtual int proximity_counts(const Scene& scene, int index) = 0;

  /// True when the robot's loudspeaker began or ended something since the last publish_sound().
  virtual bool has_sound_news() const { return false; }
  /// Tells the field so, at the tick boundary `now`. Called one robot after the other, in their order.
  virtual void publish_sound(SoundField& /*field*/, int /*robot*/, Clicks /*now*/) {}

  /// Everything of the inside that must repeat from run to run, folded into one number, for
  /// the world's digest.
  virtual std::uint64_t state_hash() const = 0;

  /// What run_until() looks at each time, for whoever knows ahead whose turn is next.
  const HotMemory& hot_memory() const { return hot_memory_; }

  /// Keeps idle_until in a slot of the simulation's, which looks at a thousand of them and touches no mind.
  void keep_idle_in(Clicks* slot) {
    *slot = *idle_until_;
    idle_until_ = slot;
  }

 protected:
  RobotMind() = default;
  RobotMind(const RobotMind&) = delete;
  RobotMind& operator=(const RobotMind&) = delete;
  /// Before that instant nothing happens inside that anybody outside could see: courses hold, LEDs, sound,
  /// messages and state_hash() stay, and run_until() need not be called. Written at the end of run_until();
  /// 0 when something from outside reaches the robot.
  void set_idle_until(Clicks at) { *idle_until_ = at; }
  HotMemory& own_hot_memory() { return hot_memory_; }

 private:
  HotMemory hot_memory_;
  Clicks never_idle_ = 0;
  Clicks* idle_until_ = &never_idle_;
};

/// One mind per robot, in the order of the world.
using Minds = std::vector<std::unique_ptr<RobotMind>>;

}  // namespace sim
