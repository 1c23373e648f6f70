// SPDX-License-Identifier: MIT
#include "hal_sim/board/pins.h"

#include <algorithm>

#include "hal_sim/board/camera.h"
#include "hal_sim/board/codec.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/remote.h"

namespace board {

namespace {

constexpr unsigned kNearPulse = 16;  // of PinDriver::pulses(): it flashes body and front LED

constexpr std::uint16_t bits(unsigned word) { return static_cast<std::uint16_t>(word); }
const PortWiring& wiring(Port port) { return kWiring[static_cast<std::size_t>(port)]; }

}  // namespace

Pins::Pins(const Consumers& consumers) : to_(consumers) {
  for (std::size_t i = 0; i < kPorts; ++i) tris_[i] = kWiring[i].implemented;
  emitter_directions_changed();
}

int Pins::port_index(char port) {
  constexpr signed char kIndex[] = {0, 1, 2, 3, -1, 4, 5};  // A B C D, no E, F G
  return port >= 'A' && port <= 'G' ? kIndex[port - 'A'] : -1;
}

void Pins::attach(PinDriver* driver) {
  driver_ = driver;
  to_.motors.attach(driver);
}

// --- registers

std::uint16_t Pins::read(char letter, Register reg, Cycle at) const {
  const int index = port_index(letter);
  if (index < 0) return 0;
  const Port port = static_cast<Port>(index);
  return reg == Register::Tris ? tris_[port] : reg == Register::Lat ? latch(port, at) : levels(port, at);
}

void Pins::write(char letter, Register reg, std::uint16_t value, Cycle at) {
  const int index = port_index(letter);
  if (index < 0) return;
  const Port port = static_cast<Port>(index);
  const PortWiring& to = wiring(port);
  std::uint16_t &lat = lat_[port], &tris = tris_[port];
  const unsigned driven = lat & ~unsigned{tris}, latched = lat;
  value = bits(value & to.implemented);
  bool is_current_new = false;
  if (reg == Register::Tris) {
    tris = value;
    if (to.emitters) emitter_directions_changed();
    if (to.coils) to_.motors.set_directions(value, at);
  } else {
    if (driver_) value = beside_driver(port, value, at);
    if (to.coils) is_current_new = to_.motors.write(value, at);
    lat = bits(value & ~to.coils);
    if (latched & ~unsigned{lat} & to.camera_reset && to_.camera) to_.camera->sensor_reset(at);
  }
  const bool is_new = reg == Register::Tris || lat != latched;
  const unsigned changed = driven ^ (lat & ~unsigned{tris});
  if (is_new) outputs_changed(port, changed, at);
  // What is on draws its current: a driver's share of it may have changed since it was last asked.
  if (driver_ && (is_new || to.coils))
    follow(at);
  else if (is_current_new || (to.coils && reg == Register::Tris))
    follow_motors(at);
  else if (changed)
    to_.power.draw(at);
}

/// A driver flashes the emitters of pins that are outputs, no others.
void Pins::emitter_directions_changed() {
  unsigned lines = 0;
  for (int line = 0; line < kEmitterLines; ++line) {
    const Pin pin = kEmitterPins[line];
    lines |= static_cast<unsigned>((tris_[pin.port] & pin.mask()) == 0) << line;
  }
  to_.ir.set_driven(lines);
}

void Pins::outputs_changed(Port port, unsigned changed, Cycle at) {
  const PortWiring& to = wiring(port);
  if (changed & to.emitters) {
    for (int line = 0; line < kEmitterLines; ++line)
      if (kEmitterPins[line].port == port) to_.ir.set_line(line, is_on(kEmitterPins[line]), at);
    to_.power.set_emitters(to_.ir.lines_on());
  }
  if (changed & to.codec_on) to_.codec.power(is_on(kCodecOnPin), at);
  if (changed & (to.leds | to.codec_on | to.camera_reset))
    to_.power.set_others(leds(at), is_on(kCameraResetPin), is_on(kCodecOnPin));
  for (const auto& part : to_.parts) part->pins_changed(at);
}

void Pins::write_bit(char port, int bit, bool level, Cycle at) {
  const unsigned old = read(port, Register::Lat, at), mask = 1u << bit;
  write(port, Register::Lat, bits(level ? old | mask : old & ~mask), at);
}

Cycle Pins::horizon(char letter, Cycle at) const {
  const int index = port_index(letter);
  if (index < 0) return kNever;
  const Port port = static_cast<Port>(index);
  Cycle next = given_horizon(port, at);
  if (!driver_) return next;
  if (wiring(port).coils)
    next =
        std::min({next, driver_->coils_horizon(Wheel::Left, at), driver_->coils_horizon(Wheel::Right, at)});
  if (wiring(port).emitters || port == kFrontLedPin.port) next = std::min(next, driver_->pulses_horizon(at));
  return next;
}

void Pins::init(Cycle at) {
  for (const Port port : {kA, kC, kF, kG}) {
    const unsigned outputs = wiring(port).first_outputs();
    write(kPortLetters[port], Register::Lat, bits(lat_[port] & ~outputs), at);
    write(kPortLetters[port], Register::Tris, bits((tris_[port] & ~outputs) | wiring(port).first_inputs()),
          at);
  }
  // coils last: a running driver energises them again at its next step
  tris_[kD] = kCameraData;
  to_.motors.set_directions(kCameraData, at);
  to_.motors.release(at);
  follow(at);
}

void Pins::processor_reset(Cycle at) {
  to_.motors.processor_reset();
  for (int line = 0; line < kEmitterLines; ++line) to_.ir.set_line(line, false, at);
  lat_.fill(0);
  for (std::size_t i = 0; i < kPorts; ++i) tris_[i] = kWiring[i].implemented;
  emitter_directions_changed();
  follow(at);
}

// --- latches and levels

std::uint16_t Pins::latch(Port port, Cycle at) const {
  const PortWiring& to = wiring(port);
  unsigned word = lat_[port];
  if (to.coils) word |= to_.motors.coil_pins(at);
  if (const unsigned on = to.emitters || port == kFrontLedPin.port ? pulses(at) : 0) {
    for (int line = 0; line < kEmitterLines; ++line)
      if (on & (1u << line) && kEmitterPins[line].port == port) word |= kEmitterPins[line].mask();
    if (port == kFrontLedPin.port && on & kNearPulse) word |= to.leds;
  }
  return bits(word);
}

std::uint16_t Pins::beside_driver(Port port, std::uint16_t value, Cycle at) const {
  const PortWiring& to = wiring(port);
  if (to.emitters && driver_->owns_emitters()) value = bits(value & ~to.emitters);
  if (port == kFrontLedPin.port && pulses(at) & kNearPulse) value = bits(value & ~to.leds);
  return value;
}

std::uint16_t Pins::with_held(Port port, std::uint16_t levels) const {
  const Damage* const damage = to_.robot.damage();
  if (!damage) return levels;
  const unsigned held = damage->held_pins[port];
  return bits((levels & ~held) | (damage->held_levels[port] & held));
}

std::uint16_t Pins::given_free(Port port, Cycle at) const {
  const PortWiring& to = wiring(port);
  unsigned level = to.serial_in | to.serial_out | to.i2c;  // idle lines and pull-ups
  if (to.battery_good && to_.power.battery().voltage(at) >= kBatteryLowV) level |= to.battery_good;
  if (to.remote && to_.remote.level(at)) level |= to.remote;
  if (to.selector) level |= (static_cast<unsigned>(to_.robot.selector()) & 15u) << kSelectorPins[0].bit;
  return bits(level);
}

Cycle Pins::given_horizon(Port port, Cycle at) const {
  if (!wiring(port).battery_good) return kNever;
  return std::min(to_.power.battery().below(kBatteryLowV, at), to_.remote.horizon(at));
}

std::uint16_t Pins::levels(Port port, Cycle at) const {
  const unsigned tris = tris_[port];
  const unsigned level = (latch(port, at) & ~tris) | (given_free(port, at) & tris);
  return bits(with_held(port, bits(level)) & wiring(port).implemented);
}

std::uint32_t Pins::driven_leds(Cycle at) const {
  const unsigned ring = levels(kA, at) & wiring(kA).leds, near = levels(kC, at);
  std::uint32_t lit = 0;
  for (int led = 0; ring && led < 8; ++led)
    if (ring & kRingLedPins[led].mask()) lit |= 1u << led;
  if (near & kBodyLedPin.mask()) lit |= 1u << 8;
  if (near & kFrontLedPin.mask()) lit |= 1u << 9;
  return lit;
}

std::uint32_t Pins::leds(Cycle at) const {
  const std::uint32_t driven = driven_leds(at);
  const Damage* const damage = to_.robot.damage();
  return damage ? driven & ~damage->dead_leds : driven;
}

Cycle Pins::lit_for(int sensor, Cycle at) const {
  const Cycle by_line = to_.ir.lit_for(sensor, at);
  return by_line < 0 && pulses(at) & (1u << (sensor & 3)) ? IrCircuit::kSettled : by_line;
}

// --- by hand

bool Pins::can_be_held(char letter, int bit) {
  const int index = port_index(letter);
  if (index < 0 || bit < 0 || bit > 15) return false;
  const PortWiring& to = wiring(static_cast<Port>(index));
  return ((to.leds | to.first_inputs()) >> bit & 1) != 0;
}

void Pins::hold(char letter, int bit, std::optional<bool> level, Cycle at) {
  Damage& d = to_.robot.be_damaged();
  const auto p = static_cast<std::size_t>(port_index(letter));
  const unsigned mask = 1u << bit;
  const auto port = static_cast<Port>(p);
  const unsigned before = levels(port, at);
  d.held_pins[p] = bits(level ? d.held_pins[p] | mask : d.held_pins[p] & ~mask);
  d.held_levels[p] = bits(level && *level ? d.held_levels[p] | mask : d.held_levels[p] & ~mask);
  const unsigned changed = (levels(port, at) ^ before) & tris_[p] & mask;
  d.rose[p] = bits(d.rose[p] | (changed & ~before));
  d.fell[p] = bits(d.fell[p] | (changed & before));
  changed_by_hand(at);
}

bool Pins::take_edge(Port port, int bit, bool rising) {
  if (!to_.robot.damage()) return false;
  Damage& d = to_.robot.be_damaged();
  auto& edges = rising ? d.rose[port] : d.fell[port];
  const unsigned mask = 1u << bit;
  const bool was_made = (edges & mask) != 0;
  edges = bits(edges & ~mask);
  return was_made;
}

std::uint16_t Pins::held(Port port) const {
  const Damage* const damage = to_.robot.damage();
  return damage ? damage->held_pins[port] : std::uint16_t{0};
}

void Pins::changed_by_hand(Cycle at) {
  ++to_.robot.be_damaged().pins_changed;
  follow(at);
}

// --- what is on

// the drivers' flashes by their mean, lines that a program holds by their latch
void Pins::follow(Cycle at) {
  double lines = to_.ir.lines_on();
  if (driver_) lines += driver_->mean_pulses();
  to_.power.set_emitters(lines);
  to_.power.set_others(leds(at), is_on(kCameraResetPin), is_on(kCodecOnPin));
  follow_motors(at);
}

void Pins::follow_motors(Cycle at) {
  to_.power.set_coils(Wheel::Left, to_.motors.duty(Wheel::Left, at));
  follow_motor(Wheel::Right, at);
}

void Pins::follow_motor(Wheel wheel, Cycle at) {
  to_.power.set_coils(wheel, to_.motors.duty(wheel, at));
  to_.power.draw(at);
}

}  // namespace board
