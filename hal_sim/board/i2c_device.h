// SPDX-License-Identifier: MIT
// What hangs on the robot's I2C bus (SIO_C, SIO_D): the camera's control port, the accelerometer and
// gyroscope of revision 1.3, and every turret. The bus (i2c_bus.h) owns the devices and turns starts, bytes
// and stops into these calls; `at` is the robot's cycle at which the byte's last bit is over. Nothing here
// blocks. Not modelled: clock stretching, arbitration (the processor is the only master).
#pragma once
#include <cstdint>

#include "hal_sim/board/cycle.h"

namespace board {

class I2cDevice {
 public:
  virtual ~I2cDevice() = default;

  /// True when the device answers to this 8-bit address in its write form (even). A device may have several.
  virtual bool answers_to(std::uint8_t address) const = 0;

  /// A start, or a repeated start, with one of its addresses went over the bus; bytes follow.
  virtual void begin(std::uint8_t address, bool reading, Cycle at) = 0;
  /// The master sends a byte. False: not acknowledged.
  virtual bool write(std::uint8_t byte, Cycle at) = 0;
  /// The master reads the next byte.
  virtual std::uint8_t read(Cycle at) = 0;
  /// A stop, or a start for somebody else.
  virtual void end(Cycle /*at*/) {}

  /// The processor was reset; devices with power of their own keep what they hold, so the default does
  /// nothing.
  virtual void processor_reset(Cycle /*at*/) {}

  /// It begins as when it was first switched on.
  virtual void begin_again(Cycle /*at*/) {}

  /// Everything that must repeat from run to run.
  virtual std::uint64_t state_hash() const { return 0; }
};

/// A device with up to 256 registers: the first byte written sets the register, further bytes are written to
/// it and the ones after it, reads go on from there.
class I2cRegisters : public I2cDevice {
 public:
  explicit I2cRegisters(std::uint8_t address) : address_(address) {}
  bool answers_to(std::uint8_t address) const override { return address == address_; }
  void begin(std::uint8_t /*address*/, bool reading, Cycle /*at*/) override { expects_register_ = !reading; }
  bool write(std::uint8_t byte, Cycle at) override {
    if (expects_register_) {
      register_ = byte;
      expects_register_ = false;
      return true;
    }
    return write_register(register_++, byte, at);
  }
  std::uint8_t read(Cycle at) override { return read_register(register_++, at); }

 protected:
  virtual bool write_register(std::uint8_t number, std::uint8_t value, Cycle at) = 0;
  virtual std::uint8_t read_register(std::uint8_t number, Cycle at) = 0;

 private:
  std::uint8_t address_;
  std::uint8_t register_ = 0;
  bool expects_register_ = false;
};

}  // namespace board
