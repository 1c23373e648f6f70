// SPDX-License-Identifier: MIT
#include "hal_sim/drivers/i2c_master.h"

namespace drivers {

namespace {
int half_bits_of(I2cMaster::Operation operation) {
  switch (operation) {
    case I2cMaster::Operation::Read:
      return kI2cByteHalves;
    case I2cMaster::Operation::Write:
      return kI2cAcknowledgedHalves;
    case I2cMaster::Operation::Start:
      return kI2cStartHalves;
    case I2cMaster::Operation::Restart:
      return kI2cRestartHalves;
    case I2cMaster::Operation::Stop:
      return kI2cStopHalves;
    default:
      return kI2cAcknowledgeHalves;
  }
}
}  // namespace

void I2cMaster::switch_on(int brg, Cycle at) {
  switch_off(at);
  on_ = true;
  bit_cycles_ = (brg & 0x1FF) + 1 + kI2cEdgeCycles;
}

void I2cMaster::switch_off(Cycle at) {
  settle(at);
  if (!bus_.is_stopped()) bus_.stop(at);  // released lines end a transaction
  on_ = pending_ = started_ = false;
  over_at_ = at;
}

Cycle I2cMaster::begin(Operation operation, std::uint8_t byte, Cycle at) {
  settle(at);
  if (!on_ || pending_) return -1;
  pending_ = true;
  operation_ = operation;
  byte_ = byte;
  over_at_ = at + (half_bits_of(operation) * bit_cycles_ + 1) / 2;
  return over_at_;
}

void I2cMaster::settle(Cycle at) {
  if (!pending_ || at < over_at_) return;
  pending_ = false;
  switch (operation_) {
    case Operation::Start:
    case Operation::Restart:
      bus_.start(over_at_, operation_ == Operation::Restart);
      started_ = true;
      break;
    case Operation::Stop:
      bus_.stop(over_at_);
      started_ = false;
      break;
    case Operation::Write:
      acknowledged_ = bus_.write(byte_, over_at_);
      break;
    case Operation::Read:
      received_ = bus_.read(over_at_);
      break;
    case Operation::Acknowledge:
    case Operation::Refuse:
      break;  // devices are asked byte by byte: they need not know
  }
}

void I2cMaster::processor_reset(Cycle at) {
  switch_off(at);
  acknowledged_ = false;
  received_ = 0;
}

std::uint64_t I2cMaster::state_hash() const {
  std::uint64_t sum =
      (on_ ? 1u : 0u) | (pending_ ? 2u : 0u) | (started_ ? 4u : 0u) | (acknowledged_ ? 8u : 0u);
  sum = sum << 16 | static_cast<std::uint64_t>(received_) << 8 | byte_;
  return sum * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(over_at_);
}

}  // namespace drivers
