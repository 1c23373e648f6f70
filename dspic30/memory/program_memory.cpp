// SPDX-License-Identifier: MIT
#include "dspic30/memory/program_memory.h"

namespace dspic {

namespace {

constexpr unsigned kDeviceId = 0xFF0000, kDeviceRevision = 0xFF0002;
constexpr std::uint32_t kDeviceIdValue = 0x0343, kDeviceRevisionValue = 0x1000;  // [?]

constexpr bool is_within(unsigned address, unsigned start, unsigned words) {
  return address - start < 2 * words;
}

}  // namespace

std::uint32_t ProgramMemory::read(unsigned address) const {
  if (address < kFlashEnd) return flash_[address / 2];
  if (is_within(address, kUnitIdStart, kUnitIdWords)) return unit_id_[(address - kUnitIdStart) / 2];
  if (is_within(address, kConfigurationStart, kConfigurationWords))
    return configuration_[(address - kConfigurationStart) / 2];
  if ((address & ~1u) == kDeviceId) return kDeviceIdValue;
  return (address & ~1u) == kDeviceRevision ? kDeviceRevisionValue : 0;
}

bool ProgramMemory::write(unsigned address, std::uint32_t word) {
  if (address < kFlashEnd)
    flash_[address / 2] = word & 0xFFFFFF;
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
  for (unsigned i = 0; i < kFlashRowWords; ++i) flash_[row_of(address) + i] = kErasedWord;
  ++version_;
}

void ProgramMemory::program_row(unsigned address, const std::array<std::uint32_t, kFlashRowWords>& latches) {
  if (address >= kFlashEnd) return;
  for (unsigned i = 0; i < kFlashRowWords; ++i) flash_[row_of(address) + i] &= latches[i];
  ++version_;
}

}  // namespace dspic
