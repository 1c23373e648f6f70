// SPDX-License-Identifier: MIT
// The course of a program as a whole: which handlers had the processor when, and when it only waited. Told to
// whoever writes it down, without a look at each instruction; nobody pays for it where nobody listens, and
// nothing that is told changes anything. Times are true ones.
#pragma once
#include "dspic30/memory/cycle.h"

namespace dspic {

class CourseWatch {
 public:
  virtual ~CourseWatch() = default;
  /// The processor leaves what it did at `entry` for the handler of `vector` (vectors.h), whose first
  /// instruction comes at `first`. A handler known by heart is one like all others.
  virtual void handler_begins(int vector, Cycle entry, Cycle first) = 0;
  /// The innermost handler has returned: what it left goes on at `at`.
  virtual void handler_ends(Cycle at) = 0;
  /// From `from` to `to` the program, or the handler that is under way, only waited: in Idle and Sleep, in a
  /// wait or a delay loop (waits.h), in repeated NOPs, in a function of the host. Told when it is over, or in
  /// pieces; what the first rounds of a loop took may have been told before.
  virtual void waited(Cycle from, Cycle to) = 0;
};

}  // namespace dspic
