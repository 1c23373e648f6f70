// SPDX-License-Identifier: MIT
// What is done to a board by hand (damage.h).
#include <cmath>

#include "hal_sim/board/accelerometer.h"
#include "hal_sim/board/board.h"

namespace board {

Damage& Board::be_damaged() {
  if (!damage_) damage_ = std::make_unique<Damage>(setup_.seed, setup_.robot);
  return *damage_;
}

void Board::steps_changed(Wheel wheel, Cycle at) {
  StepLoss& loss = be_damaged().steps[static_cast<std::size_t>(wheel)];
  stepper(wheel, at).lose_steps(loss.is_active() ? &loss : nullptr);
}

void Board::stick_accelerometer(bool is, Cycle at) {
  Damage& d = be_damaged();
  if (is && d.acc_stuck.now() == 0) {
    const Unseen unseen(*this);
    for (int axis = 0; axis < 3; ++axis)
      d.acc_counts[static_cast<std::size_t>(axis)] = accelerometer_counts(*this, axis, at);
    d.acc_since = at;
  }
  d.acc_stuck.set(is ? 1 : 0, at);
}

void Board::damage_changed(Cycle at) {
  ++be_damaged().pins_changed;
  follow_power(at);
}

bool Board::can_be_held(char port, int bit) {
  const int index = port_index(port);
  if (index < 0 || bit < 0 || bit > 15) return false;
  const auto may = static_cast<std::uint16_t>(index == kA   ? mask(kA, kRingLedPins)
                                              : index == kC ? mask(kC, kFrontLedPin, kBodyLedPin)
                                              : index == kF ? mask(kF, kBatteryGoodPin, kRemotePin)
                                              : index == kG ? mask(kG, kSelectorPins)
                                                            : 0);
  return (may >> bit & 1) != 0;
}

void Board::hold_pin(char port, int bit, std::optional<bool> level, Cycle at) {
  Damage& d = be_damaged();
  const auto p = static_cast<std::size_t>(port_index(port));
  const auto bits = static_cast<std::uint16_t>(1u << bit);
  d.held_pins[p] = static_cast<std::uint16_t>(level ? d.held_pins[p] | bits : d.held_pins[p] & ~bits);
  d.held_levels[p] =
      static_cast<std::uint16_t>(level && *level ? d.held_levels[p] | bits : d.held_levels[p] & ~bits);
  damage_changed(at);
}

void Board::set_clock_ppm(double ppm, sim::Clicks at) {
  clock_.set_ppb(static_cast<std::int64_t>(std::llround(ppm * 1000.0)), at);
}

}  // namespace board
