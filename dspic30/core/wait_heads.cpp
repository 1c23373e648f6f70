// SPDX-License-Identifier: MIT
#include "dspic30/core/wait_heads.h"

namespace dspic {

void WaitHeads::add(const Decoded* d) {
  if (find(d)) return;
  const std::ptrdiff_t place = d - code_;
  Head* free = &slot(place);
  for (std::ptrdiff_t i = kTried; i-- > 0;)
    if (slot(place + i).place < 0) free = &slot(place + i);
  *free = {0, static_cast<std::int32_t>(place), kFirstPause, 0};
  has_any_ = true;
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
