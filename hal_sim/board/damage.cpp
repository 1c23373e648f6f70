// SPDX-License-Identifier: MIT
#include "hal_sim/board/damage.h"

#include <algorithm>

#include "hal_sim/board/damage_params.h"
#include "sim_core/random/counter_random.h"

namespace board {

Damage::Damage(std::uint64_t seed, int robot)
    : steps{StepLoss(sim::random_bits({seed, static_cast<std::uint32_t>(robot), kStreamStepLossLeft}, 0)),
            StepLoss(sim::random_bits({seed, static_cast<std::uint32_t>(robot), kStreamStepLossRight}, 0))} {}

void StepLoss::lose(double share) {
  share = std::clamp(share, 0.0, 1.0);
  // each fall loses kStepsOfAFall, of which the chance is asked for the first only
  const double begins = share / (kStepsOfAFall - (kStepsOfAFall - 1) * share);
  begins_q32_ = static_cast<std::uint64_t>(begins * 0x1p32);
}

bool StepLoss::takes(Cycle at) {
  if (is_blocked_) {
    blocked.note(at);
    ++count;
    return true;
  }
  if (left_ == 0) {
    if ((sim::mix64(key_ ^ tried_++) >> 32) >= begins_q32_) return false;
    left_ = kStepsOfAFall;
  }
  --left_;
  lost.note(at);
  ++count;
  return true;
}

}  // namespace board
