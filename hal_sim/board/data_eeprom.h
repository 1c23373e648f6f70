// SPDX-License-Identifier: MIT
// The processor's data EEPROM: 2048 words that survive resets. Blank (0xFFFF) at the beginning of a run, but
// for the last word, in which the maker says how the camera sits. Writing can only clear bits; erasing sets
// them. Not modelled: wear, and keeping it from one run to the next. Source: [DS70143 7.0],
// [lib: DataEEPROM.s] for how the library reaches it.
#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "hal_sim/board/first_use.h"
#include "sim_core/base/hash.h"

namespace board {

class DataEeprom {
 public:
  /// First write() or erase().
  FirstUse first_use;

  static constexpr unsigned kFirst =
      0xF000;  ///< lower half of the address; the upper one is 0x7F [DS70143 3.1]
  static constexpr unsigned kWords = 2048;
  static constexpr std::uint16_t kBlank = 0xFFFF;
  using Words = std::array<std::uint16_t, kWords>;

  /// Word at an even address 0xF000 to 0xFFFE; blank elsewhere.
  std::uint16_t read(unsigned address) const {
    if (!holds(address)) return kBlank;
    return words_ ? (*words_)[index(address)] : delivered(address);
  }
  void write(unsigned address, std::uint16_t value) { put(address, read(address) & value); }
  void erase(unsigned address) { put(address, kBlank); }
  /// What stands in the last word before anybody writes to it. Before words() and the first write.
  void set_factory_word(std::uint16_t value) { factory_ = value; }

  /// For the models of the chip, which keep count of their own changes: address kFirst + 2 i at i.
  Words& words() {
    if (!words_) {
      words_ = std::make_unique<Words>();
      words_->fill(kBlank);
      words_->back() = factory_;
    }
    return *words_;
  }

  /// As it was delivered: whoever programs the chip writes anew what the program's file holds.
  void begin_again() {
    if (!words_) return;
    words_->fill(kBlank);
    words_->back() = factory_;
  }

  /// Of the changes by write() and erase(); 0: there were none.
  std::uint64_t state_hash() const { return changes_; }

 private:
  static bool holds(unsigned address) { return address >= kFirst && address < kFirst + 2 * kWords; }
  static std::size_t index(unsigned address) { return (address - kFirst) / 2; }
  std::uint16_t delivered(unsigned address) const { return index(address) + 1 == kWords ? factory_ : kBlank; }
  static std::uint64_t hash(unsigned address, unsigned value) {
    return sim::mix64(std::uint64_t{address} << 16 | value);
  }
  void put(unsigned address, unsigned value) {
    if (!holds(address)) return;
    first_use.note();
    std::uint16_t& word = words()[index(address)];
    changes_ ^= hash(address, word) ^ hash(address, value);
    word = static_cast<std::uint16_t>(value);
  }

  std::unique_ptr<Words> words_;  // null: as it was delivered
  std::uint16_t factory_ = kBlank;
  std::uint64_t changes_ = 0;
};

}  // namespace board
