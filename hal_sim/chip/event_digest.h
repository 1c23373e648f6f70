// SPDX-License-Identifier: MIT
// What a robot on its chip has done, as one number: each event mixed with its cycle, and all added up. So
// neither how time was cut into windows, nor in which order models of the chip were asked what they had done
// meanwhile, makes another.
#pragma once
#include <cstdint>

#include "dspic30/memory/cycle.h"
#include "sim_core/base/hash.h"

namespace chip {

class EventDigest {
 public:
  enum class Kind : std::uint8_t { Pins, UartFrame, I2c, CodecWord, Trap, Reset, Written };
  void note(Kind kind, std::uint64_t what, dspic::Cycle at) {
    sum_ += sim::mix64(sim::mix64(static_cast<std::uint64_t>(at)) ^ what ^
                       static_cast<std::uint64_t>(kind) << 56);
  }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace chip
