// SPDX-License-Identifier: MIT
#include "hal_sim/host/fiber.h"

#include <sys/mman.h>
#include <unistd.h>

#include <boost/context/detail/fcontext.hpp>

#include "sim_core/base/check.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace host {

namespace ctx = boost::context::detail;

namespace {
constexpr std::size_t kGuardBytes =
    64 * 1024;  // wider than any one frame of a controller, so no frame jumps over it
constexpr std::size_t kReserveBytes =
    512 * 1024;  // ample for the report of a trap, sanitized builds included
}  // namespace

namespace {
// in the slot: above and below lies nothing, farther than an `int` reaches in an array of doubles
constexpr std::size_t kStackOffset = std::size_t{1} << 20;
std::size_t whole_pages(std::size_t bytes) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return (bytes + page - 1) / page * page;
}
}  // namespace

Fiber::Fiber(std::size_t stack_bytes)
    : slot_(AddressSlot::Kind::Stack, kStackOffset, whole_pages(stack_bytes) + kReserveBytes + kGuardBytes) {
  low_ = slot_.begin() + kGuardBytes + kReserveBytes;
  high_ = slot_.begin() + slot_.bytes();
  CHECK(mprotect(reinterpret_cast<void*>(low_), high_ - low_, PROT_READ | PROT_WRITE) == 0,
        "no memory for a firmware stack");
}

Fiber::~Fiber() {
#if defined(__SANITIZE_THREAD__)
  if (tsan_inside_) __tsan_destroy_fiber(tsan_inside_);
#endif
#if defined(__SANITIZE_ADDRESS__)
  // a robot that was stopped by a trap leaves frames behind, and the addresses are soon somebody else's
  ASAN_UNPOISON_MEMORY_REGION(reinterpret_cast<void*>(slot_.begin()), slot_.bytes());
#endif
}

void Fiber::drop_frames() const {
#if defined(__SANITIZE_ADDRESS__)
  // frames leave poison
  ASAN_UNPOISON_MEMORY_REGION(reinterpret_cast<void*>(floor()), high_ - floor());
#endif
}

std::uintptr_t Fiber::floor() const { return reserve_open_ ? low_ - kReserveBytes : low_; }

bool Fiber::is_in_guard(std::uintptr_t address) const { return address < floor() && slot_.holds(address); }

bool Fiber::is_in_reserve(std::uintptr_t address) const {
  return !reserve_open_ && address < low_ && address + kReserveBytes >= low_;
}

bool Fiber::open_reserve() {
  reserve_open_ =
      mprotect(reinterpret_cast<void*>(low_ - kReserveBytes), kReserveBytes, PROT_READ | PROT_WRITE) == 0;
  return reserve_open_;
}

void Fiber::restart(Entry entry, void* argument) {
  entry_ = entry;
  argument_ = argument;
  frame_ = 0;
  drop_frames();
  if (reserve_open_) {
    CHECK(mprotect(reinterpret_cast<void*>(low_ - kReserveBytes), kReserveBytes, PROT_NONE) == 0,
          "cannot close a stack's reserve");
    reserve_open_ = false;
  }
#if defined(__SANITIZE_THREAD__)
  if (tsan_inside_) __tsan_destroy_fiber(tsan_inside_);
  tsan_inside_ = __tsan_create_fiber(0);
#endif
  inside_ = ctx::make_fcontext(reinterpret_cast<void*>(high_), high_ - low_, [](ctx::transfer_t from) {
    auto* self = static_cast<Fiber*>(from.data);
    self->outside_ = from.fctx;
    trampoline(self);
  });
}

void Fiber::trampoline(void* raw) {
  auto* self = static_cast<Fiber*>(raw);
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_finish_switch_fiber(nullptr, &self->outside_bottom_, &self->outside_size_);
#endif
  self->entry_(self->argument_);
  CHECK(false, "a fiber's entry returned");
}

void Fiber::enter() {
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_start_switch_fiber(&outside_fake_stack_, reinterpret_cast<void*>(low_ - kReserveBytes),
                                 high_ - low_ + kReserveBytes);
#endif
#if defined(__SANITIZE_THREAD__)
  tsan_outside_ = __tsan_get_current_fiber();
  __tsan_switch_to_fiber(tsan_inside_, 0);
#endif
  const ctx::transfer_t back = ctx::jump_fcontext(inside_, this);
  inside_ = back.fctx;
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_finish_switch_fiber(outside_fake_stack_, nullptr, nullptr);
#endif
}

void Fiber::yield() {
  frame_ = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
#if defined(__SANITIZE_ADDRESS__)
  void* fake = nullptr;
  __sanitizer_start_switch_fiber(&fake, outside_bottom_, outside_size_);
#endif
#if defined(__SANITIZE_THREAD__)
  __tsan_switch_to_fiber(tsan_outside_, 0);
#endif
  const ctx::transfer_t again = ctx::jump_fcontext(outside_, nullptr);
  outside_ = again.fctx;
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_finish_switch_fiber(fake, &outside_bottom_, &outside_size_);
#endif
}

}  // namespace host
