// SPDX-License-Identifier: MIT
#include "dspic30/periph/capture_compare.h"

#include <algorithm>
#include <type_traits>

namespace dspic {

namespace {

constexpr unsigned kIc = sfr("IC1BUF"), kOc = sfr("OC1RS");
constexpr int kIcFlags[] = {irq::Ic1, irq::Ic2, irq::Ic3, irq::Ic4, irq::Ic5, irq::Ic6, irq::Ic7, irq::Ic8};
constexpr int kOcFlags[] = {irq::Oc1, irq::Oc2, irq::Oc3, irq::Oc4, irq::Oc5, irq::Oc6, irq::Oc7, irq::Oc8};
constexpr std::uint16_t kIctmr = sfr_bits("IC1CON", "ICTMR"), kIcov = sfr_bits("IC1CON", "ICOV"),
                        kIcbne = sfr_bits("IC1CON", "ICBNE"), kOcflt = sfr_bits("OC1CON", "OCFLT");
constexpr SfrBits kIcm = sfr_field("IC1CON", "ICM"), kIci = sfr_field("IC1CON", "ICI");
constexpr Cycle kEdgeToCapture = 1;  // synchroniser
constexpr Cycle kMatchToPin = 1;     // [chip P9]
enum Mode : int { Off, LowToHigh, HighToLow, Toggle, SinglePulse, Pulses, Pwm, PwmFault };

Pin capture_pin(int n) { return {Port::D, 8 + n}; }
Pin compare_pin(int n) { return {Port::D, n}; }

}  // namespace

// --- capture

void InputCapture::attach() {
  f_.bus.attach(*this, kIc, kIc + 0x1E);
  for (int n = 0; n < kCaptures; ++n) {
    units_[static_cast<std::size_t>(n)].slot =
        f_.events.add(*this, n, std::uint64_t{1} << kIcFlags[n], false);
    f_.bus.mark_unmodelled(kIc + 4 * static_cast<unsigned>(n) + 2,
                           std::integral_constant<std::uint16_t, sfr_bits("IC1CON", "ICSIDL")>());
  }
}

void InputCapture::reset(Cycle /*now*/) {
  for (Unit& u : units_) {
    const int slot = u.slot;
    u = Unit{};
    u.slot = slot;
    f_.events.set(slot, kNever);
  }
}

void InputCapture::schedule(int n, Cycle after) {
  const Unit& u = units_[static_cast<std::size_t>(n)];
  const Pin pin = capture_pin(n);
  const auto nth = [&](Edge e, int k) { return f_.ports.nth_edge(pin, e, after, k); };
  Cycle edge = kNever;
  switch (kIcm.of(u.con)) {
    case 1:
      edge = std::min(nth(Edge::Rising, 1), nth(Edge::Falling, 1));
      break;
    case 2:
      edge = nth(Edge::Falling, 1);
      break;
    case 3:
      edge = nth(Edge::Rising, 1);
      break;
    case 4:
      edge = nth(Edge::Rising, 4);
      break;
    case 5:
      edge = nth(Edge::Rising, 16);
      break;
    default:
      break;
  }
  f_.events.set(u.slot, edge >= kNever ? kNever : edge + kEdgeToCapture);
}

void InputCapture::capture(Unit& u, int n, Cycle at) {
  if (u.waiting == 4) {
    u.overflow = true;
    return;
  }
  u.words[static_cast<std::size_t>(u.waiting++)] =
      static_cast<std::uint16_t>(timers_.count((u.con & kIctmr) ? 2 : 3, at));
  const int each =
      kIcm.of(u.con) == 1 ? 1 : static_cast<int>(kIci.of(u.con)) + 1;  // ICI does not count in mode 1
  if (++u.since_interrupt >= each) {
    u.since_interrupt = 0;
    f_.interrupts.raise(kIcFlags[n], at);
  }
}

void InputCapture::on_event(int id, Cycle at) {
  capture(units_[static_cast<std::size_t>(id)], id, at);
  schedule(id, at - kEdgeToCapture);
}

void InputCapture::outside_changed(Cycle now) {
  for (int n = 0; n < kCaptures; ++n)
    if (units_[static_cast<std::size_t>(n)].con & kIcm.mask) schedule(n, now - kEdgeToCapture);
}

std::uint16_t InputCapture::read(unsigned address, Cycle now) {
  Unit& u = units_[(address - kIc) / 4];
  const std::uint16_t word = peek(address, now);
  if ((address & 2) == 0 && u.waiting > 0) {
    for (int i = 1; i < u.waiting; ++i)
      u.words[static_cast<std::size_t>(i - 1)] = u.words[static_cast<std::size_t>(i)];
    --u.waiting;
  }
  return word;
}

std::uint16_t InputCapture::peek(unsigned address, Cycle /*now*/) const {
  const Unit& u = units_[(address - kIc) / 4];
  if ((address & 2) == 0) return u.waiting ? u.words[0] : 0;
  return static_cast<std::uint16_t>(u.con | (u.overflow ? kIcov : 0) | (u.waiting ? kIcbne : 0));
}

void InputCapture::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  if ((address & 2) == 0) return;
  const int n = static_cast<int>(address - kIc) / 4;
  Unit& u = units_[static_cast<std::size_t>(n)];
  const unsigned before = kIcm.of(u.con);
  u.con = merge_lanes(u.con, value, lanes) & static_cast<std::uint16_t>(~(kIcov | kIcbne));
  if (kIcm.of(u.con) == 0) {
    u.waiting = 0;
    u.overflow = false;
  }
  if (kIcm.of(u.con) != before) {
    u.since_interrupt = 0;
    schedule(n, now + 1);
  }
}

Cycle InputCapture::horizon(unsigned address, Cycle /*now*/) const {
  return f_.events.when(units_[(address - kIc) / 4].slot);
}

// --- compare

void OutputCompare::attach() {
  f_.bus.attach(*this, kOc, kOc + 6 * kCompares - 2);
  for (int n = 0; n < kCompares; ++n) {
    units_[static_cast<std::size_t>(n)].slot = f_.events.add(*this, n, std::uint64_t{1} << kOcFlags[n], true);
    f_.bus.mark_unmodelled(kOc + 6 * static_cast<unsigned>(n) + 4,
                           std::integral_constant<std::uint16_t, sfr_bits("OC1CON", "OCSIDL")>());
  }
  timers_.listen(*this);
}

void OutputCompare::reset(Cycle /*now*/) {
  for (Unit& u : units_) {
    const int slot = u.slot;
    u = Unit{};
    u.slot = slot;
    f_.events.set(slot, kNever);
  }
}

void OutputCompare::drive(int n, bool high, Cycle at) {
  units_[static_cast<std::size_t>(n)].high = high;
  f_.ports.own_output(compare_pin(n), high, at);
}

void OutputCompare::schedule(int n, Cycle after) {
  Unit& u = units_[static_cast<std::size_t>(n)];
  Cycle tick = kNever;
  const auto reach = [&](std::uint16_t v) { return timers_.next_reach(timer(u), v, after); };
  if (mode(u) != Off && !u.done && timers_.is_running(timer(u))) {
    switch (mode(u)) {
      case LowToHigh:
      case HighToLow:
      case Toggle:
        tick = reach(u.r);
        break;
      case SinglePulse:
      case Pulses:
        tick = reach(u.high ? u.rs : u.r);
        break;
      default:  // the duty cycle's end, or the next period
        tick = std::min(reach(0), u.duty ? reach(u.duty) : kNever);
        break;
    }
  }
  f_.events.set(u.slot, tick >= kNever ? kNever : tick + kMatchToPin);
}

void OutputCompare::on_event(int id, Cycle at) {
  Unit& u = units_[static_cast<std::size_t>(id)];
  const Cycle tick = at - kMatchToPin;
  // What the match does to the pin; a mode that is over waits for another.
  switch (mode(u)) {
    case LowToHigh:
      drive(id, true, at);
      u.done = true;
      f_.interrupts.raise(kOcFlags[id], at);
      break;
    case HighToLow:
      drive(id, false, at);
      u.done = true;
      f_.interrupts.raise(kOcFlags[id], at);
      break;
    case Toggle:
      drive(id, !u.high, at);
      f_.interrupts.raise(kOcFlags[id], at);
      break;
    case SinglePulse:
    case Pulses:
      drive(id, !u.high, at);
      if (!u.high) {
        u.done = mode(u) == SinglePulse;
        f_.interrupts.raise(kOcFlags[id], at);
      }
      break;
    case Pwm:
    case PwmFault:
      if (timers_.count(timer(u), tick) == 0) {
        u.duty = u.r = u.rs;
        drive(id, u.duty > 0, at);
      } else {
        drive(id, false, at);
      }
      break;
    default:
      break;
  }
  schedule(id, tick);
}

void OutputCompare::timer_changed(int which, Cycle at) {
  for (int n = 0; n < kCompares; ++n) {
    const Unit& u = units_[static_cast<std::size_t>(n)];
    if (mode(u) != Off && timer(u) == which) schedule(n, at);
  }
}

std::uint16_t OutputCompare::peek(unsigned address, Cycle /*now*/) const {
  const Unit& u = units_[(address - kOc) / 6];
  switch ((address - kOc) % 6) {
    case 0:
      return u.rs;
    case 2:
      return u.r;
    default:
      return u.con;
  }
}

void OutputCompare::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  const int n = static_cast<int>(address - kOc) / 6;
  Unit& u = units_[static_cast<std::size_t>(n)];
  switch ((address - kOc) % 6) {
    case 0:
      u.rs = merge_lanes(u.rs, value, lanes);
      break;
    case 2:
      if (mode(u) < Pwm) u.r = merge_lanes(u.r, value, lanes);  // read-only while PWM runs
      break;
    default: {
      const int before = mode(u);
      u.con = merge_lanes(u.con, value, lanes) & static_cast<std::uint16_t>(~kOcflt);
      if (mode(u) == before) break;
      u.done = false;
      u.duty = u.r;
      if (mode(u) == Off)
        f_.ports.release(compare_pin(n), now + 1);
      else
        drive(n, mode(u) == HighToLow || (mode(u) == Toggle && u.high), now + 1);
      break;
    }
  }
  schedule(n, now);
}

Cycle OutputCompare::horizon(unsigned address, Cycle /*now*/) const {
  return (address - kOc) % 6 == 2 ? f_.events.when(units_[(address - kOc) / 6].slot) : kNever;
}

}  // namespace dspic
