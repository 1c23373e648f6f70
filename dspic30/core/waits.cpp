// SPDX-License-Identifier: MIT
// Waits jumped over: a program that goes round without changing anything.
//
//   round 1: registers and flags are as they were, and nothing was stored, or else
//   round 2: and RAM is as it was  ->  all rounds to come are like it, until what it reads from
//   peripherals may change
//
// A round that writes a register, reads a FIFO, loads a write latch or leads to a trap is no wait. So the
// course is the same to the cycle as if every round had been run.
#include <algorithm>

#include "dspic30/core/cpu.h"

namespace dspic {

namespace {

constexpr int kLongestRound = 40;  // instructions

/// All that a round may change and that is neither RAM nor a peripheral's.
struct CoreState {
  explicit CoreState(const Cpu& c)
      : w(c.w),
        n(c.n),
        z(c.z),
        c(c.c & 1),
        ov(c.ov & 0x8000),
        dc(c.dc & 0x100),
        rcount(c.rcount),
        acc(c.acc),
        loop(c.loop.count << 4 | static_cast<unsigned>(c.loop_depth)),
        flags(static_cast<unsigned>(c.oa) | c.ob << 1 | c.sa << 2 | c.sb << 3 | c.repeating << 4 |
              c.end_loop << 5),
        shadow(c.shadow.w),
        shadow_flags(c.shadow.flags) {}
  bool operator==(const CoreState& o) const {
    return w == o.w && n == o.n && (z == 0) == (o.z == 0) && c == o.c && ov == o.ov && dc == o.dc &&
           rcount == o.rcount && acc == o.acc && loop == o.loop && flags == o.flags && shadow == o.shadow &&
           shadow_flags == o.shadow_flags;
  }
  std::array<std::uint16_t, 16> w;
  std::uint16_t n, z;
  unsigned c, ov, dc;
  std::uint16_t rcount;
  std::array<std::int64_t, 2> acc;
  unsigned loop, flags;
  std::array<std::uint16_t, 4> shadow;
  unsigned shadow_flags;
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
  // one round, at most so many instructions long; false: it is none, or no wait
  const auto goes_round = [&](int longest) {
    for (int i = 0; i < longest && now < deadline; ++i) {
      at = next;
      stores |= at->stores;
      const Decoded* following = plain(at)(*this, at);
      now += at->cycles;
      if (at == loop_end) following = loop_back(at, following);
      next = following;
      if (deadline != end || watched_until <= now) return false;
      if (next == first) return before == CoreState(*this);
    }
    return false;
  };
  Cycle skipped = 0;
  Cycle start = now;
  const auto is_wait = [&] {
    if (!goes_round(kLongestRound)) return false;
    if (!stores) return true;
    const auto memory = ram;
    start = now;
    return goes_round(kLongestRound) && memory == ram;
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
