// SPDX-License-Identifier: MIT
#include "hal_sim/host/address_slot.h"

#include <sys/mman.h>

#include <mutex>
#include <set>

#include "sim_core/base/check.h"

namespace host {

namespace {

/// Slots of one kind, one behind the other, and which of them are taken.
struct Slots {
  std::uintptr_t first;
  std::size_t spacing;
  int count;
  std::set<int> given_back{};  // the lowest first: a world that is opened again gets the addresses it had
  int next = 0;

  std::uintptr_t place(int number) const { return first + static_cast<std::size_t>(number) * spacing; }
};

// below where programs of the PC lie; libraries come further up, a sanitizer's shadow further down. Stacks
// are enough for the largest world
constexpr std::uintptr_t kStacksBegin = 0x1010'0000'0000, kImagesBegin = 0x1100'0000'0000,
                         kImagesEnd = 0x5000'0000'0000;
constexpr std::size_t kStackSpacing = std::size_t{4} << 20, kImageSpacing = std::size_t{4} << 30;
Slots image_slots{kImagesBegin, kImageSpacing, (kImagesEnd - kImagesBegin) / kImageSpacing};
Slots stack_slots{kStacksBegin, kStackSpacing, (kImagesBegin - kStacksBegin) / kStackSpacing};
std::mutex changing;

Slots& slots_of(AddressSlot::Kind kind) {
  return kind == AddressSlot::Kind::Image ? image_slots : stack_slots;
}

// -1: none
int take(Slots& slots) {
  std::lock_guard<std::mutex> lock(changing);
  if (!slots.given_back.empty()) {
    const int slot = *slots.given_back.begin();
    slots.given_back.erase(slots.given_back.begin());
    return slot;
  }
  return slots.next < slots.count ? slots.next++ : -1;
}
}  // namespace

AddressSlot::AddressSlot(Kind kind, std::size_t offset, std::size_t bytes) : kind_(kind), bytes_(bytes) {
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
  void* at = MAP_FAILED;
#if !defined(__SANITIZE_THREAD__)  // which wants all memory in places of its own
  Slots& slots = slots_of(kind);
  number_ = take(slots);
  if (number_ >= 0) {
    first_ = slots.place(number_);
    end_ = first_ + slots.spacing;
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
  slots_of(kind_).given_back.insert(number_);
}

}  // namespace host
