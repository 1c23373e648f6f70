// SPDX-License-Identifier: MIT
// The processor's data EEPROM: 2048 words that survive resets. Blank (0xFFFF) at the beginning of a run, but
// for the last word, in which the maker says how the camera sits. Writing can only clear bits; erasing sets
// them. Not modelled: wear, and keeping it from one run to the next. Source: [DS70143 7.0], [lib:
// DataEEPROM.s] for how the library reaches it.
#pragma once
#include <cstdint>
#include <map>

#include "sim_core/base/hash.h"

namespace board {

class DataEeprom {
 public:
  static constexpr unsigned kFirst =
      0xF000;  ///< lower half of the address; the upper one is 0x7F [DS70143 3.1]
  static constexpr unsigned kWords = 2048;
  static constexpr unsigned kFactoryWord = 0xFFFE;
  static constexpr std::uint16_t kBlank = 0xFFFF;

  /// Word at an even address 0xF000 to 0xFFFE.
  std::uint16_t read(unsigned address) const {
    const auto found = words_.find(address);
    return found != words_.end() ? found->second : address == kFactoryWord ? factory_ : kBlank;
  }
  void write(unsigned address, std::uint16_t value) {
    words_[address] = static_cast<std::uint16_t>(read(address) & value);
  }
  void erase(unsigned address) {
    words_.erase(address);
    if (read(address) != kBlank) words_[address] = kBlank;
  }
  /// What stands in the last word before anybody writes to it.
  void set_factory_word(std::uint16_t value) { factory_ = value; }

  /// False as long as every word is as it was delivered.
  bool in_use() const { return !words_.empty(); }
  std::uint64_t state_hash() const {
    std::uint64_t hash = 0;
    for (const auto& [address, value] : words_) hash = sim::mix64(hash ^ (address << 16 | value));
    return hash;
  }

 private:
  std::map<unsigned, std::uint16_t> words_;
  std::uint16_t factory_ = kBlank;
};

}  // namespace board
