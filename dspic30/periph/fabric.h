// SPDX-License-Identifier: MIT
// What every peripheral is built with: the world beyond the pins, the agenda of instants,
// flags, pins, complaints.
#pragma once
#include "dspic30/memory/diagnosis.h"
#include "dspic30/memory/sfr_bus.h"
#include "dspic30/periph/events.h"
#include "dspic30/periph/interrupts.h"
#include "dspic30/periph/outside.h"

namespace dspic {

class Ports;

struct Fabric {
  Outside& outside;
  SfrBus& bus;
  Events& events;
  Interrupts& interrupts;
  Ports& ports;
  Diagnostics& diagnostics;
  double fcy_hz;  ///< instruction cycles a second
};

/// Bits outside `lanes` keep their old value.
inline std::uint16_t merge_lanes(std::uint16_t old, std::uint16_t value, std::uint16_t lanes) {
  return static_cast<std::uint16_t>((old & ~lanes) | (value & lanes));
}

}  // namespace dspic
