// SPDX-License-Identifier: MIT
#include "dspic30/memory/program_memory.h"

#include <algorithm>

namespace dspic {

namespace {

constexpr unsigned kDeviceId = 0xFF0000, kDeviceRevision = 0xFF0002;
constexpr std::uint32_t kDeviceIdValue = 0x0343, kDeviceRevisionValue = 0x1000;  // [?]

constexpr bool is_within(unsigned address, unsigned start, unsigned words) {
  return address - start < 2 * words;
}

}  // namespace

std::uint32_t* ProgramMemory::own_flash() {
  if (flash_.use_count() > 1) flash_ = std::make_shared<std::vector<std::uint32_t>>(*flash_);
  return flash_->data();
}

std::uint32_t ProgramMemory::read(unsigned address) const {
  if (address < kFlashEnd) return (*flash_)[address / 2];
  if (is_within(address, kUnitIdStart, kUnitIdWords)) return unit_id_[(address - kUnitIdStart) / 2];
  if (is_within(address, kConfigurationStart, kConfigurationWords))
    return configuration_[(address - kConfigurationStart) / 2];
  if ((address & ~1u) == kDeviceId) return kDeviceIdValue;
  return (address & ~1u) == kDeviceRevision ? kDeviceRevisionValue : 0;
}

bool ProgramMemory::write(unsigned address, std::uint32_t word) {
  if (address < kFlashEnd)
    own_flash()[address / 2] = word & 0xFFFFFF;
  else if (is_within(address, kUnitIdStart, kUnitIdWords))
    unit_id_[(address - kUnitIdStart) / 2] = word & 0xFFFFFF;
  else if (is_within(address, kConfigurationStart, kConfigurationWords))
    configuration_[(address - kConfigurationStart) / 2] = static_cast<std::uint16_t>(word);
  else
    return false;
  ++version_;
  return true;
}

void ProgramMemory::erase_row(unsigned address) {
  if (address >= kFlashEnd) return;
  std::fill_n(own_flash() + row_of(address), kFlashRowWords, kErasedWord);
  ++version_;
}

void ProgramMemory::program_row(unsigned address, const std::array<std::uint32_t, kFlashRowWords>& latches) {
  if (address >= kFlashEnd) return;
  std::uint32_t* const row = own_flash() + row_of(address);
  for (unsigned i = 0; i < kFlashRowWords; ++i) row[i] &= latches[i];
  ++version_;
}

}  // namespace dspic
