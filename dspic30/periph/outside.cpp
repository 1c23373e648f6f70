// SPDX-License-Identifier: MIT
#include "dspic30/periph/outside.h"

namespace dspic {

bool UartFrame::level(Cycle at) const {
  if (at < start || at >= end()) return true;
  if (broken) return false;
  const auto index = static_cast<int>((at - start) / bit);
  if (index == 0) return false;
  if (index <= data_bits) return (word >> (index - 1) & 1) != 0;
  if (index == data_bits + 1 && parity != Parity::None) {
    bool ones = false;
    for (int i = 0; i < data_bits; ++i) ones ^= (word >> i & 1) != 0;
    return parity == Parity::Even ? ones : !ones;
  }
  return true;
}

namespace {

// a port that moves for ever on other pins must not be followed for ever
constexpr int kMostChanges = 1 << 20;

// calls `each(at)` at every edge after `after` until it returns false, or nothing more is known
template <class Each>
void walk(Outside& outside, Pin pin, Edge edge, Cycle after, Each each) {
  const auto level = [&](Cycle at) { return (outside.pin_levels(pin.port, at).levels >> pin.bit & 1) != 0; };
  bool before = level(after);
  Cycle at = after;
  for (int changes = 0; changes < kMostChanges; ++changes) {
    const Cycle next = outside.levels_horizon(pin.port, static_cast<std::uint16_t>(1 << pin.bit), at);
    if (next >= kNever || next <= at) return;
    at = next;
    const bool now = level(at);
    if (now != before && now == (edge == Edge::Rising) && !each(at)) return;
    before = now;
  }
}

}  // namespace

std::int64_t Outside::edges(Pin pin, Edge edge, Cycle after, Cycle until) {
  std::int64_t count = 0;
  walk(*this, pin, edge, after, [&](Cycle at) {
    if (at <= until) ++count;
    return at < until;
  });
  return count;
}

Cycle Outside::nth_edge(Pin pin, Edge edge, Cycle after, std::int64_t n) {
  Cycle found = kNever;
  walk(*this, pin, edge, after, [&](Cycle at) {
    if (--n == 0) found = at;
    return n > 0;
  });
  return found;
}

}  // namespace dspic
