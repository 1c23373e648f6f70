// SPDX-License-Identifier: MIT
// Waits jumped over: a program that goes round without changing anything.
//
//   round 1: registers and flags are as they were, and nothing was stored, or else
//   round 2: they are as they were, and so is RAM  ->  all rounds to come are like it, until what it reads
//   from peripherals may change. What reads none is remembered (known_waits.h) and need not be run again.
//
// The second chance is for a wait that an interrupt came into, too: RETFIE leaves the handler's DC behind.
// A round that writes a register, reads a FIFO, loads a write latch or leads to a trap is no wait. So the
// course is the same to the cycle as if every round had been run.
#include <algorithm>
#include <array>
#include <cstring>

#include "dspic30/core/cpu.h"

namespace dspic {

Cycle Cpu::skip_wait() {
  const Cycle end = deadline, began = now;
  const CoreState before(*this);
  KnownWaits::Course course;
  bool stores = false, is_known = false;
  Cycle round = known_waits.round(*this, before);
  watched_until = kNever;
  looks_outside = false;
  // one round, run; false: it is none, or no wait
  const auto goes_round = [&] {
    const Decoded* const first = next;
    const Cycle start = now;
    for (course.count = 0; course.count < KnownWaits::Course::kLongest && now < deadline;) {
      at = course.at[course.count++] = next;
      stores |= at->stores;
      const Decoded* following = plain(at)(*this, at);
      now += at->cycles;
      if (at == loop_end) following = loop_back(at, following);
      next = following;
      if (deadline != end || watched_until <= now) return false;
      round = now - start;
      if (next == first) return true;
    }
    return false;
  };
  const auto is_wait = [&] {
    if (!goes_round()) return false;
    const CoreState after(*this);
    if (!stores && before == after) return true;
    is_known = !stores && known_waits.round(*this, after) == round;
    if (is_known) return true;
    if (!stores) return goes_round() && !stores && after == CoreState(*this);
    const auto memory = ram;
    return goes_round() && after == CoreState(*this) && memory == ram;
  };
  bool is_still = round > 0;
  if (!is_still) {
    watching = true;
    const bool waits = is_wait();
    watching = false;
    is_still = waits && watched_until == kNever && !looks_outside;
    if (is_still && !stores && !is_known) known_waits.add(*this, course, round, CoreState(*this));
    if (!waits) round = 0;
  }
  still_since = is_still ? std::min(still_since, began) : kNever;
  const Cycle skipped =
      round > 0 ? std::max<Cycle>((std::min(end, watched_until) - now) / round, 0) * round : 0;
  now += skipped;
  return skipped;
}

}  // namespace dspic
