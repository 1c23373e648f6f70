// SPDX-License-Identifier: MIT
#include "dspic30/periph/nvm.h"

#include <cmath>

#include "dspic30/memory/state_hash.h"

namespace dspic {

namespace {

constexpr unsigned kCon = sfr("NVMCON"), kAdr = sfr("NVMADR"), kAdru = sfr("NVMADRU"), kKey = sfr("NVMKEY");
constexpr std::uint16_t kWr = sfr_bits("NVMCON", "WR"), kWren = sfr_bits("NVMCON", "WREN"),
                        kWrerr = sfr_bits("NVMCON", "WRERR");
constexpr SfrBits kProgop = sfr_field("NVMCON", "PROGOP");
constexpr int kEraseWord = 0x44, kEraseRow = 0x45, kEraseAll = 0x46, kWriteWord = 0x04, kWriteRow = 0x05;
constexpr int kEraseFlashRow = 0x41, kWriteFlashRow = 0x01, kWriteConfiguration = 0x08;
constexpr double kOperationSeconds = 0.002;  // [?] 0.8 to 2.6 ms

}  // namespace

void Nvm::attach() {
  f_.bus.attach(*this, kCon, kKey);
  slot_ = f_.events.add(*this, 0, std::uint64_t{1} << irq::Nvm, false);
}

void Nvm::reset(Cycle /*now*/) {
  const bool interrupted = (con_ & kWr) != 0;
  con_ = interrupted ? kWrerr : 0;
  adr_ = adru_ = 0;
  latches_.fill(kErasedWord);
  key_step_ = 0;
  stalled_until_ = 0;
  f_.events.set(slot_, kNever);
}

Cycle Nvm::operation_cycles() const {
  return static_cast<Cycle>(std::llround(kOperationSeconds * f_.fcy_hz));
}

int Nvm::word_index() const {
  return in_eeprom(operation_at_) ? static_cast<int>(operation_at_ - kEepromStart) / 2 : -1;
}

std::uint16_t Nvm::table_read(unsigned program_address) const {
  return in_eeprom(program_address) ? eeprom_.read(static_cast<int>(program_address - kEepromStart) / 2) : 0;
}

void Nvm::table_write(unsigned program_address, std::uint32_t value, std::uint32_t lanes) {
  adr_ = static_cast<std::uint16_t>(program_address & 0xFFFE);
  adru_ = static_cast<std::uint16_t>(program_address >> 16 & 0xFF);
  std::uint32_t& latch = latches_[(program_address / 2) % kFlashRowWords];
  latch = (latch & ~lanes) | (value & lanes);
}

void Nvm::begin(Cycle now) {
  if (!(con_ & kWren)) return;
  con_ = static_cast<std::uint16_t>((con_ | kWr) & ~kWrerr);
  operation_at_ = address();
  const Cycle end = now + operation_cycles();
  const auto operation = static_cast<int>(kProgop.of(con_));
  const bool on_eeprom = operation == kEraseWord || operation == kEraseRow || operation == kEraseAll ||
                         operation == kWriteWord || operation == kWriteRow;
  if (!on_eeprom) stalled_until_ = end;
  f_.events.set(slot_, end);
}

void Nvm::on_event(int /*id*/, Cycle at) {
  Eeprom& words = eeprom_.words();
  const int word = word_index();
  const int row = word < 0 ? -1 : word - word % kRowWords;
  switch (kProgop.of(con_)) {
    case kEraseAll:
      words.fill(0xFFFF);
      break;
    case kEraseWord:
      if (word >= 0) words[static_cast<std::size_t>(word)] = 0xFFFF;
      break;
    case kEraseRow:
      for (int i = 0; row >= 0 && i < kRowWords; ++i) words[static_cast<std::size_t>(row + i)] = 0xFFFF;
      break;
    case kWriteWord:
      if (word >= 0)
        words[static_cast<std::size_t>(word)] &=
            static_cast<std::uint16_t>(latches_[operation_at_ / 2 % kFlashRowWords]);
      break;
    case kWriteRow:
      for (int i = 0; row >= 0 && i < kRowWords; ++i)
        words[static_cast<std::size_t>(row + i)] &= static_cast<std::uint16_t>(
            latches_[(kEepromStart / 2 + static_cast<unsigned>(row + i)) % kFlashRowWords]);
      break;
    default:
      if (program_) carry_out_on_flash(static_cast<int>(kProgop.of(con_)));
  }
  // It is over: the latches are empty again.
  eeprom_hash_ = hash_of_memory(words.data(), sizeof words);
  latches_.fill(kErasedWord);
  con_ &= static_cast<std::uint16_t>(~kWr);
  f_.interrupts.raise(irq::Nvm, at);
}

void Nvm::carry_out_on_flash(int operation) {
  if (operation == kEraseFlashRow) program_->erase_row(operation_at_);
  if (operation == kWriteFlashRow) program_->program_row(operation_at_, latches_);
  if (operation == kWriteConfiguration && operation_at_ >= kConfigurationStart)
    program_->write(operation_at_, latches_[operation_at_ / 2 % kFlashRowWords]);
}

std::uint16_t Nvm::peek(unsigned address, Cycle /*now*/) const {
  switch (address) {
    case kCon:
      return con_;
    case kAdr:
      return adr_;
    case kAdru:
      return adru_;
    default:
      return 0;  // NVMKEY is write-only
  }
}

void Nvm::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  // Was the register before this one written straight before, with nothing in between?
  const bool follows = key_write_ + 1 == f_.bus.writes();
  const bool busy = (con_ & kWr) != 0;
  switch (address) {
    case kKey: {
      const int key = value & 0xFF;
      key_step_ = key == 0x55 ? 1 : (key == 0xAA && key_step_ == 1 && follows) ? 2 : 0;
      key_write_ = f_.bus.writes();
      break;
    }
    case kCon: {
      if (busy) {  // registers are locked while an operation runs
        f_.diagnostics.report(
            Cause::NvmBusy, "NVMCON.WR",
            "NVMCON is written while an operation runs (WR is 1): the new one does not happen", now);
        break;
      }
      const std::uint16_t wanted = merge_lanes(con_, value, lanes);
      con_ = static_cast<std::uint16_t>(wanted & ~kWr);
      if (!(wanted & kWr)) break;
      if (key_step_ == 2 && follows) {
        begin(now);
      } else {
        f_.diagnostics.report(
            Cause::NotUnlocked, "NVMCON.WR",
            "NVMCON.WR is set without NVMKEY = 0x55, NVMKEY = 0xAA straight before; nothing is "
            "erased or written",
            now);
      }
      key_step_ = 0;
      break;
    }
    case kAdr:
      if (!busy) adr_ = merge_lanes(adr_, value, lanes);
      break;
    default:
      if (!busy) adru_ = merge_lanes(adru_, value, lanes);
      break;
  }
}

Cycle Nvm::horizon(unsigned address, Cycle /*now*/) const {
  return address == kCon ? f_.events.when(slot_) : kNever;
}

}  // namespace dspic
