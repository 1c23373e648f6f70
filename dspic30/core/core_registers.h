// SPDX-License-Identifier: MIT
// The core's own registers, 0x000 to 0x052, as they are read and written by their addresses.
#pragma once
#include <cstdint>

#include "dspic30/memory/sfr_bus.h"

namespace dspic {

class Cpu;

class CoreRegisters final : public SfrOwner {
 public:
  explicit CoreRegisters(Cpu& cpu) : cpu_(cpu) {}
  std::uint16_t read(unsigned address, Cycle at) override { return peek(address, at); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle at) override;
  std::uint16_t peek(unsigned address, Cycle at) const override;
  Cycle horizon(unsigned address, Cycle at) const override;

 private:
  Cpu& cpu_;
};

}  // namespace dspic
