// SPDX-License-Identifier: MIT
// I2C module as the bus's master: I2CCON, I2CSTAT, I2CTRN, I2CRCV, I2CBRG, I2CADD.
//
//   SEN RSEN PEN RCEN ACKEN or I2CTRN --> one operation at a time, some SCL periods --> the bit clears,
//   MI2CIF
//
// Modelled: all master operations with their times, ACKSTAT, TRSTAT, TBF, RBF, I2COV, IWCOL, S, P, clock
// stretching as the outside reports it, pins taken from the ports. Kept without effect: slave mode (I2CADD,
// STREN, GCEN, A10M, IPMIEN, SCLREL), DISSLW, SMEN, I2CSIDL. Not modelled: collisions (BCL), other masters.
// An operation reaches the outside when it is complete. S and P stay when the module is switched off: drivers
// that start only while P is set, and reset the module after a failure, work on the robot [lib: I2C/].
// Source: [chip P6]; [?] lengths of start, restart, stop and the fixed part of the SCL period.
#pragma once
#include <cstdint>

#include "dspic30/periph/ports.h"

namespace dspic {

class I2c final : public SfrOwner, public EventOwner {
 public:
  explicit I2c(const Fabric& fabric) : f_(fabric) {}
  void attach();
  void reset(Cycle now);

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;

 private:
  enum class Operation { None, Start, Restart, Stop, Receive, Acknowledge, Transmit };

  static constexpr std::uint16_t kOn = sfr_bits("I2CCON", "I2CEN");
  bool on() const { return (con_ & kOn) != 0; }
  Cycle scl() const;  // one SCL period
  void begin(Operation operation, Cycle half_periods, Cycle now);
  void finish(Cycle at);
  void request(std::uint16_t bits, Cycle now);
  void refuse(const char* what, Cycle now);

  Fabric f_;
  int slot_ = -1;
  std::uint16_t con_ = 0, stat_ = 0, brg_ = 0, add_ = 0;
  std::uint8_t rcv_ = 0, trn_ = 0xFF;
  Operation operation_ = Operation::None;
  Cycle end_ = 0;
  bool answered_ = false;  // the outside has said its part and stretched the clock
  bool acknowledged_ = false;
  std::uint8_t byte_ = 0;
};

}  // namespace dspic
