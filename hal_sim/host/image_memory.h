// SPDX-License-Identifier: MIT
// A firmware image in memory, put there by ourselves and not by the dynamic linker: at an address of our
// choosing (address_slot.h), with nothing around it that an index could reach, with nothing of it run on the
// way, and each segment accessible as its flags say and no more.
//
//   slot: | nothing | constants r | code rx | tables r | budget rw | nothing | data rw | nothing ... 4 GB |
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/host/address_slot.h"

namespace host {

class ImageMemory {
 public:
  /// `file`: a shared object's bytes, checked by its stamp. What it needs comes from this executable and its
  /// libraries. On failure null, and `error` says what was found.
  static std::unique_ptr<ImageMemory> load(const std::string& file, const std::string& path,
                                           std::string& error);
  ~ImageMemory();
  ImageMemory(const ImageMemory&) = delete;
  ImageMemory& operator=(const ImageMemory&) = delete;

  /// Address of an exported name; null when there is none.
  void* symbol(const char* name) const;
  /// Address in the file = address in memory - base().
  std::uintptr_t base() const { return slot_.begin(); }
  bool is_code(std::uintptr_t address) const { return address >= code_begin_ && address < code_end_; }
  std::uintptr_t code_begin() const { return code_begin_; }
  std::uintptr_t code_end() const { return code_end_; }
  /// Anywhere in the addresses that belong to this copy.
  bool holds(std::uintptr_t address) const { return slot_.holds(address); }

 private:
  explicit ImageMemory(std::size_t bytes);
  bool fill(const std::string& file, std::string& error);

  AddressSlot slot_;
  struct Export {
    std::string name;
    std::uintptr_t address;
  };
  std::vector<Export> exports_;
  std::uintptr_t code_begin_ = 0, code_end_ = 0;
};

}  // namespace host
