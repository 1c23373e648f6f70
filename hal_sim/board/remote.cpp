// SPDX-License-Identifier: MIT
// See remote.h.
#include "hal_sim/board/remote.h"

#include <algorithm>

#include "hal_sim/board/remote_params.h"

namespace board {

namespace {

constexpr sim::Clicks kNoClick = INT64_MAX / 4;

/// World time at which half bit `half` of a press begins: the first click that is not before it.
sim::Clicks begin_of(sim::Clicks start, std::int64_t half) {
  return start + (half * kRc5HalfBitNumerator + kRc5HalfBitDenominator - 1) / kRc5HalfBitDenominator;
}

}  // namespace

void RemoteReceiver::press(const KeyPress& key) {
  Press press;
  press.start = sim::from_seconds(key.at_s);
  const std::int64_t held = sim::from_seconds(std::max(0.0, key.hold_s));
  press.frames = 1 + held * kRc5HalfBitDenominator / (kRc5HalfBitNumerator * kRc5FrameHalves);
  const unsigned toggle = presses_.size() & 1;
  press.bits = 3u << 12 | toggle << 11 | (static_cast<unsigned>(key.address) & 31u) << 6 |
               (static_cast<unsigned>(key.key) & 63u);
  presses_.push_back(press);
}

std::int64_t RemoteReceiver::half_at(const Press& press, sim::Clicks at) {
  return (at - press.start) * kRc5HalfBitDenominator / kRc5HalfBitNumerator;
}

bool RemoteReceiver::carrier(const Press& press, std::int64_t half) {
  if (half < 0 || half / kRc5FrameHalves >= press.frames) return false;
  half %= kRc5FrameHalves;
  if (half >= 2 * kRc5Bits) return false;
  const bool one = (press.bits >> (kRc5Bits - 1 - half / 2) & 1) != 0;
  return one == ((half & 1) != 0);
}

bool RemoteReceiver::level_at(sim::Clicks at) const {
  for (const Press& press : presses_)
    if (at >= press.start && carrier(press, half_at(press, at))) return false;
  return true;
}

sim::Clicks RemoteReceiver::horizon(const Press& press, sim::Clicks at) {
  const std::int64_t end = press.frames * kRc5FrameHalves;
  std::int64_t half = at < press.start ? -1 : half_at(press, at);
  for (const bool before = carrier(press, half); half < end;)
    if (carrier(press, ++half) != before) return begin_of(press.start, half);
  return kNoClick;
}

Cycle RemoteReceiver::horizon(Cycle at) const {
  const sim::Clicks from = clock_.click_at(at);
  const bool before = level_at(from);
  for (sim::Clicks now = from;;) {
    sim::Clicks next = kNoClick;
    for (const Press& press : presses_) next = std::min(next, horizon(press, now));
    if (next >= kNoClick) return kNever;
    now = next;
    if (level_at(now) == before) continue;  // another key's carrier covers the change
    return clock_.cycle_at(now - 1) + 1;
  }
}

Cycle RemoteReceiver::next_edge(Cycle at, bool falling) const {
  Cycle change = horizon(at);
  if (change < kNever && level(change) == falling) change = horizon(change);
  return change;
}

}  // namespace board
