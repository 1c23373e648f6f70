// SPDX-License-Identifier: MIT
#include "dspic30/periph/ports.h"

#include <string>

namespace dspic {

namespace {

constexpr unsigned kAdpcfg = sfr("ADPCFG");
enum Kind : unsigned { Tris = 0, PortPins = 2, Lat = 4 };
// writes to an input's latch before it is taken for a mistake: start-up code may set
// latches before directions
constexpr int kVainWrites = 3;

std::string pin_name(const char* prefix, Port port, int bit) {
  return std::string(prefix) + kPortLetters[static_cast<int>(port)] + std::to_string(bit);
}

}  // namespace

void Ports::attach() {
  for (int p = 0; p < kPorts; ++p) {
    f_.bus.attach(*this, kBases[p], kBases[p] + 4);
    ports_[static_cast<std::size_t>(p)].implemented = sfr_info(kBases[p])->implemented;
  }
  f_.bus.attach(*this, kAdpcfg, kAdpcfg);
}

void Ports::reset(Cycle now) {
  adpcfg_ = 0;
  for (int p = 0; p < kPorts; ++p) {
    State& s = ports_[static_cast<std::size_t>(p)];
    s.tris = s.implemented;
    s.lat = 0;
    s.owned_out = s.owned_in = s.owned_levels = s.pull_ups = 0;
    s.vain_writes.fill(0);
    s.levels = s.driven = s.old_levels = s.old_driven = 0;
    s.changed = now - 2;
    s.last_read = 0;
    find_plain_outputs(s);
    f_.outside.pins_driven(static_cast<Port>(p), 0, 0, 0, now);
  }
}

void Ports::watch(Pin pin, PinListener& listener) {
  State& s = state(pin.port);
  s.heard |= static_cast<std::uint16_t>(1 << pin.bit);
  const auto known =
      std::find_if(watches_.begin(), watches_.end(), [&](const Watch& w) { return w.listener == &listener; });
  Watch& watch = known == watches_.end() ? watches_.emplace_back() : *known;
  watch.listener = &listener;
  watch.pins[static_cast<std::size_t>(pin.port)] |= static_cast<std::uint16_t>(1 << pin.bit);
}

void Ports::set_hearing(const PinListener& listener, bool hears) {
  for (State& s : ports_) s.heard = 0;
  for (Watch& w : watches_) {
    if (w.listener == &listener) w.hears = hears;
    for (std::size_t p = 0; w.hears && p < kPorts; ++p) ports_[p].heard |= w.pins[p];
  }
  for (State& s : ports_) find_plain_outputs(s);
}

void Ports::own_output(Pin pin, bool level, Cycle at) {
  State& s = state(pin.port);
  const auto bit = static_cast<std::uint16_t>(1 << pin.bit);
  s.owned_out |= bit;
  s.owned_in &= static_cast<std::uint16_t>(~bit);
  s.owned_levels = static_cast<std::uint16_t>(level ? s.owned_levels | bit : s.owned_levels & ~bit);
  publish(pin.port, at);
}

void Ports::own_input(Pin pin, Cycle at) {
  State& s = state(pin.port);
  const auto bit = static_cast<std::uint16_t>(1 << pin.bit);
  s.owned_in |= bit;
  s.owned_out &= static_cast<std::uint16_t>(~bit);
  publish(pin.port, at);
}

void Ports::release(Pin pin, Cycle at) {
  State& s = state(pin.port);
  const auto bit = static_cast<std::uint16_t>(1 << pin.bit);
  if (!((s.owned_in | s.owned_out) & bit)) return;
  s.owned_in &= static_cast<std::uint16_t>(~bit);
  s.owned_out &= static_cast<std::uint16_t>(~bit);
  publish(pin.port, at);
}

std::uint16_t Ports::combine(Port port, std::uint16_t levels, std::uint16_t driven, Cycle at,
                             std::uint16_t wanted) const {
  const State& s = state(port);
  if (!(wanted & s.implemented & ~driven)) return levels & s.implemented;
  const PinLevels out = f_.outside.pin_levels(port, at);
  const auto free = static_cast<std::uint16_t>((out.levels & out.driven) | (s.pull_ups & ~out.driven));
  return static_cast<std::uint16_t>(((levels & driven) | (free & ~driven)) & s.implemented);
}

std::uint16_t Ports::pins(Port port, Cycle at) const {
  const State& s = state(port);
  if (at <= s.changed) return combine(port, s.old_levels, s.old_driven, at);
  return combine(port, s.levels, s.driven, at);
}

std::uint16_t Ports::digital(Port port, std::uint16_t pins) const {
  return port == Port::B ? static_cast<std::uint16_t>(pins & adpcfg_) : pins;
}

std::int64_t Ports::edges(Pin pin, Edge edge, Cycle after, Cycle until) const {
  if (is_output(pin) || until <= after) return 0;
  return f_.outside.edges(pin, edge, after, until);
}

Cycle Ports::nth_edge(Pin pin, Edge edge, Cycle after, std::int64_t n) const {
  return is_output(pin) ? kNever : f_.outside.nth_edge(pin, edge, after, n);
}

void Ports::publish(Port port, Cycle at) {
  State& s = state(port);
  const auto now_driven = driven(s);
  const auto now_levels =
      static_cast<std::uint16_t>(((s.lat & ~s.owned_out) | (s.owned_levels & s.owned_out)) & now_driven);
  const std::uint16_t driven_before = s.driven, levels_before = s.levels;
  const bool changes = now_driven != driven_before || now_levels != levels_before;
  std::uint16_t before = 0;
  const std::uint16_t touched =
      static_cast<std::uint16_t>(((driven_before ^ now_driven) | (levels_before ^ now_levels)) & s.heard);
  if (touched) before = combine(port, levels_before, driven_before, at, touched);
  if (changes) put_out(port, now_levels, now_driven, at);
  find_plain_outputs(s);
  if (!touched) return;
  const auto edges =
      static_cast<std::uint16_t>((before ^ combine(port, now_levels, now_driven, at, touched)) & touched);
  if (!edges) return;
  for (const Watch& w : watches_)
    for (int bit = 0; bit < 16 && w.hears; ++bit)
      if (edges & w.pins[static_cast<std::size_t>(port)] & 1 << bit)
        w.listener->own_edge({port, bit}, before >> bit & 1 ? Edge::Falling : Edge::Rising, at);
}

void Ports::count_vain(Port port, std::uint16_t bits, Cycle now) {
  State& s = state(port);
  bits &= static_cast<std::uint16_t>(s.tris & ~s.owned_in & ~s.owned_out);
  for (int bit = 0; bits; ++bit, bits >>= 1) {
    if (!(bits & 1)) continue;
    auto& writes = s.vain_writes[static_cast<std::size_t>(bit)];
    if (writes < kVainWrites && ++writes == kVainWrites) {
      const std::string tris = pin_name("TRIS", port, bit);
      f_.diagnostics.report(Cause::InputDriven, tris,
                            pin_name("LAT", port, bit) + " is written again and again, but " + tris +
                                " = 1 makes the pin an input: nothing reaches it",
                            now);
    }
  }
}

// pins whose level somebody outside drives, and which the program cannot see
void Ports::look_for_blind_pins(Cycle now) {
  const std::uint16_t inputs = state(Port::B).tris & static_cast<std::uint16_t>(~adpcfg_ & ~blind_told_);
  const std::uint16_t blind = f_.outside.pin_levels(Port::B, now).driven & inputs;
  blind_told_ |= blind;
  for (int bit = 0; bit < 16; ++bit) {
    if (!(blind >> bit & 1)) continue;
    const std::string config = "ADPCFG.PCFG" + std::to_string(bit);
    f_.diagnostics.report(Cause::DigitalAnalogue, config,
                          pin_name("PORT", Port::B, bit) + " reads 0 whatever the pin does: " + config +
                              " = 0 makes it analogue",
                          now);
  }
}

std::uint16_t Ports::read(unsigned address, Cycle now) {
  if (address == kAdpcfg) return adpcfg_;
  const Port port = port_of(address);
  State& s = state(port);
  if (address != kBases[static_cast<int>(port)] + PortPins) return peek(address, now);
  const std::uint16_t levels = pins(port, now);
  s.last_read = levels;
  if (port == Port::B && (s.tris & ~adpcfg_ & ~blind_told_)) look_for_blind_pins(now);
  return digital(port, levels);
}

std::uint16_t Ports::peek(unsigned address, Cycle now) const {
  if (address == kAdpcfg) return adpcfg_;
  const Port port = port_of(address);
  const State& s = state(port);
  switch (address - kBases[static_cast<int>(port)]) {
    case Tris:
      return s.tris;
    case Lat:
      return s.lat;
    default:
      return digital(port, pins(port, now));
  }
}

void Ports::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  if (address == kAdpcfg) {
    adpcfg_ = merge_lanes(adpcfg_, value, lanes);
    return;
  }
  const Port port = port_of(address);
  State& s = state(port);
  const unsigned kind = address - kBases[static_cast<int>(port)];
  if (kind == Tris) {
    s.tris = merge_lanes(s.tris, value, lanes);
    const auto outputs = static_cast<std::uint16_t>(~s.tris);
    for (int bit = 0; bit < 16; ++bit)
      if (outputs >> bit & 1) s.vain_writes[static_cast<std::size_t>(bit)] = 0;
  } else {
    const std::uint16_t next = merge_lanes(s.lat, value, lanes);
    const std::uint16_t inputs = s.tris & lanes;
    if (inputs) {
      // writing back what was read from the pins is half of a bit operation on another pin
      const std::uint16_t base = kind == Lat ? s.lat : digital(port, pins(port, now));
      if (const auto vain = static_cast<std::uint16_t>((value ^ base) & inputs)) count_vain(port, vain, now);
    }
    s.lat = next;
  }
  publish(port, now + 1);
}

Cycle Ports::horizon(unsigned address, Cycle now) const {
  if (address == kAdpcfg) return kNever;
  const Port port = port_of(address);
  if (address != kBases[static_cast<int>(port)] + PortPins) return kNever;
  const State& s = state(port);
  if (s.changed >= now) return s.changed + 1;
  if ((s.driven & s.implemented) == s.implemented) return kNever;
  return f_.outside.levels_horizon(port, 0xFFFF, now);
}

}  // namespace dspic
