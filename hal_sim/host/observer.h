// SPDX-License-Identifier: MIT
// What a robot's processor tells somebody who writes down its course (hal_sim/trace). Called on the thread
// that runs the robot, never for two cycles in the wrong order; a call changes nothing that the robot could
// notice. A robot that nobody observes pays a comparison with null at each of these places.
#pragma once
#include <cstdint>

#include "hal_sim/board/cycle.h"

namespace host {

using board::Cycle;
using board::kNever;

/// Vectors are interrupts in natural order; the core's traps are kTrapVector
/// + 0 oscillator fail, 1 address, 2 stack, 3 math error.
inline constexpr int kTrapVector = 1000;

class Observer {
 public:
  virtual ~Observer() = default;

  /// The program's time has come to `at`. What it changed before is in place, what it changes at `at` is not:
  /// whatever the board evaluates in closed form can still be asked for any cycle since the last call.
  virtual void reached(Cycle at) = 0;
  /// The chip changes by itself in cycle `at`, which may lie before the program's time: what changed before
  /// is in place. Told in order of time.
  virtual void about_to_change(Cycle /*at*/) {}
  /// The processor leaves what it did at `entry` for the handler of `vector`, whose flag rose at `flagged`
  /// (-1 unknown) and whose first instruction comes at `first`.
  virtual void handler_begins(int vector, Cycle flagged, Cycle entry, Cycle first) = 0;
  virtual void handler_ends(Cycle at) = 0;
  /// An agenda's function (address relative to the image's load address) is called at `at`; 0: the last one
  /// has returned and none follows in this interrupt.
  virtual void callback(std::uintptr_t function, Cycle at) = 0;
  /// The program waited, so time jumped from `from` to `to`; `depth` handlers were open.
  virtual void waited(Cycle from, Cycle to, int depth) = 0;
  /// A reset, or the end of the program: nothing of the handlers goes on.
  virtual void ended(Cycle at) = 0;

  /// Running code is interrupted at the latest after so many cycles, to be looked at. No change of course.
  Cycle look_every = kNever;
  /// It asks for registers: about_to_change() comes before the program reads one, too.
  bool sees_registers = false;
};

}  // namespace host
