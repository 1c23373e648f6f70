// SPDX-License-Identifier: MIT
#include "dspic30/periph/spi.h"

#include <type_traits>

namespace dspic {

namespace {

constexpr unsigned kStat = 0, kCon = 2;
constexpr std::uint16_t kSpien = sfr_bits("SPI1STAT", "SPIEN"), kSpisidl = sfr_bits("SPI1STAT", "SPISIDL"),
                        kSpirov = sfr_bits("SPI1STAT", "SPIROV"), kSpitbf = sfr_bits("SPI1STAT", "SPITBF"),
                        kSpirbf = sfr_bits("SPI1STAT", "SPIRBF"), kMsten = sfr_bits("SPI1CON", "MSTEN"),
                        kDissdo = sfr_bits("SPI1CON", "DISSDO"), kCkp = sfr_bits("SPI1CON", "CKP");
constexpr SfrBits kPpre = sfr_field("SPI1CON", "PPRE"), kSpre = sfr_field("SPI1CON", "SPRE");
constexpr Cycle kPrimary[] = {64, 16, 4, 1};

}  // namespace

void Spi::attach() {
  f_.bus.attach(*this, base_, base_ + 4);
  f_.bus.mark_unmodelled(base_ + kStat, kSpisidl);
  f_.bus.mark_unmodelled(
      base_ + kCon, std::integral_constant<std::uint16_t, sfr_bits("SPI1CON", "FRMEN", "SPIFSD", "SSEN")>());
  slot_ = f_.events.add(*this, 0, std::uint64_t{1} << (number_ == 1 ? irq::Spi1 : irq::Spi2), false, true);
}

void Spi::reset(Cycle /*now*/) {
  stat_ = con_ = waiting_ = shifting_ = received_ = 0;
  has_waiting_ = is_shifting_ = false;
  f_.events.set(slot_, kNever);
}

Cycle Spi::clock() const { return (8 - Cycle{kSpre.of(con_)}) * kPrimary[kPpre.of(con_)]; }

void Spi::start(Cycle now) {
  if (!on() || !(con_ & kMsten) || is_shifting_ || !has_waiting_) return;
  shifting_ = waiting_;
  has_waiting_ = false;
  is_shifting_ = true;
  f_.events.set(slot_, now + 1 + bits() * clock());
}

void Spi::on_event(int /*id*/, Cycle at) {
  const auto mask = static_cast<std::uint16_t>(bits() == 16 ? 0xFFFF : 0xFF);
  const std::uint16_t word = f_.outside.spi_word(number_, shifting_ & mask, bits(), at) & mask;
  if (stat_ & kSpirbf)
    stat_ |= kSpirov;
  else
    received_ = word;
  stat_ |= kSpirbf;
  is_shifting_ = false;
  f_.interrupts.raise(number_ == 1 ? irq::Spi1 : irq::Spi2, at);
  start(at);
}

std::uint16_t Spi::read(unsigned address, Cycle now) {
  const std::uint16_t word = peek(address, now);
  if (address - base_ > kCon) stat_ &= static_cast<std::uint16_t>(~kSpirbf);
  return word;
}

std::uint16_t Spi::peek(unsigned address, Cycle /*now*/) const {
  switch (address - base_) {
    case kStat:
      return static_cast<std::uint16_t>(stat_ | (has_waiting_ ? kSpitbf : 0));
    case kCon:
      return con_;
    default:
      return received_;
  }
}

void Spi::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  switch (address - base_) {
    case kStat: {
      const std::uint16_t wanted = merge_lanes(stat_, value, lanes);
      stat_ = static_cast<std::uint16_t>((wanted & (kSpien | kSpisidl)) | (stat_ & wanted & kSpirov) |
                                         (stat_ & kSpirbf));
      if (!on()) {
        stat_ &= kSpisidl;
        has_waiting_ = is_shifting_ = false;
        f_.events.set(slot_, kNever);
      }
      break;
    }
    case kCon:
      con_ = merge_lanes(con_, value, lanes);
      break;
    default:
      if (!on()) break;
      waiting_ = merge_lanes(waiting_, value, lanes);
      has_waiting_ = true;
      start(now);
      break;
  }
  // SDI, SDO, SCK of each module
  const Pin in = number_ == 1 ? Pin{Port::F, 7} : Pin{Port::G, 7};
  const Pin out = number_ == 1 ? Pin{Port::F, 8} : Pin{Port::G, 8};
  const Pin clock_pin = number_ == 1 ? Pin{Port::F, 6} : Pin{Port::G, 6};
  if (address - base_ > kCon) return;
  // Its pins are its own while it is on.
  if (on()) {
    f_.ports.own_input(in, now + 1);
    if (con_ & kDissdo)
      f_.ports.release(out, now + 1);
    else
      f_.ports.own_output(out, false, now + 1);
    if (con_ & kMsten)
      f_.ports.own_output(clock_pin, (con_ & kCkp) != 0, now + 1);
    else
      f_.ports.own_input(clock_pin, now + 1);
  } else {
    for (const Pin pin : {in, out, clock_pin}) f_.ports.release(pin, now + 1);
  }
}

Cycle Spi::horizon(unsigned address, Cycle /*now*/) const {
  return address - base_ == kCon ? kNever : f_.events.when(slot_);
}

}  // namespace dspic
