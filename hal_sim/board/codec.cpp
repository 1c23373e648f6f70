// SPDX-License-Identifier: MIT
#include "hal_sim/board/codec.h"

#include <algorithm>

#include "hal_sim/board/sound_bank.h"
#include "sim_core/base/hash.h"

namespace board {

namespace {
constexpr std::int64_t kEndless = std::int64_t{1} << 40;  // samples
constexpr std::int64_t kCounterRange = 65536;             // the driver counts down in 16 bits

/// Samples until the driver's countdown by four meets zero.
std::int64_t samples_of(int length) {
  const std::int64_t counter = length & (kCounterRange - 1);
  if (counter % kCodecGroup != 0) return kEndless;
  return counter == 0 ? kCounterRange : counter;
}
}  // namespace

void Codec::begin(const Play& play) {
  while (plays_.size() > 1 && plays_.back().from >= play.from) plays_.pop_back();
  plays_.push_back(play);
  news_ = true;
}

void Codec::power(bool on, Cycle at) {
  if (on == powered_) return;
  powered_ = on;
  line_.power(on);
  if (!on && configured_ && plays_.back().count > 0) begin({at, at, 0, 0});
  configured_ = configured_ && on;
}

void Codec::start_dci(Cycle at) {
  dci_since_ = at;
  used_ = true;
}

void Codec::configure() { configured_ = powered_ && dci_runs(); }

Cycle Codec::next_group(Cycle at) const {
  if (!dci_runs()) return kNever;
  return dci_since_ + (std::max<Cycle>(0, at - dci_since_) / kCodecGroupCycles + 1) * kCodecGroupCycles;
}

void Codec::play(int offset, int length, Cycle at) {
  if (!configured_) return;
  const Cycle first_at = next_group(at);
  begin({first_at, first_at, std::int64_t{offset} + 1, samples_of(length)});
}

void Codec::stop(Cycle at) {
  if (plays_.back().count == 0) return;
  const Cycle from = next_group(at);
  begin({from, from, 0, 0});
}

void Codec::reset(Cycle at) {
  if (plays_.back().count > 0) begin({at, at, 0, 0});
  powered_ = configured_ = false;
  line_.power(false);
  dci_since_ = -1;
}

int Codec::output(Cycle at) const {
  if (line_.was_used()) return line_.output(at);
  const Play* now = &plays_.front();
  for (const Play& play : plays_)
    if (play.from <= at) now = &play;
  if (at < now->first_at) return 0;
  const std::int64_t n = (at - now->first_at) / kCodecSampleCycles;
  if (n >= now->count) return 0;
  const auto& bank = *sound_bank();
  const std::int64_t index = now->first + n;
  return index >= 0 && index < static_cast<std::int64_t>(bank.size()) ? bank[static_cast<std::size_t>(index)]
                                                                      : 0;
}

void Codec::forget(Cycle at) {
  line_.forget(at);
  std::size_t old = 0;
  while (old + 1 < plays_.size() && plays_[old + 1].from <= at) ++old;
  plays_.erase(plays_.begin(), plays_.begin() + static_cast<std::ptrdiff_t>(old));
}

const Codec::Play& Codec::take_news() {
  news_ = false;
  return plays_.back();
}

std::uint64_t Codec::state_hash() const {
  const Play& last = plays_.back();
  std::uint64_t h = sim::fold(1, static_cast<std::uint64_t>(last.first_at));
  h = sim::fold(h, static_cast<std::uint64_t>(last.first));
  h = sim::fold(h, static_cast<std::uint64_t>(last.count));
  if (line_.was_used()) h = sim::fold(h, line_.state_hash());
  return sim::fold(
      h, static_cast<std::uint64_t>(dci_since_) << 2 | (configured_ ? 2u : 0u) | (powered_ ? 1u : 0u));
}

}  // namespace board
