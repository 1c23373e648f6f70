// SPDX-License-Identifier: MIT
#include "dspic30/memory/sfr_bus.h"

#include <algorithm>
#include <cstdlib>
#include <list>
#include <mutex>
#include <string>

#include "dspic30/memory/hex.h"

namespace dspic {

SfrBus::Slots& SfrBus::own_slots() {
  if (!own_) {
    own_ = std::make_unique<Slots>();
    std::copy_n(slots_, own_->size(), own_->begin());
    slots_ = own_->data();
  }
  return *own_;
}

void SfrBus::share() {
  if (!own_) return;
  static std::mutex mutex;
  // few: they depend on what is attached and warned of. Never freed, for a chip may outlive all else
  static auto& known = *new std::list<Slots>;
  const std::lock_guard lock(mutex);
  auto same = std::find(known.begin(), known.end(), *own_);
  if (same == known.end()) same = known.insert(same, *own_);
  slots_ = same->data();
  own_.reset();
}

void SfrBus::attach(SfrOwner& owner, unsigned first, unsigned last) {
  // nobody has number 0
  const auto own =
      std::find_if(owners_.begin() + 1, owners_.end(), [&](const SfrOwner* o) { return !o || o == &owner; });
  if (own == owners_.end()) std::abort();
  *own = &owner;
  const auto number = static_cast<unsigned>(own - owners_.begin());
  Slots& slots = own_slots();
  for (unsigned a = first; a <= last; a += 2)
    if (sfr_info(a)) slots[a / 2] = static_cast<Slot>(number | (warn_uninitialised_ ? kSlow : 0));
}

void SfrBus::mark_unmodelled(unsigned address, std::uint16_t bits) {
  if (bits == 0) return;
  Slot& slot = own_slots()[address / 2];
  if (slot >> kUnmodelledShift == 0) {
    unmodelled_.push_back(0);
    if (unmodelled_.size() > kMostUnmodelled) std::abort();
    slot |= static_cast<Slot>(unmodelled_.size() << kUnmodelledShift);
  }
  unmodelled_[(slot >> kUnmodelledShift) - 1u] |= bits;
}

void SfrBus::set_disabled(unsigned first, unsigned last, bool disabled) {
  const unsigned slow = kDisabled | (warn_uninitialised_ ? 0 : kSlow);
  const auto changed = [&](Slot slot) { return static_cast<Slot>(disabled ? slot | slow : slot & ~slow); };
  for (unsigned a = first; a <= last; a += 2)
    if (changed(slots_[a / 2]) != slots_[a / 2]) own_slots()[a / 2] = changed(slots_[a / 2]);
}

void SfrBus::note_written(unsigned address) {
  is_written_[address / 128] |= std::uint64_t{1} << (address / 2 & 63);
  written_.push_back(static_cast<std::uint16_t>(address & ~1u));
}

void SfrBus::forget_writes() {
  is_written_.fill(0);
  written_.clear();
}

// nothing, or perhaps the first read of a register that holds anything
std::uint16_t SfrBus::read_slowly(unsigned address, unsigned bits, Cycle now) {
  const unsigned slot = slots_[address / 2];
  SfrOwner* const owner = owner_of(slot);
  if (!owner || (slot & kDisabled)) return 0;
  const SfrInfo& info = *sfr_info(address);
  if (warn_uninitialised_ && !was_written(address) && !info.defined) {
    note_written(address);
    diagnostics_.report(
        Cause::UninitialisedRead, info.name,
        std::string(info.name) + " is read before it was written; after power-on it holds anything (here 0)",
        now);
  }
  return lane(address, bits, owner->read(address & ~1u, now));
}

void SfrBus::warn_of_hole(unsigned address, Cycle now) {
  diagnostics_.report(Cause::UnimplementedAddress, hex(address, 4),
                      hex(address, 4) + ": no register of this chip; the write is ignored", now);
}

void SfrBus::warn(unsigned address, std::uint16_t value, Cycle now) {
  std::uint16_t& unmodelled = unmodelled_[(slots_[address / 2] >> kUnmodelledShift) - 1u];
  const unsigned bits = value & unmodelled;
  unmodelled &= static_cast<std::uint16_t>(~bits);
  for (int bit = 0; bit < 16; ++bit) {
    if (!(bits >> bit & 1)) continue;
    const std::string name = sfr_bit_name(*sfr_info(address), bit);
    diagnostics_.report(Cause::UnmodelledBit, name, name + ": not modelled; the bit is kept and does nothing",
                        now);
  }
}

std::uint16_t SfrBus::peek(unsigned address, Cycle now) const {
  if (address >= kSfrBytes) return 0;
  const unsigned slot = slots_[address / 2];
  const SfrOwner* const owner = owner_of(slot);
  return owner && !(slot & kDisabled) ? owner->peek(address & ~1u, now) : 0;
}

Cycle SfrBus::horizon(unsigned address, Cycle now) const {
  if (address >= kSfrBytes) return kNever;
  const unsigned slot = slots_[address / 2];
  const SfrOwner* const owner = owner_of(slot);
  return owner && !(slot & kDisabled) ? owner->horizon(address & ~1u, now) : kNever;
}

}  // namespace dspic
