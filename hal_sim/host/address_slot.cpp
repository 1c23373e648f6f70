// SPDX-License-Identifier: MIT
#include "hal_sim/host/address_slot.h"

#include <sys/mman.h>

#include <mutex>
#include <vector>

#include "sim_core/base/check.h"

namespace host {

namespace {
constexpr std::uintptr_t kFirst = 0x2000'0000'0000, kSlotBytes = std::uintptr_t{1} << 32;
constexpr int kSlots = 0x3000;  // up to 0x5000'0000'0000, where programs and libraries of the PC may lie
std::mutex changing;
std::vector<bool> taken;

// the lowest free one; -1: none
int take() {
  std::lock_guard<std::mutex> lock(changing);
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (!taken[i]) {
      taken[i] = true;
      return static_cast<int>(i);
    }
  if (taken.size() == kSlots) return -1;
  taken.push_back(true);
  return static_cast<int>(taken.size()) - 1;
}
}  // namespace

AddressSlot::AddressSlot(std::size_t offset, std::size_t bytes) : bytes_(bytes) {
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
  void* at = MAP_FAILED;
#if !defined(__SANITIZE_THREAD__)  // which wants all memory in places of its own
  number_ = take();
  if (number_ >= 0) {
    first_ = kFirst + static_cast<std::uintptr_t>(number_) * kSlotBytes;
    end_ = first_ + kSlotBytes;
    at =
        mmap(reinterpret_cast<void*>(first_ + offset), bytes, PROT_NONE, kFlags | MAP_FIXED_NOREPLACE, -1, 0);
  }
#endif
  if (at == MAP_FAILED) {
    at = mmap(nullptr, bytes, PROT_NONE, kFlags, -1, 0);
    CHECK(at != MAP_FAILED, "no memory for firmware");
    first_ = reinterpret_cast<std::uintptr_t>(at);
    end_ = first_ + bytes;
  }
  begin_ = reinterpret_cast<std::uintptr_t>(at);
}

AddressSlot::~AddressSlot() {
  munmap(reinterpret_cast<void*>(begin_), bytes_);
  if (number_ < 0) return;
  std::lock_guard<std::mutex> lock(changing);
  taken[static_cast<std::size_t>(number_)] = false;
}

}  // namespace host
