// SPDX-License-Identifier: MIT
#include "dspic30/memory/sfr_bus.h"

#include <string>

#include "dspic30/memory/hex.h"

namespace dspic {

void SfrBus::attach(SfrOwner& owner, unsigned first, unsigned last) {
  for (unsigned a = first; a <= last; a += 2) {
    const SfrInfo* info = sfr_info(a);
    if (info) slots_[a / 2] = {&owner, info, info->implemented, 0, false, false};
    find_reader(a);
  }
}

void SfrBus::find_reader(unsigned address) {
  const Slot& slot = slots_[address / 2];
  readers_[address / 2] = slot.disabled || warn_uninitialised_ ? nullptr : slot.owner;
}

void SfrBus::mark_unmodelled(unsigned address, std::uint16_t bits) { slots_[address / 2].unmodelled |= bits; }

void SfrBus::set_disabled(unsigned first, unsigned last, bool disabled) {
  for (unsigned a = first; a <= last; a += 2) {
    slots_[a / 2].disabled = disabled;
    find_reader(a);
  }
}

void SfrBus::note_written(Slot& slot) {
  slot.is_written = true;
  written_.push_back(slot.info);
}

void SfrBus::forget_writes() {
  for (Slot& slot : slots_) slot.is_written = false;
  written_.clear();
}

// nothing, or perhaps the first read of a register that holds anything
std::uint16_t SfrBus::read_slowly(unsigned address, unsigned bits, Cycle now) {
  Slot& slot = slots_[address / 2];
  if (!slot.owner || slot.disabled) return 0;
  if (warn_uninitialised_ && !slot.is_written && !slot.info->defined) {
    note_written(slot);
    diagnostics_.report(Cause::UninitialisedRead, slot.info->name,
                        std::string(slot.info->name) +
                            " is read before it was written; after power-on it holds anything (here 0)",
                        now);
  }
  return lane(address, bits, slot.owner->read(address & ~1u, now));
}

void SfrBus::warn_of_hole(unsigned address, Cycle now) {
  diagnostics_.report(Cause::UnimplementedAddress, hex(address, 4),
                      hex(address, 4) + ": no register of this chip; the write is ignored", now);
}

void SfrBus::warn(Slot& slot, std::uint16_t bits, Cycle now) {
  slot.unmodelled &= static_cast<std::uint16_t>(~bits);
  for (int bit = 0; bit < 16; ++bit) {
    if (!(bits >> bit & 1)) continue;
    const std::string name = sfr_bit_name(*slot.info, bit);
    diagnostics_.report(Cause::UnmodelledBit, name, name + ": not modelled; the bit is kept and does nothing",
                        now);
  }
}

std::uint16_t SfrBus::peek(unsigned address, Cycle now) const {
  if (address >= kSfrBytes) return 0;
  const Slot& slot = slots_[address / 2];
  return slot.owner && !slot.disabled ? slot.owner->peek(address & ~1u, now) : 0;
}

Cycle SfrBus::horizon(unsigned address, Cycle now) const {
  if (address >= kSfrBytes) return kNever;
  const Slot& slot = slots_[address / 2];
  return slot.owner && !slot.disabled ? slot.owner->horizon(address & ~1u, now) : kNever;
}

}  // namespace dspic
