// SPDX-License-Identifier: MIT
// The program's clock and the true one. What handlers known by heart take is no lump at an instant but a
// share of each cycle: the true clock is ahead of the program's by so much.
//
//   true = settled + x + floor((x * stolen + rest) / 2^32),   x: cycles of the program since settled
//
// The rest is carried on, so settling now and later is the same as settling later: nothing depends on when. Where
// more was taken than handlers took, it is negative, and nothing is taken until that is even; what was taken too
// little is taken twice as fast. Neither clock ever jumps.
#pragma once
#include <algorithm>
#include <cstdint>

#include "dspic30/memory/cycle.h"

namespace dspic {

class TwoClocks {
 public:
  /// The true time at which the program's clock shows `now`, which is not before the last settle().
  Cycle true_at(Cycle now) const { return stolen_q32_ == 0 ? now : now + stolen(now - settled_); }
  /// The first instant of the program's clock at which the true one has come to `at`.
  Cycle program_at(Cycle at) const {
    return stolen_q32_ == 0 || at <= settled_ || at >= kNever ? at : first_at(at - settled_);
  }
  /// From here on both show the true time.
  void settle(Cycle& now) {
    if (stolen_q32_ == 0) {
      settled_ = now;
      return;
    }
    const Cycle own = now - settled_, of_share = taken_by_share(own), of_extra = std::min(own, extra_),
                taken = of_share + of_extra;
    // what is left fits, and so the product may go round
    rest_ += static_cast<std::int64_t>(static_cast<std::uint64_t>(own) * stolen_q32_ -
                                       (static_cast<std::uint64_t>(of_share) << 32));
    extra_ -= of_extra;
    taken_ += taken;
    now += taken;
    settled_ = now;
  }
  /// So many cycles of 2^-32 were taken too little by now, behind settle(); negative: too much.
  void correct(std::int64_t cycles_q32) {
    rest_ += cycles_q32 + (extra_ << 32);
    extra_ = whole(rest_);
    rest_ -= extra_ << 32;
  }
  /// `share_q32`: of each true cycle, as a fraction of 2^32. Behind settle(). Handlers that take all leave
  /// the program an instruction now and then: it has a hundredth at least.
  void set_share(std::uint64_t share_q32) {
    constexpr std::uint64_t kMost = kOne / 100 * 99;
    share_q32 = share_q32 < kMost ? share_q32 : kMost;
    if (share_q32 != 0 && share_q32 != share_q32_) {  // it comes and goes, mostly the same one
      share_q32_ = share_q32;
      kept_q32_ = kOne - share_q32;
      stolen_of_share_q32_ =
          static_cast<std::uint64_t>((static_cast<unsigned __int128>(share_q32) << 32) / kept_q32_);
    }
    stolen_q32_ = share_q32 == 0 ? 0 : stolen_of_share_q32_;
  }
  void reset(Cycle now) {
    settled_ = now;
    stolen_q32_ = 0;
    rest_ = extra_ = 0;
  }
  /// Cycles of the program so far when its clock shows `now`: true ones without what was taken.
  Cycle own_cycles(Cycle now) const { return now - taken_; }

 private:
  using Wide = __int128;
  static constexpr std::uint64_t kOne = std::uint64_t{1} << 32;
  static Cycle whole(Wide sum) { return sum < 0 ? 0 : static_cast<Cycle>(sum >> 32); }
  Cycle taken_by_share(Cycle own) const {
    // as is nearly always, all fits into 64 bits: at most 99 times what the program has
    constexpr Cycle kSoon = 1 << 24;
    if (own >= kSoon) return whole(Wide{own} * stolen_q32_ + rest_);
    const std::int64_t sum = own * static_cast<std::int64_t>(stolen_q32_) + rest_;
    return sum < 0 ? 0 : sum >> 32;
  }
  Cycle stolen(Cycle own) const { return taken_by_share(own) + std::min(own, extra_); }
  /// The program's time from settled_ on.
  Cycle first_at(Cycle wanted) const {
    if (extra_ > 0) {
      if (wanted > extra_ + extra_ + whole(Wide{extra_} * stolen_q32_ + rest_))
        return settled_ + own_at(wanted - extra_, static_cast<std::uint64_t>(rest_));
      const Wide each = Wide{2 * kOne} + stolen_q32_, lacks = (Wide{wanted} << 32) - rest_;
      return settled_ + (lacks <= 0 ? 0 : static_cast<Cycle>((lacks + each - 1) / each));
    }
    if (rest_ >= 0) return settled_ + own_at(wanted, static_cast<std::uint64_t>(rest_));
    const auto owed = static_cast<std::uint64_t>(-rest_);
    const auto even =
        static_cast<Cycle>((owed + stolen_q32_ - 1) / stolen_q32_);  // nothing is taken until then
    if (wanted <= even) return settled_ + wanted;
    return settled_ + even + own_at(wanted - even, static_cast<std::uint64_t>(even) * stolen_q32_ - owed);
  }
  Cycle own_at(Cycle wanted, std::uint64_t rest) const {
    // as is nearly always, all fits into 64 bits: own * 2^32 + own * stolen + rest >= wanted * 2^32
    if (constexpr Cycle kSoon = 1 << 30; wanted < kSoon && stolen_q32_ < kOne) {
      const std::uint64_t each = kOne + stolen_q32_, limit = static_cast<std::uint64_t>(wanted) << 32;
      std::uint64_t x = static_cast<std::uint64_t>(wanted) * kept_q32_ >> 32, sum = x * each + rest;
      for (; sum < limit; sum += each) ++x;
      for (; x > 0 && sum - each >= limit; sum -= each) --x;
      return static_cast<Cycle>(x);
    }
    const auto true_after = [&](Cycle own) { return own + whole(Wide{own} * stolen_q32_ + rest); };
    auto own = static_cast<Cycle>(Wide{wanted} * kept_q32_ >> 32);
    while (true_after(own) < wanted) ++own;
    while (own > 0 && true_after(own - 1) >= wanted) --own;
    return own;
  }

  Cycle settled_ = 0, taken_ = 0;
  Cycle extra_ = 0;  // what was taken too little: of each cycle another one, until that is even
  std::uint64_t stolen_q32_ = 0;
  std::int64_t rest_ = 0;
  // the last share that was not 0, what it leaves of a true cycle, and what it takes beside one that is left
  std::uint64_t share_q32_ = 0, kept_q32_ = kOne, stolen_of_share_q32_ = 0;
};

}  // namespace dspic
