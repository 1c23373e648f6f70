// SPDX-License-Identifier: MIT
#include "dspic30/device/i2c_master.h"

#include "dspic30/device/chip_parts.h"

namespace dspic {

void I2cMaster::start(Cycle now) {
  parts_.events.run_to(now);
  parts_.i2c.hear_start(now);
}
bool I2cMaster::write(std::uint8_t byte, Cycle now) {
  parts_.events.run_to(now);
  return parts_.i2c.hear_byte(byte, now);
}
std::uint8_t I2cMaster::read(Cycle now) {
  parts_.events.run_to(now);
  return parts_.i2c.say_byte();
}
void I2cMaster::acknowledge(bool acknowledged, Cycle now) {
  parts_.events.run_to(now);
  parts_.i2c.hear_acknowledge(acknowledged, now);
}
void I2cMaster::stop(Cycle now) {
  parts_.events.run_to(now);
  parts_.i2c.hear_stop(now);
}
bool I2cMaster::holds_clock() const { return parts_.i2c.holds_clock(); }

}  // namespace dspic
