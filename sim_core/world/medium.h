// SPDX-License-Identifier: MIT
// Something that carries messages between robots: a radio channel, a short-range link. Robots put into it
// while they run, each its own part; the medium moves what was put between the ticks, alone, so that the
// outcome does not depend on who ran on which thread.
#pragma once
#include "sim_core/base/clock.h"

namespace sim {

class Scene;

class Medium {
 public:
  virtual ~Medium() = default;

  /// Tick boundary: every robot has run to `now`, the scene's last tick. Called serially, in order of time,
  /// at every tick in which a robot ran or that found the medium busy; what it hands over robots see from now
  /// on. Must not block.
  virtual void exchange(const Scene& scene, Clicks now) = 0;
  /// The world begins again: nothing is under way, and chance and plan are those of the beginning, from `now`
  /// on. Whose ends belong to no robot keeps what it sends.
  virtual void begin_again(Clicks /*now*/) {}
  /// True when something is under way.
  virtual bool is_busy() const = 0;
};

}  // namespace sim
