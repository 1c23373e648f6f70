// SPDX-License-Identifier: MIT
// Waits jumped over: a program that goes round without changing anything.
//
//   round 1, or else round 2: the core ends as it began, and what was read of RAM is as it was when it was
//   read  ->  all rounds to come are like it, until what it reads from peripherals may change
//
// The second chance is for a wait that an interrupt came into: RETFIE leaves the handler's DC behind. What
// reads no peripheral is remembered (known_waits.h) and need not be run again. A round that writes a
// register, reads a FIFO, loads a write latch or leads to a trap is no wait. So the course is the same to the
// cycle as if every round had been run.
#include <algorithm>

#include "dspic30/core/cpu.h"

namespace dspic {

namespace {

constexpr int kLongestRound = 40;  // instructions

}  // namespace

Cycle Cpu::skip_wait() {
  watched_until = kNever;
  looks_outside = reads_core = false;
  const Cycle began = now;
  const KnownWaits::Wait* wait = known_waits.find(*this);
  KnownWaits::Wait found;
  if (!wait && find_wait(found)) wait = &found;
  still_since = wait && watched_until == kNever && !looks_outside ? std::min(still_since, began) : kNever;
  still_reads = wait && (wait->memory.reads() || reads_core);
  if (!wait) return 0;
  const Cycle rounds = std::max<Cycle>(std::min(deadline, watched_until) - now, 0) / wait->took;
  if (rounds > 0) wait->memory.put_written(ram.data());
  now += rounds * wait->took;
  return rounds * wait->took;
}

// runs a round or two
bool Cpu::find_wait(KnownWaits::Wait& wait) {
  const Cycle end = deadline;
  // false: it is none, or no wait
  const auto goes_round = [&] {
    for (int i = 0; i < kLongestRound && now < deadline; ++i) {
      const Decoded* const d = at = next;  // a REPEAT moves `at` on
      const Decoded* following = plain(d)(*this, d);
      now += d->cycles;
      if (d == loop_end) following = loop_back(d, following);
      next = following;
      if (deadline != end || watched_until <= now) return false;
      if (next == wait.first) return true;
    }
    return false;
  };
  for (int chances = 2; chances > 0; --chances) {
    const Cycle start = now;
    wait.first = next;
    wait.state = CoreState(*this);
    wait.memory.clear();
    round_memory = &wait.memory;
    watching = true;
    const bool is_round = goes_round();
    watching = false;
    round_memory = nullptr;
    if (!is_round || !wait.memory.is_whole()) return false;
    wait.took = now - start;
    if (wait.state.is_of(*this) && wait.memory.are_as_read(ram.data())) {
      wait.memory.take_written(ram.data());
      if (watched_until == kNever && !looks_outside && !reads_core) known_waits.add(*this, wait);
      return true;
    }
    if (const KnownWaits::Wait* known = known_waits.find(*this)) {
      wait = *known;
      return true;
    }
  }
  return false;
}

}  // namespace dspic
