// SPDX-License-Identifier: MIT
#include "hal_sim/drivers/agenda_shares.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

namespace drivers {

namespace {
constexpr std::uint64_t kAllTicks = std::uint64_t{1} << 32;
constexpr AgendaCosts kNoCosts;
}  // namespace

AgendaShares::AgendaShares(const AgendaTicks& ticks, const AgendaList& list, const AgendaMotors& motors)
    : ticks_(ticks), list_(list), motors_(motors), costs_(&kNoCosts) {}

/// Ticks that call a function, of all, as a fraction of 2^32. Several agendas that fire at the same tick make
/// it one: the sum of all is too many by those that two share, which is too few by those that three share ...
std::uint64_t AgendaShares::calling_ticks_q32() const {
  constexpr std::size_t kMost = 8;  // beyond that they are taken to meet the others as often as any tick does
  struct Rhythm {
    std::int64_t first, period;
    /// Do all its ticks belong to the other as well?
    bool is_in(const Rhythm& o) const { return period % o.period == 0 && (first - o.first) % o.period == 0; }
  };
  std::vector<Rhythm> rhythms;
  // When each agenda fires first, and how often.
  for (const AgendaList::Node& node : list_.nodes()) {
    const AgendaCount& count = motors_.count_of(node);
    if (!motors_.needs_handler(node) || !count.counts()) continue;
    const bool runs = ticks_.is_calling() && node.serial == ticks_.walked();  // its counter will be 0
    const Rhythm own{count.tick + (runs ? count.cycle : count.ticks_to_fire()), count.cycle};
    if (std::any_of(rhythms.begin(), rhythms.end(), [&](const Rhythm& r) { return own.is_in(r); })) continue;
    rhythms.erase(
        std::remove_if(rhythms.begin(), rhythms.end(), [&](const Rhythm& r) { return r.is_in(own); }),
        rhythms.end());
    rhythms.push_back(own);
  }
  const std::size_t joined = std::min(rhythms.size(), kMost);
  std::int64_t calling = 0;
  constexpr std::int64_t kNeverMeet = 1 << 20;  // a minute and more
  // For each choice of agendas: the ticks at which all of them fire, found by joining them one by one.
  for (unsigned chosen = 1; chosen < 1u << joined; ++chosen) {
    Rhythm all{0, 0};
    for (std::size_t i = 0; i < joined && all.period < kNeverMeet; ++i) {
      if (!(chosen >> i & 1)) continue;
      Rhythm one = rhythms[i];
      if (all.period == 0) {
        all = one;
        continue;
      }
      if (one.period > all.period) std::swap(one, all);
      const std::int64_t common = std::gcd(all.period, one.period),
                         together = all.period / common * one.period;
      const bool meet = together < kNeverMeet && (one.first - all.first) % common == 0;
      if (meet)
        while ((all.first - one.first) % one.period != 0) all.first += all.period;
      all.period = meet ? together : kNeverMeet;
    }
    if (all.period >= kNeverMeet) continue;
    // counted in and out by turns (inclusion and exclusion)
    const std::int64_t part = static_cast<std::int64_t>(kAllTicks) / all.period;
    calling += __builtin_popcount(chosen) % 2 ? part : -part;
  }
  for (std::size_t i = joined; i < rhythms.size(); ++i)
    calling += (static_cast<std::int64_t>(kAllTicks) - calling) / rhythms[i].period;
  return static_cast<std::uint64_t>(
      std::clamp<std::int64_t>(calling, 0, static_cast<std::int64_t>(kAllTicks)));
}

void AgendaShares::count_firings(board::Wheel wheel, Cycle at) {
  const auto i = static_cast<std::size_t>(wheel);
  const AgendaMotor& m = motors_.of(wheel);
  counted_from_[i] = ticks_.is_running() && !ticks_.is_held() ? at : kNever;
  commanded_[i] = m.commanded;
  phase_on_[i] = m.phase_on;
}

void AgendaShares::settle_firings(board::Wheel wheel, Cycle at) {
  const auto i = static_cast<std::size_t>(wheel);
  constexpr Cycle kLongest = 1 << 24;  // a second; what was not even at its begin is nothing by then
  const Cycle from = counted_from_[i], took = at - from;
  if (from == kNever || took > kLongest || !ticks_.is_running() || ticks_.is_held()) return;
  if (known_ != kAll) find();
  const AgendaMotor& m = motors_.of(wheel);
  // one way with one speed; in power save a step and its end come by turns
  const std::int64_t steps = std::abs(m.commanded - commanded_[i]), offs = steps + phase_on_[i] - m.phase_on;
  const Cycle due =
      m.saves_power() ? steps * costs_->motor_half + offs * costs_->motor_off : steps * costs_->motor_step;
  owed_q32_ += static_cast<std::int64_t>(due) * static_cast<std::int64_t>(kAllTicks) -
               took * static_cast<std::int64_t>(motor_share_q32_[i]);
}

void AgendaShares::find() const {
  const auto share = [](Cycle cycles, std::int64_t ticks) {
    return (static_cast<std::uint64_t>(cycles) << 32) / static_cast<std::uint64_t>(ticks * kAgendaTickCycles);
  };
  if (!(known_ & kTicks)) {
    tick_cycles_ = list_.size() == 0 ? costs_->empty : costs_->list;
    for (const AgendaList::Node& node : list_.nodes()) tick_cycles_ += cost_of(node);
    tick_share_q32_ = share(tick_cycles_, 1);
    calling_share_q32_ = tick_share_q32_ * (calling_ticks_q32() >> 8) / (kAllTicks >> 8);
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (const AgendaMotor& m = motors_.of(static_cast<board::Wheel>(i)); !(known_ >> i & 1))
      motor_share_q32_[i] =
          m.count.counts() && m.speed() != 0
              ? share(m.saves_power() ? costs_->motor_half + costs_->motor_off : costs_->motor_step,
                      m.full_period())
              : 0;
  known_ = kAll;
}

}  // namespace drivers
