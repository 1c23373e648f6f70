// SPDX-License-Identifier: MIT
// The register space 0x000 to 0x7FF: which peripheral owns an address, byte lanes, implemented bits.
//
// Modelled: unimplemented bits and addresses read 0 and ignore writes; byte accesses touch one lane;
// registers of a module switched off by its PMD bit read 0 and ignore writes. A bit that exists and that no
// model follows is kept and reported once by name when it is set. Not modelled: the address error of an odd
// word access (the core's).
#pragma once
#include <array>
#include <cstdint>
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
  virtual Cycle horizon(unsigned address, Cycle now) const { return kNever; }
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
  void take_all_bits(unsigned address) { slots_[address / 2].implemented = 0xFFFF; }
  /// PMD: the registers of [first, last] are switched off or on.
  void set_disabled(unsigned first, unsigned last, bool disabled);
  /// Power-on: nothing has been written.
  void forget_writes();

  std::uint16_t read(unsigned address, unsigned bits, Cycle now) {
    if (address >= kSfrBytes) return 0;
    SfrOwner* owner = readers_[address / 2];
    if (!owner) return read_slowly(address, bits, now);
    return lane(address, bits, owner->read(address & ~1u, now));
  }

  /// Who answers a read of the word at `address` without further ado; null: read() knows.
  SfrOwner* reader(unsigned address) const { return address < kSfrBytes ? readers_[address / 2] : nullptr; }

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
    Slot& slot = slots_[address / 2];
    if (!slot.is_written) note_written(slot);
    return value & slot.implemented;
  }
  /// accept_plain() of a word that was written before, and whose bits are in order already.
  bool was_written(unsigned address) const { return slots_[address / 2].is_written; }
  void count_write() { ++writes_; }
  Store accept(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
    ++writes_;
    if (address >= kSfrBytes) return {nullptr, 0, 0};
    Slot& slot = slots_[address / 2];
    if (!slot.owner) {
      warn_of_hole(address, now);
      return {nullptr, 0, 0};
    }
    if (slot.disabled) return {nullptr, 0, 0};
    std::uint16_t lanes = 0xFFFF;
    if (bits <= 8) {
      lanes = (address & 1) ? 0xFF00 : 0x00FF;
      value = static_cast<std::uint16_t>((address & 1) ? value << 8 : value & 0xFF);
    }
    if (!slot.is_written) note_written(slot);
    value &= slot.implemented;
    if (value & slot.unmodelled) warn(slot, value & slot.unmodelled, now);
    return {slot.owner, value, lanes};
  }

  std::uint16_t peek(unsigned address, Cycle now) const;
  Cycle horizon(unsigned address, Cycle now) const;
  /// Registers that were written since power-on, in the order of their first write.
  const std::vector<const SfrInfo*>& written() const { return written_; }
  /// Writes so far: two writes are consecutive when this differs by one. Those that the core keeps to itself
  /// (Cpu::saved_register()) do not count.
  std::int64_t writes() const { return writes_; }

 private:
  static std::uint16_t lane(unsigned address, unsigned bits, std::uint16_t word) {
    if (bits > 8) return word;
    return (address & 1) ? word >> 8 : word & 0xFF;
  }
  struct Slot {
    SfrOwner* owner = nullptr;
    const SfrInfo* info = nullptr;
    std::uint16_t implemented = 0;
    std::uint16_t unmodelled = 0;  // and not reported yet
    bool disabled = false;
    bool is_written = false;  // since power-on; or it was told that it is read before
  };
  void warn(Slot& slot, std::uint16_t bits, Cycle now);
  std::uint16_t read_slowly(unsigned address, unsigned bits, Cycle now);
  __attribute__((noinline)) void note_written(Slot& slot);
  void find_reader(unsigned address);
  void warn_of_hole(unsigned address, Cycle now);

  Diagnostics& diagnostics_;
  bool warn_uninitialised_;
  std::array<Slot, kSfrBytes / 2> slots_{};
  std::array<SfrOwner*, kSfrBytes / 2> readers_{};  // the owner where a word is read without further ado
  std::int64_t writes_ = 0;
  std::vector<const SfrInfo*> written_;
};

}  // namespace dspic
