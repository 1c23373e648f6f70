// SPDX-License-Identifier: MIT
// The register space 0x000 to 0x7FF: which peripheral owns an address, byte lanes, implemented bits.
//
// Modelled: unimplemented bits and addresses read 0 and ignore writes; byte accesses touch one lane;
// registers of a module switched off by its PMD bit read 0 and ignore writes. A bit that exists and that no
// model follows is kept and reported once by name when it is set. Not modelled: the address error of an odd
// word access (the core's). What all chips have alike is in tables; a chip has a bit a register.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "dspic30/memory/cycle.h"
#include "dspic30/memory/diagnosis.h"
#include "dspic30/memory/sfr_table.h"

namespace dspic {

/// A peripheral, seen from the bus. Addresses are even byte addresses.
class SfrOwner {
 public:
  virtual ~SfrOwner() = default;
  virtual std::uint16_t read(unsigned address, Cycle now) = 0;
  /// `lanes` 0xFFFF, 0x00FF or 0xFF00: bits that are written. Bits of `value` that do not exist are 0.
  virtual void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) = 0;
  /// read() without side effects.
  virtual std::uint16_t peek(unsigned address, Cycle now) const = 0;
  /// Until when a read gives the same value, > now.
  virtual Cycle horizon(unsigned /*address*/, Cycle /*now*/) const { return kNever; }
};

class SfrBus {
 public:
  SfrBus(Diagnostics& diagnostics, bool warn_uninitialised)
      : diagnostics_(diagnostics), warn_uninitialised_(warn_uninitialised) {}

  /// The owner answers for all registers of [first, last].
  void attach(SfrOwner& owner, unsigned first, unsigned last);
  /// These bits exist but no model follows them.
  void mark_unmodelled(unsigned address, std::uint16_t bits);
  /// Writes reach the owner with all their bits: keys of an unlock sequence.
  void take_all_bits(unsigned address) { own_slots()[address / 2] |= kAllBits; }
  /// All owners are attached: what is known of the registers is shared by all chips of which the same is
  /// known. Safe from any thread.
  void share();
  /// PMD: the registers of [first, last] are switched off or on.
  void set_disabled(unsigned first, unsigned last, bool disabled);
  /// Power-on: nothing has been written.
  void forget_writes();

  std::uint16_t read(unsigned address, unsigned bits, Cycle now) {
    if (address >= kSfrBytes) return 0;
    SfrOwner* owner = reader(address);
    if (!owner) return read_slowly(address, bits, now);
    return lane(address, bits, owner->read(address & ~1u, now));
  }

  /// Who answers a read of the word at `address` without further ado; null: read() knows.
  SfrOwner* reader(unsigned address) const {
    if (address >= kSfrBytes) return nullptr;
    const unsigned slot = slots_[address / 2];
    return slot & kSlow ? nullptr : owner_of(slot);
  }

  void write(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
    const Store store = accept(address, value, bits, now);
    if (store.owner) store.owner->write(address & ~1u, store.value, store.lanes, now);
  }

  /// The bus's half of write(); whoever calls it gives the rest to the owner. No owner: nothing to do.
  struct Store {
    SfrOwner* owner;
    std::uint16_t value, lanes;
  };
  /// accept() of a word at an even address that reader() has an owner for, and of which all bits are
  /// modelled: the bits that exist.
  std::uint16_t accept_plain(unsigned address, std::uint16_t value) {
    ++writes_;
    if (!was_written(address)) note_written(address);
    return value & implemented(slots_[address / 2], address);
  }
  /// Is nothing told of it when a register that was written takes this value?
  bool keeps(unsigned address, std::uint16_t value) const {
    const unsigned u = slots_[address / 2] >> kUnmodelledShift;
    return u == 0 || !(value & unmodelled_[u - 1]);
  }
  /// Since power-on; or it was told that it is read before.
  bool was_written(unsigned address) const {
    return (is_written_[address / 128] >> (address / 2 & 63) & 1) != 0;
  }
  void count_write() { ++writes_; }
  Store accept(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
    ++writes_;
    if (address >= kSfrBytes) return {nullptr, 0, 0};
    const unsigned slot = slots_[address / 2];
    SfrOwner* const owner = owner_of(slot);
    if (!owner) {
      warn_of_hole(address, now);
      return {nullptr, 0, 0};
    }
    if (slot & kDisabled) return {nullptr, 0, 0};
    std::uint16_t lanes = 0xFFFF;
    if (bits <= 8) {
      lanes = (address & 1) ? 0xFF00 : 0x00FF;
      value = static_cast<std::uint16_t>((address & 1) ? value << 8 : value & 0xFF);
    }
    if (!was_written(address)) note_written(address);
    value &= implemented(slot, address);
    if (const unsigned u = slot >> kUnmodelledShift; u > 0 && (value & unmodelled_[u - 1]))
      warn(address, value, now);
    return {owner, value, lanes};
  }

  std::uint16_t peek(unsigned address, Cycle now) const;
  Cycle horizon(unsigned address, Cycle now) const;
  /// Addresses of registers that were written since power-on, in the order of their first write.
  const std::vector<std::uint16_t>& written() const { return written_; }
  /// Writes so far: two writes are consecutive when this differs by one. Those that the core keeps to itself
  /// (Cpu::saved_register()) do not count.
  std::int64_t writes() const { return writes_; }

 private:
  static std::uint16_t lane(unsigned address, unsigned bits, std::uint16_t word) {
    if (bits > 8) return word;
    return (address & 1) ? word >> 8 : word & 0xFF;
  }
  // of a register: its owner's number from 1 on, 0 for nobody; what else is known of it; and from
  // kUnmodelledShift on, the number of its bits in unmodelled_ from 1 on, 0 for none
  using Slot = std::uint16_t;
  static constexpr std::size_t kMostOwners = 32, kMostUnmodelled = 63;
  static constexpr unsigned kOwner = 0x1F, kDisabled = 0x20,
                            kAllBits = 0x80,  // take_all_bits()
      kSlow = 0x100;                          // a read is more than its owner's answer
  static constexpr int kUnmodelledShift = 10;
  SfrOwner* owner_of(unsigned slot) const { return owners_[slot & kOwner]; }
  static std::uint16_t implemented(unsigned slot, unsigned address) {
    return slot & kAllBits ? std::uint16_t{0xFFFF} : kSfrImplemented[address / 2];
  }
  __attribute__((noinline)) void warn(unsigned address, std::uint16_t value, Cycle now);
  std::uint16_t read_slowly(unsigned address, unsigned bits, Cycle now);
  __attribute__((noinline)) void note_written(unsigned address);
  void warn_of_hole(unsigned address, Cycle now);

  using Slots = std::array<Slot, kSfrBytes / 2>;
  /// To be changed: no other chip's.
  Slots& own_slots();

  Diagnostics& diagnostics_;
  bool warn_uninitialised_;
  std::unique_ptr<Slots> own_ = std::make_unique<Slots>();  // null: shared
  const Slot* slots_ = own_->data();
  std::array<std::uint64_t, kSfrBytes / 128> is_written_{};  // a bit a register
  std::array<SfrOwner*, kMostOwners> owners_{};
  std::vector<std::uint16_t> unmodelled_;  // and not reported yet
  std::vector<std::uint16_t> written_;
  std::int64_t writes_ = 0;  // last: the events' next instant, which is looked at as often, lies behind it
};

}  // namespace dspic
