// SPDX-License-Identifier: MIT
// What stands in program space: flash, unit ID, configuration words, device ID. The data
// EEPROM is periph/nvm's.
//
//   0x000000 flash, 48K words of 24 bits, 2 addresses each     0x8005C0 unit ID, 32 words
//   0xF80000 configuration, 7 words of 16 bits                 0xFF0000 device ID, revision
//
// Erased flash is all ones. Copies share their flash until one of them is written to, so a robot more costs a
// few words; on several threads, copies of one that outlives them. Source: [chip C1]; [?] DEVID.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace dspic {

inline constexpr unsigned kFlashWords = 0xC000;
inline constexpr unsigned kFlashEnd = 2 * kFlashWords;
inline constexpr unsigned kUnitIdStart = 0x8005C0, kUnitIdWords = 32;
inline constexpr unsigned kConfigurationStart = 0xF80000, kConfigurationWords = 7;
inline constexpr std::uint32_t kErasedWord = 0xFFFFFF;
inline constexpr int kFlashRowWords = 32;

class ProgramMemory {
 public:
  ProgramMemory() { unit_id_.fill(kErasedWord); }

  /// Word at an even address; 0 where nothing is. The address's lowest bit is ignored.
  std::uint32_t read(unsigned address) const;
  /// From outside, as a programmer does; false: nothing can be written there.
  bool write(unsigned address, std::uint32_t word);
  /// All of flash, until it changes.
  const std::uint32_t* flash() const { return flash_->data(); }

  // --- self-programming; addresses anywhere in the row
  void erase_row(unsigned address);
  void program_row(unsigned address, const std::array<std::uint32_t, kFlashRowWords>& latches);
  /// Counts changes of flash: whoever remembers words looks again.
  std::uint64_t version() const { return version_; }

 private:
  static unsigned row_of(unsigned address) { return address / 2 / kFlashRowWords * kFlashRowWords; }

  std::uint32_t* own_flash();

  std::shared_ptr<std::vector<std::uint32_t>> flash_ =
      std::make_shared<std::vector<std::uint32_t>>(kFlashWords, kErasedWord);
  std::array<std::uint32_t, kUnitIdWords> unit_id_;
  // as the e-puck's programs set them: XT with PLL x8, watchdog off, brown-out reset,
  // no protection [chip C17]
  std::array<std::uint16_t, kConfigurationWords> configuration_{0xFFE6, 0x7FFF, 0xFF7F, 0xFFFF,
                                                                0xFFFF, 0xFFFF, 0xFFFF};
  std::uint64_t version_ = 0;
};

}  // namespace dspic
