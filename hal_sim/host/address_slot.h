// SPDX-License-Identifier: MIT
// Memory of firmware lies at the same place in every run, as far as a program can tell. Each gets a stretch
// of addresses for itself and lies at the same offset in it; what an index runs into beyond its memory is
// nothing.
//
//   images   4 GB apart: the lower 32 bits of an address are the same in every copy of an image
//   stacks   4 MB apart: the lower 22 bits are the same for every robot. All robots take their turns, and the
//            processor finds memory that lies close together sooner (its tables of pages are read less often)
//
// An `int` and a `short` of the chip have 16 bits, so an index of theirs stays within the stretch.
#pragma once
#include <cstddef>
#include <cstdint>

namespace host {

class AddressSlot {
 public:
  enum class Kind : std::uint8_t { Image, Stack };

  /// Takes a free slot and reserves `bytes` at `offset` in it; nothing may be accessed until mprotect()
  /// allows it. Where the system has no room there, somewhere else.
  AddressSlot(Kind kind, std::size_t offset, std::size_t bytes);
  ~AddressSlot();
  AddressSlot(const AddressSlot&) = delete;
  AddressSlot& operator=(const AddressSlot&) = delete;

  std::uintptr_t begin() const { return begin_; }
  std::size_t bytes() const { return bytes_; }
  /// In the slot, whether reserved or not.
  bool holds(std::uintptr_t address) const { return address >= first_ && address < end_; }

 private:
  Kind kind_;
  std::uintptr_t begin_ = 0, first_ = 0, end_ = 0;
  std::size_t bytes_;
  int number_ = -1;
};

}  // namespace host
