// SPDX-License-Identifier: MIT
// LSM330, accelerometer and gyroscope of revision 1.3, on the I2C bus: two devices in one case.
//
//   0x3C accelerometer   0xD4 gyroscope      x forward, y left, z up; rates right-handed about them
//   0F who   20 rate, BDU, axes   23 gyro range, BDU   24 acc range   25 acc address increment
//   26 gyro temperature   27 status   28..2D x, y, z, low byte first
//
// Modelled: output rates, block data update, ranges, power down, address increment (gyro: bit 7 of the
// register number; acc: register 25), status, noise per sample, the gyroscope's output filter, offsets of the
// robot. A sample is worked out when its register is read, for the instant at which it was taken. Not
// modelled: FIFOs (bypassed, as the library leaves them), interrupts, high-pass filters, self-test, the
// temperature's way; samples older than the pose history (rates below 50 Hz) are those of its oldest pose.
// Source: [LSM330], [lib: acc_gyro/e_lsm330.c], facts restated.
#pragma once
#include <array>
#include <cstdint>

#include "hal_sim/board/i2c_device.h"

namespace board {

class Specimen;

class Lsm330 final : public I2cDevice {
 public:
  explicit Lsm330(const Specimen& robot);

  bool answers_to(std::uint8_t address) const override;
  void begin(std::uint8_t address, bool reading, Cycle at) override;
  bool write(std::uint8_t byte, Cycle at) override;
  std::uint8_t read(Cycle at) override;
  void begin_again(Cycle at) override;
  std::uint64_t state_hash() const override;

 private:
  /// One of the two devices.
  struct Half {
    bool gyro = false;
    std::array<std::uint8_t, 64> registers{};
    Cycle since = 0;                     // samples are counted from here
    std::uint64_t epoch = 0;             // grows with every such beginning: noise stays unique
    std::int64_t read_sample = -1;       // newest sample of which something was read
    std::array<std::int16_t, 3> held{};  // block data update: value of which the low byte was read
    std::array<bool, 3> holding{};
    std::int64_t known_sample = -1;  // newest one worked out
    std::array<std::int16_t, 3> known{};
  };
  double rate_hz(const Half& half) const;
  bool is_block_update(const Half& half) const;
  std::int64_t newest(const Half& half, Cycle at) const;
  std::int64_t newest_of(const Half& half, Cycle at) const;
  std::int16_t value(Half& half, int axis, Cycle at);
  std::uint8_t data_byte(Half& half, int number, Cycle at);
  void set(Half& half, int number, std::uint8_t value, Cycle at);

  const Specimen& robot_;
  Half acc_, gyro_;
  Half* addressed_ = nullptr;
  bool expects_register_ = false;
  bool increments_ = false;
  std::uint8_t number_ = 0;
};

}  // namespace board
