// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "dspic30/memory/program_memory.h"
#include "dspic30/periph/nvm.h"
#include "flash/upload.h"

namespace flash {

namespace {

constexpr std::uint32_t kRowAddresses = 64;
constexpr std::uint32_t kGoto = 0x04;  // the first of its two words, bits 23 to 16
constexpr std::uint32_t kClrW0 = 0xEB0000;

std::array<std::uint32_t, 2> goto_words(std::uint32_t target) {
  return {kGoto << 16 | (target & 0xFFFE), target >> 16};
}

std::uint32_t word_at(const dspic::FirmwareFile& file, std::uint32_t address) {
  const auto found = file.words.find(address);
  return found == file.words.end() ? dspic::kErasedWord : found->second;
}

void put(UploadPlan& plan, std::uint32_t address, std::uint32_t word) {
  FlashRow blank;
  blank.fill(dspic::kErasedWord);
  FlashRow& row = plan.rows.emplace(address & ~(kRowAddresses - 1), blank).first->second;
  row[address % kRowAddresses / 2] = word;
}

}  // namespace

bool plan_upload(const dspic::FirmwareFile& file, const std::string& name, UploadPlan& plan,
                 std::string& error) {
  const std::uint32_t first = word_at(file, 0), second = word_at(file, 2);
  if (first >> 16 != kGoto || second > 0x7F) {
    error = fmt::format("{}: address 0x000000: got the word {:#08x}, expected a goto to the program", name,
                        first);
    return false;
  }
  const std::uint32_t target = (first & 0xFFFE) | second << 16;
  const bool brings_bootloader = target == kBootloaderEntry;
  int eeprom = 0, configuration = 0;
  for (const auto& [address, word] : file.words) {
    const bool is_user = address >= kBootloaderUser && address < kBootloaderEntry;
    if (address >= dspic::kFlashEnd) {
      ++(address - dspic::kEepromStart < 2u * dspic::kEepromWordCount ? eeprom : configuration);
    } else if (is_user || address >= kBootloaderEntry) {
      if (!brings_bootloader && word != dspic::kErasedWord) {
        error = fmt::format(
            "{}: address {:#08x}: the program reaches into the bootloader's words, {:#08x} to {:#08x}; make "
            "it smaller",
            name, address, kBootloaderUser, dspic::kFlashEnd - 2);
        return false;
      }
    } else {
      put(plan, address, word);
    }
  }
  for (std::uint32_t i = 0; i < 4; ++i) plan.way_in[i] = word_at(file, kBootloaderUser + 2 * i);
  if (brings_bootloader) {
    plan.notes.push_back("the file has a bootloader of its own; the robot keeps the one it has");
    if (plan.way_in[0] >> 16 != kGoto) {
      error = fmt::format(
          "{}: address {:#08x}: got the word {:#08x}, expected a goto to the program; is the file a "
          "bootloader "
          "only?",
          name, kBootloaderUser, plan.way_in[0]);
      return false;
    }
  } else {
    plan.way_in = {first, second, dspic::kErasedWord, dspic::kErasedWord};
  }
  const auto entry = goto_words(kBootloaderEntry);
  put(plan, 0, entry[0]);
  put(plan, 2, entry[1]);
  for (std::uint32_t i = 0; i < 4; ++i) put(plan, kBootloaderUser + 2 * i, kClrW0);
  // No 0xFF at its beginning: should bytes of the frame's head be lost, a bootloader would take it for the
  // end of the upload, and start what the row leads to
  FlashRow& last = plan.rows.at(kBootloaderRow);
  for (std::uint32_t i = 0; kBootloaderRow + 2 * i < kBootloaderUser; ++i)
    if (!file.words.count(kBootloaderRow + 2 * i)) last[i] = 0;
  if (eeprom)
    plan.notes.push_back(
        fmt::format("{} words of EEPROM are not written: the protocol writes flash only", eeprom));
  if (configuration)
    plan.notes.push_back(
        "configuration words are not written: they stay as the bootloader's programmer set them");
  return true;
}

}  // namespace flash
