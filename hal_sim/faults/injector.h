// SPDX-License-Identifier: MIT
// Does faults and stimuli to a running twin, each at its tick, and keeps book of whether anybody felt them.
//
//   faults -> [ not begun -> begun -> ended ] -> board (damage.h), world -> what the program and world get
//                                                       \-> took effect at: when that first differed
//
// Whoever steps the twin calls look() between ticks, or advance() in place of the simulation's: it steps
// no further than to the next tick at which something is due. A time begins at the first tick at or after
// it; a condition is looked at every tick, and begins at the tick at which it is first seen to hold. Of
// several that are due at one tick those that end come first, then those that begin, in the order in which
// they were added. Faults of one kind on one thing add up: shares and films multiply, voltages and
// irradiances are sums.
//
// When the world begins again (Simulation::begin_again(), with Twin::begin_again() for its robots), so do its
// faults: those that were added wait again, counted from then, and those of begin() are gone. One that took
// effect before needs not do so again.
//
// Equal worlds, programs, seeds and faults give equal courses, with any number of threads. A twin without
// faults runs as without an injector. One thread: the one that steps.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/faults/fault.h"
#include "hal_sim/twin/twin.h"

namespace faults {

/// What became of a fault; of one on several robots, the earliest of them. Times in s of the world;
/// negative: not (yet).
struct Status {
  int id = 0;
  Fault fault;
  double begun_s = -1, took_effect_s = -1, ended_s = -1;
  bool is_active() const { return begun_s >= 0 && ended_s < 0; }
};

class Injector {
 public:
  /// `twin` outlives it.
  explicit Injector(twin::Twin& twin);
  ~Injector();
  Injector(const Injector&) = delete;
  Injector& operator=(const Injector&) = delete;

  /// Adds a fault for later, or for now: `at_s` may have passed. Returns its id, from 0 on. Throws
  /// std::runtime_error, "sensor: got 9, expected 0 to 7", behind its `where`, when it is none; nothing was done then.
  int add(Fault fault);
  /// All of them, in order, or none: a line then for each that is none.
  std::vector<int> add(std::vector<Fault> faults);
  /// The same, and it begins at once, whatever it says of its time.
  int begin(Fault fault);
  /// It ends now, if it lasts and goes on. One that has not begun never will.
  void end(int id);

  /// What is due now happens. Twice at one tick is once.
  void look();
  /// The next instant at which look() has something to do: at the latest the simulation should stop there;
  /// sim::kEver when there is none.
  sim::Clicks next() const;
  /// look(), then as Simulation::advance(at) but no further than to next(), then look().
  void advance(sim::Clicks at);

  bool is_empty() const;
  Status status(int id) const;
  std::vector<Status> statuses() const;
  /// At the end of a run: a line for each fault that never began, or never took effect.
  std::vector<std::string> problems() const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// "sensor_blocked sensor=0 of e-puck", for messages and lists.
std::string said(const Fault& fault);

}  // namespace faults
