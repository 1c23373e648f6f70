// SPDX-License-Identifier: MIT
#include "hal_sim/host/address_slot.h"

#include <sys/mman.h>

#include <mutex>
#include <set>

#include "sim_core/base/check.h"

namespace host {

namespace {
constexpr std::uintptr_t kSlotBytes = std::uintptr_t{1} << 32;
// below and above where programs of the PC lie; libraries come further up, a sanitizer's shadow further down.
// One for each robot of the largest world.
constexpr int kSlotsBelow = 0x3F00, kSlots = kSlotsBelow + 0x2300;
constexpr std::uintptr_t place_of(int slot) {
  const bool is_below = slot < kSlotsBelow;
  const std::uintptr_t first = is_below ? 0x1100'0000'0000 : 0x5800'0000'0000;
  return first + static_cast<std::uintptr_t>(is_below ? slot : slot - kSlotsBelow) * kSlotBytes;
}
static_assert(place_of(kSlotsBelow - 1) + kSlotBytes == 0x5000'0000'0000);
static_assert(place_of(kSlots - 1) + kSlotBytes == 0x7B00'0000'0000);
std::mutex changing;
std::set<int> given_back;  // the lowest first: a world that is opened again gets the addresses it had
int next = 0;

// -1: none
int take() {
  std::lock_guard<std::mutex> lock(changing);
  if (!given_back.empty()) {
    const int slot = *given_back.begin();
    given_back.erase(given_back.begin());
    return slot;
  }
  return next < kSlots ? next++ : -1;
}
}  // namespace

AddressSlot::AddressSlot(std::size_t offset, std::size_t bytes) : bytes_(bytes) {
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
  void* at = MAP_FAILED;
#if !defined(__SANITIZE_THREAD__)  // which wants all memory in places of its own
  number_ = take();
  if (number_ >= 0) {
    first_ = place_of(number_);
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
  given_back.insert(number_);
}

}  // namespace host
