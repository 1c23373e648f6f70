// SPDX-License-Identifier: MIT
// Self-programming: NVMCON, NVMADR, NVMADRU, NVMKEY, and the data EEPROM.
//
//   TBLWT -> latches, NVMADR --> NVMCON = operation, WREN --> NVMKEY = 0x55, 0xAA --> WR = 1
//   WR = 1 --2 ms--> WR = 0, NVMIF
//
// Modelled: erase and write of one EEPROM word or row, erase of all, programming that only clears bits, the
// unlock sequence (the two keys and WR, no other register written in between), WR held while busy, a second
// operation refused; erase and write of a row of flash, which hold the processor; a configuration word. Not
// modelled: WRERR by a reset in between beyond setting it, code protection, wear. Source: [chip C18];
// [?] 2 ms for each operation.
#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "dspic30/memory/program_memory.h"
#include "dspic30/periph/fabric.h"

namespace dspic {

/// Words of the data EEPROM, and the program address of the first; words are 2 apart.
inline constexpr int kEepromWordCount = 2048;
inline constexpr unsigned kEepromStart = 0x7FF000;
using Eeprom = std::array<std::uint16_t, kEepromWordCount>;

/// Where the words of the EEPROM are kept. Programs seldom write any, so there may be none to keep.
class EepromMemory {
 public:
  virtual ~EepromMemory() = default;
  virtual std::uint16_t read(int word) const = 0;
  virtual Eeprom& words() = 0;  ///< to be written
};

/// Blank at first.
class OwnEeprom final : public EepromMemory {
 public:
  std::uint16_t read(int word) const override {
    return words_ ? (*words_)[static_cast<std::size_t>(word)] : kBlank;
  }
  Eeprom& words() override {
    if (!words_) {
      words_ = std::make_unique<Eeprom>();
      words_->fill(kBlank);
    }
    return *words_;
  }

 private:
  static constexpr std::uint16_t kBlank = 0xFFFF;
  std::unique_ptr<Eeprom> words_;
};

class Nvm final : public SfrOwner, public EventOwner {
 public:
  /// `eeprom` and `program` outlive this; no program: operations on flash only take their time.
  Nvm(const Fabric& fabric, EepromMemory& eeprom, ProgramMemory* program)
      : f_(fabric), eeprom_(eeprom), program_(program) {}
  void attach();
  void reset(Cycle now);
  std::uint16_t table_read(unsigned program_address) const;
  /// Loads the latch of that word: the bits of `lanes`, of 24.
  void table_write(unsigned program_address, std::uint32_t value, std::uint32_t lanes = 0xFFFF);
  Eeprom& eeprom() { return eeprom_.words(); }
  /// Of the EEPROM after the last operation; 0: there was none.
  std::uint64_t eeprom_hash() const { return eeprom_hash_; }
  /// A flash operation holds the processor until here.
  Cycle stalled_until() const { return stalled_until_; }
  Cycle operation_cycles() const;

  std::uint16_t read(unsigned address, Cycle now) override { return peek(address, now); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;

 private:
  static constexpr int kRowWords = 16;
  static bool in_eeprom(unsigned address) {
    return address >= kEepromStart && address < kEepromStart + 2 * kEepromWordCount;
  }
  unsigned address() const { return std::uint32_t{adru_} << 16 | adr_; }
  int word_index() const;
  void carry_out_on_flash(int operation);
  void begin(Cycle now);

  const Fabric& f_;
  int slot_ = -1;
  unsigned operation_at_ = 0;  // address of the operation under way
  std::uint16_t con_ = 0, adr_ = 0, adru_ = 0;
  std::array<std::uint32_t, kFlashRowWords> latches_{};
  int key_step_ = 0;
  std::int64_t key_write_ = 0;
  Cycle stalled_until_ = 0;
  EepromMemory& eeprom_;
  std::uint64_t eeprom_hash_ = 0;
  ProgramMemory* program_;
};

}  // namespace dspic
