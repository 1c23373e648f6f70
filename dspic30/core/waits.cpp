// SPDX-License-Identifier: MIT
// Waits jumped over: a program that goes round without changing anything.
//
//   round 1: registers and flags are as they were, and nothing was stored, or else
//   round 2: they are as they were, and so is RAM  ->  all rounds to come are like it, until what it reads
//   from peripherals may change
//
// The second chance is for a wait that an interrupt came into, too: RETFIE leaves the handler's DC behind.
// A round that writes a register, reads a FIFO, loads a write latch or leads to a trap is no wait. So the
// course is the same to the cycle as if every round had been run.
#include <algorithm>
#include <array>
#include <cstring>

#include "dspic30/core/cpu.h"

namespace dspic {

namespace {

constexpr int kLongestRound = 40;  // instructions

/// All that a round may change and that is neither RAM nor a peripheral's, in words that compare quickly.
struct CoreState {
  explicit CoreState(const Cpu& c) {
    std::memcpy(words.data(), c.w.data(), sizeof c.w);
    std::memcpy(&words[4], c.shadow.w.data(), sizeof c.shadow.w);
    const std::uint64_t z = c.z == 0, carry = c.c & 1, ov = c.ov & 0x8000, dc = c.dc & 0x100;
    words[5] = std::uint64_t{c.n} << 48 | std::uint64_t{c.rcount} << 32 | ov << 16 | dc << 16 | z << 16 |
               carry << 17 | c.shadow.flags;
    words[6] = static_cast<std::uint64_t>(c.acc[0]);
    words[7] = static_cast<std::uint64_t>(c.acc[1]);
    words[8] = static_cast<std::uint64_t>(c.loop_depth) << 32 | c.loop.count;
    words[9] = static_cast<std::uint64_t>(c.oa | c.ob << 1 | c.sa << 2 | c.sb << 3 | c.repeating << 4 |
                                          c.end_loop << 5);
  }
  bool operator==(const CoreState& o) const {
    // one by one: what has just been stored in halves would be waited for if it were loaded as a whole
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] != o.words[i]) return false;
    return true;
  }
  std::array<std::uint64_t, 10> words;
};

}  // namespace

Cycle Cpu::skip_wait() {
  const Cycle end = deadline;
  const Decoded* const first = next;
  const CoreState before(*this);
  watching = true;
  watched_until = kNever;
  bool stores = false, is_still = false;
  looks_outside = false;
  const Cycle began = now;
  Cycle start = now, skipped = 0;
  // one round; false: it is none, or no wait
  const auto goes_round = [&] {
    start = now;
    for (int i = 0; i < kLongestRound && now < deadline; ++i) {
      at = next;
      stores |= at->stores;
      const Decoded* following = plain(at)(*this, at);
      now += at->cycles;
      if (at == loop_end) following = loop_back(at, following);
      next = following;
      if (deadline != end || watched_until <= now) return false;
      if (next == first) return true;
    }
    return false;
  };
  const auto is_wait = [&] {
    if (!goes_round()) return false;
    const CoreState after(*this);
    if (!stores) return before == after || (goes_round() && !stores && after == CoreState(*this));
    const auto memory = ram;
    return goes_round() && after == CoreState(*this) && memory == ram;
  };
  if (is_wait()) {
    const Cycle round = now - start, rounds = (std::min(end, watched_until) - now) / round;
    skipped = std::max<Cycle>(rounds, 0) * round;
    now += skipped;
    is_still = watched_until == kNever && !looks_outside;
  }
  watching = false;
  still_since = is_still ? std::min(still_since, began) : kNever;
  return skipped;
}

}  // namespace dspic
