// SPDX-License-Identifier: MIT
// A stackful coroutine on Boost.Context: the firmware's own stack. The scheduler enters it, the firmware
// yields. Running over its end is a page fault, which faults.cpp recognises:
//
//   slot: [ guard: never accessible | reserve: opened for the host alone | stack .......... high ] nothing
//
// Its addresses are the same in every run (address_slot.h).
// Firmware that reaches into the reserve has overflowed its stack. The host's own functions run on this stack
// too, when firmware calls them; one that needs the reserve gets it, so that it is never given up half way,
// and the overflow is reported as soon as it has come back.
#pragma once
#include <cstddef>
#include <cstdint>

#include "hal_sim/host/address_slot.h"

namespace host {

class Fiber {
 public:
  /// Entry point; must never return (yield for ever instead).
  using Entry = void (*)(void* argument);

  /// Reserves `stack_bytes` of stack (rounded up to pages); memory is touched only as it is used.
  explicit Fiber(std::size_t stack_bytes);
  ~Fiber();
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;

  /// (Re)starts the fiber: the next enter() calls entry(argument) on an empty stack. What was on it is
  /// dropped.
  void restart(Entry entry, void* argument);
  /// Frames on the stack will not be gone on with: from now on anybody may look at its memory.
  void drop_frames() const;

  /// Runs the fiber until it yields. Called by the scheduler only.
  void enter();

  /// It is entered soon: the top of its stack comes into the cache meanwhile.
  void fetch() const {
    __builtin_prefetch(inside_);
    __builtin_prefetch(static_cast<const char*>(inside_) + 64);
    __builtin_prefetch(static_cast<const char*>(inside_) + 128);
  }

  /// Goes back to whoever called enter(). Called on the fiber only (or on a recovery stack standing in for
  /// it).
  void yield();

  /// Frame of the last yield(), in which it stands while it does not run; 0: it has not begun.
  std::uintptr_t frame() const { return frame_; }
  bool is_on_stack(std::uintptr_t address) const { return address >= floor() && address < high_; }
  /// Below the stack, where nothing may be accessed: the stack has overflowed.
  bool is_in_guard(std::uintptr_t address) const;
  /// In the reserve, while it is closed.
  bool is_in_reserve(std::uintptr_t address) const;
  /// Lets the host use the reserve until the next restart. Safe in a signal handler. False: the system
  /// refused.
  bool open_reserve();
  /// Above the stack, where nothing is.
  bool is_beyond(std::uintptr_t address) const { return address >= high_ && slot_.holds(address); }

 private:
  static void trampoline(void* self);
  std::uintptr_t floor() const;  // lowest address that may be accessed now

  AddressSlot slot_;
  std::uintptr_t low_ = 0;   // lowest usable stack address
  std::uintptr_t high_ = 0;  // one past the highest
  bool reserve_open_ = false;
  std::uintptr_t frame_ = 0;
  void* inside_ = nullptr;   // saved context of the fiber while it does not run
  void* outside_ = nullptr;  // saved context of the scheduler while it runs
  Entry entry_ = nullptr;
  void* argument_ = nullptr;
#if defined(__SANITIZE_ADDRESS__)
  void* outside_fake_stack_ = nullptr;
  const void* outside_bottom_ = nullptr;
  std::size_t outside_size_ = 0;
#endif
#if defined(__SANITIZE_THREAD__)
  void* tsan_inside_ = nullptr;
  void* tsan_outside_ = nullptr;
#endif
};

}  // namespace host
