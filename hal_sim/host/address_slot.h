// SPDX-License-Identifier: MIT
// Memory of firmware lies at the same place in every run, for every robot and every copy of an image, as far
// as a program can tell: each gets 4 GB of addresses for itself and lies at the same offset in them, so the
// lower 32 bits of an address are always the same. What an index runs into beyond its memory is nothing.
#pragma once
#include <cstddef>
#include <cstdint>

namespace host {

class AddressSlot {
 public:
  /// Takes a free slot and reserves `bytes` at `offset` in it; nothing may be accessed until mprotect()
  /// allows it. Where the system has no room there, somewhere else.
  AddressSlot(std::size_t offset, std::size_t bytes);
  ~AddressSlot();
  AddressSlot(const AddressSlot&) = delete;
  AddressSlot& operator=(const AddressSlot&) = delete;

  std::uintptr_t begin() const { return begin_; }
  std::size_t bytes() const { return bytes_; }
  /// In the slot, whether reserved or not.
  bool holds(std::uintptr_t address) const { return address >= first_ && address < end_; }

 private:
  std::uintptr_t begin_ = 0, first_ = 0, end_ = 0;
  std::size_t bytes_;
  int number_ = -1;
};

}  // namespace host
