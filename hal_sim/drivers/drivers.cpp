// SPDX-License-Identifier: MIT
#include "hal_sim/drivers/drivers.h"

#include <algorithm>
#include <cstdlib>

#include "hal_sim/board/board.h"

namespace drivers {

Drivers::Drivers(board::Board& board)
    : pins_(board.pins()),
      agendas_(board.motors().own(Wheel::Left), board.motors().own(Wheel::Right)),
      scan_(board.inputs()) {
  pins_.attach(this);
}

Drivers::~Drivers() { pins_.attach(nullptr); }

std::optional<double> Drivers::coil_duty(Wheel wheel) const {
  if (!agendas_.motors().runs(wheel)) return std::nullopt;
  const int magnitude = std::abs(agendas_.motors().speed(wheel));
  if (magnitude >= kPowerSaveBelow) return 1;
  const int period = magnitude > 0 ? kSpeedUnit / magnitude : 0;
  return period > 0 ? std::min(1.0, static_cast<double>(kPowerSaveTicks) / period) : 0;
}

double Drivers::mean_pulses() const {
  if (!scan_.clock().is_on || scan_.clock().run.micro_only) return 0;
  return static_cast<double>(kScanLitInterrupts) / kScanPeriod;
}

std::optional<int> Drivers::proximity_counts(int sensor, Cycle at) const {
  if (scan_.clock().is_on && !scan_.clock().run.micro_only)
    return scan_.peek_dark(sensor, at) - scan_.peek_lit(sensor, at);
  return std::nullopt;
}

void Drivers::processor_reset(Cycle at) {
  agendas_.reset(at);
  scan_.reset(at);
}

std::uint64_t Drivers::state_sum(Cycle at) const {
  return agendas_.state_sum(at) +
         static_cast<std::uint64_t>(scan_.clock().interrupts(at)) * 0x9E3779B97F4A7C15u;
}

}  // namespace drivers
