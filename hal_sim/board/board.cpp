// SPDX-License-Identifier: MIT
#include "hal_sim/board/board.h"

#include <utility>

#include "hal_sim/board/camera.h"
#include "hal_sim/board/lsm330.h"
#include "sim_core/base/hash.h"

namespace board {

Board::Board(const Setup& setup)
    : Specimen(setup), pins_({*this, motors_, ir_, power_, codec_, remote_, camera_, parts_}) {
  if (setup.camera != CameraKind::None) {
    auto sensor = std::make_unique<CameraSensor>(setup.camera);
    camera_ = std::make_unique<Camera>(*this, *sensor, setup.camera_mount, setup.camera_noise);
    i2c_.attach(std::move(sensor));
    // bits 0 and 1: 1 upright, 2 inverted, 3 sideways [lib: camera/fast_2_timer/e_common.c]
    eeprom_.set_factory_word(setup.camera_mount == CameraMount::Upright    ? 0xFFFD
                             : setup.camera_mount == CameraMount::Inverted ? 0xFFFE
                                                                           : 0xFFFF);
  }
  if (setup.revision == Revision::Rev13) i2c_.attach(std::make_unique<Lsm330>(*this));
  for (Uart& uart : uarts_) uart.first_use.tell(is_any_used_);
  codec_.first_use.tell(is_any_used_);
  codec_.line().first_use.tell(is_any_used_);
  eeprom_.first_use.tell(is_any_used_);
  if (camera_) camera_->first_use.tell(is_any_used_);
  is_any_used_ = setup.revision == Revision::Rev13;  // its sensors are asked at the start
}

Board::~Board() = default;

void Board::plug_in(std::unique_ptr<Part> part) {
  part->board_ = this;
  is_any_used_ = true;
  parts_.push_back(std::move(part));
  parts_.back()->connect();
}

// --- its life

void Board::processor_reset(Cycle at) {
  if (PinDriver* driver = pins_.driver()) driver->processor_reset(at);
  codec_.reset(at);
  for (Uart& uart : uarts_) uart.reset(at);
  i2c_.processor_reset(at);
  pins_.processor_reset(at);
  for (const auto& part : parts_) part->processor_reset(at);
}

void Board::begin_again(sim::Clicks now, Cycle at) {
  begin_specimen_again(now, at);
  motors_.begin_again(at);
  for (Uart& uart : uarts_) uart.begin_again(at);
  i2c_.begin_again(at);
  if (camera_) camera_->begin_again(at);
  packets_.begin_again();
  eeprom_.begin_again();
  power_.begin_again(setup().battery_v, at);
  pins_.follow(at);
}

void Board::exchange(Cycle at) {
  if (!std::exchange(has_run_, true))
    for (const Uart& uart : uarts_)
      if (uart.end()) uart.end()->begin();
  if (is_any_used_) {
    for (Uart& uart : uarts_) {
      uart.exchange(at);
      has_wire_news_ |= uart.has_on_wire();
    }
    codec_.forget(at);
  }
  if (PinDriver* driver = pins_.driver()) driver->exchange(at);
}

Cycle Board::horizon(Cycle at) const {
  // packets wait in their queues until the program looks
  const bool has_news_of_its_own =
      is_any_used_ && (!uarts_[0].is_quiet() || !uarts_[1].is_quiet() || !parts_.empty() ||
                       codec_.was_used() || (camera_ && camera_->is_used()));
  if (has_news_of_its_own) return at;
  const PinDriver* const driver = pins_.driver();
  return driver ? driver->horizon(at) : kNever;
}

// --- looks from outside

std::optional<int> Board::scanned_proximity(int sensor, Cycle at) const {
  const Unseen unseen(damage());
  const PinDriver* const driver = pins_.driver();
  return driver ? driver->proximity_counts(sensor, at) : std::nullopt;
}

int Board::proximity_counts(int sensor, Cycle at) const {
  if (const auto newest = scanned_proximity(sensor, at)) return *newest;
  const Unseen unseen(damage());
  return ir_.proximity_counts(sensor, at);
}

int Board::convert(int channel, Cycle at) const {
  return inputs_.counts(channel, at, pins_.lit_for(channel - kIrChannel, at));
}

std::uint64_t Board::state_hash(Cycle at) const {
  // a sum of products with odd numbers: the parts do not wait for one another; mixed once at the end
  const PinDriver* const driver = pins_.driver();
  std::uint64_t sum = driver ? driver->state_sum(at) : 0;
  std::uint64_t factor = 0x9E3779B97F4A7C15u;
  const auto add = [&](std::uint64_t part) {
    sum += part * factor;
    factor += 0xD1B54A32D192ED02u;  // even, so the factor stays odd
  };
  // what a driver has made of the motors follows from its own state
  if (!driver)
    for (const Wheel wheel : {Wheel::Left, Wheel::Right})
      add(static_cast<std::uint64_t>(motors_.steps(wheel, at)) << 4 ^ motors_.coils(wheel, at));
  for (int port = 0; port < kPorts; ++port) add(pins_.state_word(port));
  if (!is_any_used_) return sim::mix64(sum);
  for (const Uart& uart : uarts_) add(uart.state_hash());
  // every robot has a camera on its bus; it counts once a program films
  const bool films = camera_ && camera_->is_used();
  if (films || i2c_.devices().size() > (camera_ ? 1u : 0u)) add(i2c_.state_hash());
  if (films) add(camera_->state_hash());
  if (codec_.was_used()) add(codec_.state_hash());
  for (const auto& part : parts_) add(part->state_hash());
  if (const std::uint64_t changes = eeprom_.state_hash()) add(changes);
  return sim::mix64(sum);
}

}  // namespace board
