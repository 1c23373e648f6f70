// SPDX-License-Identifier: MIT
// The infrared remote control's receiver on RF6 (INT0): what an RC5 transmitter that somebody presses does to
// the pin. Idle high; low while the 36 kHz carrier is received.
//
//   1 1 T A4..A0 C5..C0    a bit is 1.778 ms; 1 = silence then carrier, 0 = carrier then silence
//   ^ first falling edge in the middle of the first bit; the frame again every 113.8 ms while the key is held
//
// The level is a closed form of world time, so nothing is ticked and nothing costs until somebody looks.
// Modelled: toggle bit (changes with each press), address, repetition, several keys at once (their carriers
// overlay each other). Not modelled: the receiver's delay and jitter (some tens of microseconds), range and
// direction, light that disturbs it. Source: [RC5], [lib: motor_led/e_epuck_ports.h].
#pragma once
#include <cstdint>
#include <vector>

#include "hal_sim/board/clock.h"

namespace board {

/// Somebody holds a key of a remote control.
struct KeyPress {
  int key = 0;        ///< 0 to 63
  double at_s = 0;    ///< s, world time of the press: the first frame begins
  double hold_s = 0;  ///< s, 0 or more; a frame that has begun is finished
  int address = 0;    ///< 0 to 31: the kind of device; 0 is a television
};

class RemoteReceiver {
 public:
  explicit RemoteReceiver(const RobotClock& clock) : clock_(clock) {}

  /// Adds a press. The toggle bit differs from that of the press added before.
  void press(const KeyPress& key);
  /// Nobody has pressed a key yet: the world begins again.
  void forget() { presses_.clear(); }

  /// Level of the pin.
  bool level(Cycle at) const { return level_at(clock_.click_at(at)); }
  /// First cycle after `at` at which the level changes; kNever if it does not.
  Cycle horizon(Cycle at) const;
  /// First cycle after `at` at which the level falls (or rises); kNever if it does not.
  Cycle next_edge(Cycle at, bool falling) const;

 private:
  struct Press {
    sim::Clicks start;
    std::int64_t frames;
    unsigned bits;  // 14, the first to be sent uppermost
  };
  static bool carrier(const Press& press, std::int64_t half);
  static std::int64_t half_at(const Press& press, sim::Clicks at);
  static sim::Clicks horizon(const Press& press, sim::Clicks at);
  bool level_at(sim::Clicks at) const;

  const RobotClock& clock_;
  std::vector<Press> presses_;
};

}  // namespace board
