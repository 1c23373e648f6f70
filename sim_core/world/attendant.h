// SPDX-License-Identifier: MIT
// Somebody who looks at the whole world between two ticks and may change it: a supervisor. Called alone, by
// the thread that steps the simulation, so the outcome does not depend on who runs the robots.
#pragma once

namespace sim {

class Attendant {
 public:
  virtual ~Attendant() = default;

  /// Before the first tick, once.
  virtual void before_first_tick() = 0;
  /// After every tick, when everything of it is done and in the digest.
  virtual void after_tick() = 0;
};

}  // namespace sim
