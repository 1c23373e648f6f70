// SPDX-License-Identifier: MIT
#include "hal_sim/board/i2c_bus.h"

namespace board {

namespace {
constexpr std::uint8_t kReleased = 0xFF;  // both lines have pull-ups
}

void I2cBus::attach(std::unique_ptr<I2cDevice> device) {
  devices_.push_back(device.get());
  owned_.push_back(std::move(device));
}

I2cDevice* I2cBus::find(std::uint8_t address) const {
  for (I2cDevice* device : devices_)
    if (device->answers_to(address)) return device;
  return nullptr;
}

void I2cBus::start(Cycle at, bool repeated) {
  if (open_ && !repeated && unstopped_++ == 0) first_unstopped_ = at;
  open_ = true;
  expects_address_ = true;
}

bool I2cBus::write(std::uint8_t byte, Cycle at) {
  if (!open_) return false;
  if (!expects_address_) return addressed_ && addressed_->write(byte, at);
  expects_address_ = false;
  I2cDevice* device = find(byte & 0xFE);
  if (addressed_ && addressed_ != device) addressed_->end(at);
  addressed_ = device;
  if (device) device->begin(byte & 0xFE, (byte & 1) != 0, at);
  return device != nullptr;
}

std::uint8_t I2cBus::read(Cycle at) {
  return open_ && !expects_address_ && addressed_ ? addressed_->read(at) : kReleased;
}

void I2cBus::stop(Cycle at) {
  if (addressed_) addressed_->end(at);
  addressed_ = nullptr;
  open_ = expects_address_ = false;
}

void I2cBus::processor_reset(Cycle at) {
  stop(at);
  for (I2cDevice* device : devices_) device->processor_reset(at);
}

void I2cBus::begin_again(Cycle at) {
  processor_reset(at);
  for (I2cDevice* device : devices_) device->begin_again(at);
}

std::uint64_t I2cBus::state_hash() const {
  std::uint64_t sum = open_;
  for (const I2cDevice* device : devices_) sum = sum * 0x9E3779B97F4A7C15u + device->state_hash();
  return sum;
}

}  // namespace board
