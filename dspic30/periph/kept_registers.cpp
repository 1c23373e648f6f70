// SPDX-License-Identifier: MIT
#include "dspic30/periph/kept_registers.h"

#include <algorithm>
#include <type_traits>

namespace dspic {

namespace {

constexpr unsigned kPcl = sfr("PCL"), kPch = sfr("PCH"), kSr = sfr("SR"), kCorcon = sfr("CORCON"),
                   kDisicnt = sfr("DISICNT");
constexpr SfrBits kIpl = sfr_field("SR", "IPL"), kReqop = sfr_field("C1CTRL", "REQOP"),
                  kOpmode = sfr_field("C1CTRL", "OPMODE");
constexpr std::uint16_t kIpl3 = sfr_bits("CORCON", "IPL3"), kEdt = sfr_bits("CORCON", "EDT");
constexpr Cycle kCanModeChange = 4;  // a few cycles without a bus [?]

std::uint16_t reset_value(unsigned address) {
  const SfrInfo* info = sfr_info(address);
  return info ? info->reset : 0;
}

}  // namespace

// --- the core's

void CpuRegisters::attach() { f_.bus.attach(*this, 0, kDisicnt); }

void CpuRegisters::reset() {
  for (unsigned a = 0; a < kEnd; a += 2) words_[a / 2] = reset_value(a);
}

std::uint16_t CpuRegisters::peek(unsigned address, Cycle now) const {
  const std::uint16_t word = words_[address / 2];
  const int level = f_.interrupts.cpu().level();
  switch (address) {
    case kSr:
      return static_cast<std::uint16_t>((word & ~kIpl.mask) | (level & 7) << kIpl.lowest);
    case kCorcon:
      return static_cast<std::uint16_t>((word & ~(kIpl3 | kEdt)) | (level > 7 ? kIpl3 : 0));
    case kDisicnt:
      return static_cast<std::uint16_t>(
          std::clamp<Cycle>(f_.interrupts.cpu().disi_until() - now, 0, kMostDisi));
    default:
      return word;
  }
}

void CpuRegisters::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  if (address == kPcl || address == kPch) return;
  const std::uint16_t wanted = merge_lanes(peek(address, now), value, lanes);
  words_[address / 2] = wanted;
  if (address == kSr)
    f_.interrupts.set_level(static_cast<int>(kIpl.of(wanted)) | (f_.interrupts.cpu().level() & 8), now);
  if (address == kDisicnt) f_.interrupts.disi(wanted, now);
  if (address == kCorcon && !(wanted & kIpl3) && f_.interrupts.cpu().level() > 7)
    f_.interrupts.set_level(f_.interrupts.cpu().level() & 7, now);
}

Cycle CpuRegisters::horizon(unsigned address, Cycle now) const {
  return address == kDisicnt && f_.interrupts.cpu().disi_active(now) ? now + 1 : kNever;
}

// --- plain words

void PlainRegisters::attach(unsigned first, unsigned last) { f_.bus.attach(*this, first, last); }

void PlainRegisters::reset() { words_.clear(); }

std::uint16_t PlainRegisters::word(unsigned address) const {
  const auto found = words_.find(address);
  return found == words_.end() ? reset_value(address) : found->second;
}

// --- CAN

void Can::attach() {
  f_.bus.attach(*this, base_, errors());
  for (const unsigned transmit : {sfr("C1TX0CON"), sfr("C1TX1CON"), sfr("C1TX2CON")})
    f_.bus.mark_unmodelled(base_ - kBases[0] + transmit,
                           std::integral_constant<std::uint16_t, sfr_bits("C1TX0CON", "TXREQ")>());
}

void Can::reset() {
  words_.clear();
  mode_ = next_mode_ = 4;
  mode_from_ = 0;
}

std::uint16_t Can::peek(unsigned address, Cycle now) const {
  const auto found = words_.find(address);
  const std::uint16_t word = found == words_.end() ? reset_value(address) : found->second;
  if (address != control()) return word;
  const int mode = now >= mode_from_ ? next_mode_ : mode_;
  return static_cast<std::uint16_t>((word & ~kOpmode.mask) | mode << kOpmode.lowest);
}

void Can::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  if (address == errors()) return;
  const std::uint16_t before = peek(address, now);
  words_[address] = merge_lanes(before, value, lanes);
  if (address != control()) return;
  const auto wanted = static_cast<int>(kReqop.of(words_[address]));
  if (wanted == next_mode_) return;
  mode_ = now >= mode_from_ ? next_mode_ : mode_;
  next_mode_ = wanted;
  mode_from_ = now + kCanModeChange;
}

Cycle Can::horizon(unsigned address, Cycle now) const {
  return address == control() && mode_from_ > now ? mode_from_ : kNever;
}

}  // namespace dspic
