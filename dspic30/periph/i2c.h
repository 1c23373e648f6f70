// SPDX-License-Identifier: MIT
// I2C module, as the bus's master and as a slave: I2CCON, I2CSTAT, I2CTRN, I2CRCV, I2CBRG, I2CADD.
//
//   SEN RSEN PEN RCEN ACKEN or I2CTRN --> one operation, some SCL periods --> the bit clears, MI2CIF
//   another master's start, byte for I2CADD, bytes, stop --> I2CRCV or I2CTRN, SI2CIF; SCLREL = 0 holds SCL
//
// Modelled: all master operations with their times, ACKSTAT, TRSTAT, TBF, RBF, I2COV, IWCOL, S, P, clock
// stretching as the outside reports it, pins taken from the ports; as a slave 7-bit addresses, the general
// call, D_A, R_W, RBF, TBF, I2COV, SI2CIF after each byte, SCL held for transmission always and for reception
// with STREN. Kept without effect: A10M, IPMIEN, DISSLW, SMEN, I2CSIDL. Not modelled: collisions (BCL), a
// master that speaks while the chip does, the module addressing itself. An operation reaches the outside when
// it is complete. S and P stay when the module is switched off: drivers that start only while P is set, and
// reset the module after a failure, work on the robot [lib: I2C/]. Source: [chip P6], slave [DS70143 17.3 to
// 17.6]; [?] lengths of start, restart, stop and the fixed part of the SCL period; I2CADD = 0 answers nobody.
#pragma once
#include <cstdint>

#include "dspic30/periph/ports.h"

namespace dspic {

class I2c final : public SfrOwner, public EventOwner {
 public:
  explicit I2c(const Fabric& fabric);
  void attach();
  void reset(Cycle now);

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;

  /// What the master may do.
  enum class Operation { None, Start, Restart, Stop, Receive, Acknowledge, Transmit };
  /// Could one begin now?
  bool is_ready() const { return on() && operation_ == Operation::None && slave_ == Slave::Idle; }
  bool is_started() const { return (stat_ & kStarted) != 0; }
  /// From the write that begins it to its interrupt's flag, unless the clock is stretched.
  Cycle duration(Operation operation) const;

  // --- another master on the bus; each when it is complete there
  void hear_start(Cycle at);
  /// A byte of the master's, its ninth bit included; the first after a start is an address. Acknowledged?
  bool hear_byte(std::uint8_t byte, Cycle at);
  /// Eight bits that the master clocks out of the slave; 0xFF where it sends nothing.
  std::uint8_t say_byte();
  /// The master's ninth bit behind them.
  void hear_acknowledge(bool acknowledged, Cycle at);
  void hear_stop(Cycle at);
  /// Does the slave hold SCL? Then the master waits.
  bool holds_clock() const;

 private:
  static constexpr std::uint16_t kOn = sfr_bits("I2CCON", "I2CEN"), kStarted = sfr_bits("I2CSTAT", "S");
  bool on() const { return (con_ & kOn) != 0; }
  Cycle scl() const { return brg_ + 1 + fixed_; }  // one SCL period
  void begin(Operation operation, Cycle now);
  void finish(Cycle at);
  void request(std::uint16_t bits, Cycle now);
  void refuse(const char* what, Cycle now);
  bool take_in(std::uint8_t byte, Cycle at);
  void tell_alone(const char* place, Cycle now);

  const Fabric& f_;
  const Cycle fixed_;  // of an SCL period
  int slot_ = -1;
  std::uint16_t con_ = 0, stat_ = 0, brg_ = 0, add_ = 0;
  std::uint8_t rcv_ = 0, trn_ = 0xFF;
  Operation operation_ = Operation::None;
  Cycle end_ = 0;
  bool answered_ = false;  // the outside has said its part and stretched the clock
  bool acknowledged_ = false;
  std::uint8_t byte_ = 0;
  enum class Slave { Idle, Addressing, Receiving, Sending } slave_ = Slave::Idle;
};

}  // namespace dspic
