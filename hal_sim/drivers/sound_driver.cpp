// SPDX-License-Identifier: MIT
#include "hal_sim/drivers/sound_driver.h"

#include <algorithm>

#include "hal_sim/drivers/driver_params.h"

namespace drivers {

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

Cycle SoundDriver::next_group(Cycle at) const {
  const Cycle since = codec_.frames_since();
  if (since < 0) return board::kNever;
  return since + (std::max<Cycle>(0, at - since) / kCodecGroupCycles + 1) * kCodecGroupCycles;
}

void SoundDriver::play(int offset, int length, Cycle at) {
  if (!codec_.is_configured()) return;
  const Cycle first_at = next_group(at);
  codec_.put_out({first_at, first_at, std::int64_t{offset} + 1, samples_of(length)});
}

void SoundDriver::stop(Cycle at) {
  if (!codec_.sounds()) return;
  const Cycle from = next_group(at);
  codec_.put_out({from, from, 0, 0});
}

}  // namespace drivers
