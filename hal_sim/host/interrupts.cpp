// SPDX-License-Identifier: MIT
#include "hal_sim/host/interrupts.h"

#include <algorithm>

#include "hal_sim/host/pins.h"

namespace host {

void InterruptController::reset() {
  sources_.fill({});
  next_int0_edge_ = nullptr;
  used_ = 0;
  touch();
}

void InterruptController::watch_int0(std::function<Cycle(Cycle)> next_edge, Cycle now) {
  next_int0_edge_ = std::move(next_edge);
  refresh_int0(now);
}

void InterruptController::refresh_int0(Cycle now) {
  if (!next_int0_edge_) return;
  source(TP_V_INT0).due = next_int0_edge_(now);
  touch();
}

void InterruptController::raise_due(Cycle now) {
  next_due();  // refreshes the caches
  if (now < next_raise_) return;
  for (std::uint64_t left = used_; left != 0; left &= left - 1) {
    InterruptSource& s = sources_[static_cast<std::size_t>(__builtin_ctzll(left))];
    if (s.due > now) continue;
    if (!s.flag) s.flag_since = s.due;
    s.flag = true;
    if (s.period > 0)
      s.due += ((now - s.due) / s.period + 1) * s.period;
    else
      s.due = kNever;
  }
  if (next_int0_edge_ && source(TP_V_INT0).due == kNever) source(TP_V_INT0).due = next_int0_edge_(now);
  touch();
}

Cycle InterruptController::next_due() {
  if (next_due_ != kUnknown) return next_due_;
  next_due_ = kNever;
  next_raise_ = kNever;
  ready_ = 0;
  for (std::uint64_t left = used_; left != 0; left &= left - 1) {
    const int v = __builtin_ctzll(left);
    const InterruptSource& s = sources_[static_cast<std::size_t>(v)];
    next_raise_ = std::min(next_raise_, s.due);
    if (!s.enabled || s.priority == 0) continue;
    next_due_ = std::min(next_due_, s.due);
    if (s.flag) ready_ |= std::uint64_t{1} << v;
  }
  return next_due_;
}

namespace {
bool can_be_served(const InterruptSource& s, int cpu_priority, bool held_by_disi) {
  return s.priority > cpu_priority && !(held_by_disi && s.priority < 7);
}
}  // namespace

int InterruptController::select(int cpu_priority, bool held_by_disi) {
  next_due();  // refreshes ready_
  int best = -1;
  for (std::uint64_t left = ready_; left != 0; left &= left - 1) {
    const int v = __builtin_ctzll(left);
    if (!can_be_served(sources_[static_cast<std::size_t>(v)], cpu_priority, held_by_disi)) continue;
    if (best < 0 || source(v).priority > source(best).priority) best = v;
  }
  return best;
}

int InterruptController::longest_waiting(int cpu_priority, bool held_by_disi) {
  next_due();
  int oldest = -1;
  for (std::uint64_t left = ready_; left != 0; left &= left - 1) {
    const int v = __builtin_ctzll(left);
    if (can_be_served(sources_[static_cast<std::size_t>(v)], cpu_priority, held_by_disi)) continue;
    if (oldest < 0 || source(v).flag_since < source(oldest).flag_since) oldest = v;
  }
  return oldest;
}

}  // namespace host
