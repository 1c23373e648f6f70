// SPDX-License-Identifier: MIT
#include "dspic30/core/wait_heads.h"

#include <utility>

namespace dspic {

void WaitHeads::add(const Decoded* d) {
  if (find(d)) return;
  const std::ptrdiff_t place = d - code_;
  if (heads_.empty()) heads_.resize(kFewest);
  while (!free_slot(place) && heads_.size() < kMost) widen();
  some_ |= std::uint64_t{1} << (place & 63);
  put({0, static_cast<std::int32_t>(place), kFirstPause, 0});
}

/// The first that is free of those where the head at a place may be; null: none.
WaitHeads::Head* WaitHeads::free_slot(std::ptrdiff_t place) {
  for (std::ptrdiff_t i = 0; i < kTried; ++i)
    if (slot(place + i).place < 0) return &slot(place + i);
  return nullptr;
}

void WaitHeads::put(const Head& head) {
  Head* const free = free_slot(head.place);
  *(free ? free : &slot(head.place)) = head;
}

void WaitHeads::widen() {
  const std::vector<Head> before = std::exchange(heads_, std::vector<Head>(2 * heads_.size()));
  for (const Head& head : before)
    if (head.place >= 0) put(head);
}

void WaitHeads::pause(const Decoded* d, bool is_wait, Cycle now) {
  constexpr std::int32_t kMostPause = 1 << 23;  // half a second
  Head* const head = find(d);
  if (!head) return;
  if (is_wait) {
    head->pause = kFirstPause;
    return;
  }
  head->from = now + head->pause;
  head->pause = std::min(2 * head->pause, kMostPause);
}

}  // namespace dspic
