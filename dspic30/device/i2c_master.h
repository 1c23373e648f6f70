// SPDX-License-Identifier: MIT
// Another master of the chip's I2C bus, to which the chip is a slave. Each step is complete in `now`; the
// program has run up to there. A master whose byte is over goes on only when holds_clock() has become false,
// which takes as long as the program takes.
#pragma once
#include <cstdint>

#include "dspic30/memory/cycle.h"

namespace dspic {

struct ChipParts;

class I2cMaster {
 public:
  explicit I2cMaster(ChipParts& parts) : parts_(parts) {}

  void start(Cycle now);  ///< or a repeated one
  /// A byte of the master's with its ninth bit. True: acknowledged.
  bool write(std::uint8_t byte, Cycle now);
  /// Eight bits of the slave's, then the master's ninth; 0xFF is the released line.
  std::uint8_t read(Cycle now);
  void acknowledge(bool acknowledged, Cycle now);
  void stop(Cycle now);
  bool holds_clock() const;

 private:
  ChipParts& parts_;
};

}  // namespace dspic
