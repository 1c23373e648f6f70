// SPDX-License-Identifier: MIT
// The processor's I2C module as the library's driver uses it, as master: one operation at a time, over after
// its bits, then an interrupt.
//
//   begin(operation) --- bits x (BRG + 14) cycles ---> settle(): the bus and its devices see it
//
// An operation reaches the devices at the cycle at which its last bit is over, however late somebody asks.
// Modelled: on and off, one operation at a time, the S and P bits, the received byte. Not modelled: slave
// mode, collisions, IWCOL, clock stretching; a byte sent without a start is clocked out and nobody hears it.
// Source: [DS70143 17], facts restated.
#pragma once
#include <cstdint>

#include "hal_sim/board/i2c_bus.h"
#include "hal_sim/drivers/driver_params.h"

namespace drivers {

class I2cMaster {
 public:
  enum class Operation { Start, Restart, Stop, Acknowledge, Refuse, Read, Write };

  explicit I2cMaster(board::I2cBus& bus) : bus_(bus) {}

  /// I2CEN with a baud rate register of 0 to 511. Whatever was under way is forgotten, the lines go high.
  void switch_on(int brg, Cycle at);
  void switch_off(Cycle at);
  bool is_on() const { return on_; }

  /// Starts an operation; `byte` counts for Write alone. Answers the cycle at which it is over and the
  /// interrupt comes, or -1 when the module is off or busy: nothing happens then.
  Cycle begin(Operation operation, std::uint8_t byte, Cycle at);
  /// Carries out what is over by `at`.
  void settle(Cycle at);
  /// Cycle at which the operation under way is over; at or before the present: idle.
  Cycle busy_until() const { return over_at_; }

  /// I2CRCV: the byte received last.
  std::uint8_t received() const { return received_; }
  /// ACKSTAT turned round: the last byte sent was acknowledged.
  bool is_acknowledged() const { return acknowledged_; }
  /// I2CSTAT.S and .P: a start or a stop was the last condition on the bus. Both false while the module is
  /// off.
  bool is_started() const { return on_ && started_; }
  bool is_stopped() const { return on_ && !started_; }

  void processor_reset(Cycle at);
  std::uint64_t state_hash() const;

 private:
  board::I2cBus& bus_;
  bool on_ = false;
  Cycle bit_cycles_ = 0;
  bool pending_ = false;
  Operation operation_ = Operation::Stop;
  std::uint8_t byte_ = 0;
  Cycle over_at_ = 0;
  bool started_ = false;
  bool acknowledged_ = false;
  std::uint8_t received_ = 0;
};

}  // namespace drivers
