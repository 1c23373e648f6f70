// SPDX-License-Identifier: MIT
#include "hal_sim/board/codec.h"

#include "hal_sim/board/sound_bank.h"
#include "sim_core/base/hash.h"

namespace board {

void Codec::put_out(const Play& play) {
  while (plays_.size() > 1 && plays_.back().from >= play.from) plays_.pop_back();
  plays_.push_back(play);
  news_ = true;
}

void Codec::power(bool on, Cycle at) {
  if (on == powered_) return;
  powered_ = on;
  line_.power(on);
  if (!on && configured_ && sounds()) put_out({at, at, 0, 0});
  configured_ = configured_ && on;
}

void Codec::start_frames(Cycle at) {
  frames_since_ = at;
  used_ = true;
  first_use.note();
}

void Codec::reset(Cycle at) {
  if (sounds()) put_out({at, at, 0, 0});
  powered_ = configured_ = false;
  line_.power(false);
  frames_since_ = -1;
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
      h, static_cast<std::uint64_t>(frames_since_) << 2 | (configured_ ? 2u : 0u) | (powered_ ? 1u : 0u));
}

}  // namespace board
