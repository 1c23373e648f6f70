// SPDX-License-Identifier: MIT
// The robot's I2C bus as the processor's master module drives it: start, restart, byte, acknowledge, stop.
//
//   e_i2c_* -> registers of the I2C module -> I2cBus -> the devices that answer to the address
//
// A byte is 9 bits of 164 cycles at the library's BRG of 150. A byte that nobody acknowledges is lost;
// reading from nobody gives 0xFF, the level of the released line. Times are the caller's; nothing blocks. Not
// modelled: clock stretching, arbitration, two devices of one address (the first one attached answers).
// Source: [DS70143 17], [lib: I2C/], facts restated.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "hal_sim/board/i2c_device.h"

namespace board {

class I2cBus {
 public:
  /// Plugs a device in. Before power-up, or while the bus is idle.
  void attach(std::unique_ptr<I2cDevice> device);
  /// The same for a device that belongs to a part; it must outlive the bus.
  void attach(I2cDevice& device) { devices_.push_back(&device); }
  /// Device at an 8-bit address in write form; null: nobody.
  I2cDevice* find(std::uint8_t address) const;
  const std::vector<I2cDevice*>& devices() const { return devices_; }

  void start(Cycle at, bool repeated = false);
  /// Starts that were no repeated ones although nobody had stopped the bus, and when the first one came.
  std::int64_t unstopped() const { return unstopped_; }
  Cycle first_unstopped() const { return first_unstopped_; }
  /// One byte after a start is the address. False: nobody acknowledged.
  bool write(std::uint8_t byte, Cycle at);
  std::uint8_t read(Cycle at);
  void stop(Cycle at);
  /// I2CSTAT.P: the bus is idle, or a stop was the last thing on it.

  void processor_reset(Cycle at);
  /// It and its devices begin as when they were first switched on.
  void begin_again(Cycle at);
  std::uint64_t state_hash() const;

 private:
  std::vector<I2cDevice*> devices_;
  std::vector<std::unique_ptr<I2cDevice>> owned_;
  I2cDevice* addressed_ = nullptr;
  bool open_ = false;
  bool expects_address_ = false;
  std::int64_t unstopped_ = 0;
  Cycle first_unstopped_ = 0;
};

}  // namespace board
