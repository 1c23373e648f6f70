// SPDX-License-Identifier: MIT
// What somebody does to a serial line between the processor and whatever is at its other end: bytes are lost,
// bits are turned over, a wire is cut.
//
// Modelled: whole bytes that do not come, one turned bit in a byte, each by a share and by random numbers of
// the line's own, counted byte by byte; a cut wire idles. Not modelled: a start bit that is taken late (bytes
// that a loose wire makes of others), framing errors.
#pragma once
#include <cstdint>

#include "hal_sim/board/damage.h"

namespace board {

/// One direction of a line.
class WireDamage {
 public:
  /// `key`: of the wire's own random numbers.
  explicit WireDamage(std::uint64_t key) : key_(key) {}
  Timed lost, garbled;  ///< shares of the bytes, 0 to 1
  Timed cut;            ///< 1: it is
  Noticed lost_one, garbled_one, cut_one;
  /// A byte whose stop bit ends at `end` comes to the other end changed, or (false) not at all.
  bool carry(std::uint8_t& byte, Cycle end);

 private:
  std::uint64_t key_;
  std::uint64_t bytes_ = 0;
};

struct LineDamage {
  /// Of a robot's seed; UART 1 or 2.
  LineDamage(std::uint64_t seed, int robot, int uart);
  WireDamage to_robot, from_robot;
};

}  // namespace board
