// SPDX-License-Identifier: MIT
// C++ for firmware: memory of new and delete, and the ends of a program that on the PC are exceptions. Here
// they are traps, which say what happened.
#include <stdio.h>
#include <stdlib.h>

#include "hal_sim/host/image_abi.h"

namespace {

[[noreturn]] void end(const char* what, const char* why) {
  char text[120];
  snprintf(text, sizeof text, "%s%s%s; firmware has no exceptions", what, *why ? ": " : "", why);
  tp_trap_message(TP_TRAP_ABORT, text);
  for (;;) {
  }
}

void* take(size_t bytes) {
  void* memory = malloc(bytes ? bytes : 1);
  if (!memory) end("std::bad_alloc", "the heap of 1 MB is full, or one piece is larger than 64 KB");
  return memory;
}

}  // namespace

void* operator new(size_t bytes) { return take(bytes); }
void* operator new[](size_t bytes) { return take(bytes); }
void operator delete(void* memory) noexcept { free(memory); }
void operator delete[](void* memory) noexcept { free(memory); }
void operator delete(void* memory, size_t) noexcept { free(memory); }
void operator delete[](void* memory, size_t) noexcept { free(memory); }

// objects of the program's own live as long as the robot
extern "C" int atexit(void (*)(void)) { return 0; }
extern "C" void __cxa_pure_virtual() { end("a pure virtual function", ""); }
extern "C" void __cxa_deleted_virtual() { end("a deleted virtual function", ""); }

namespace std {
void terminate() noexcept { end("std::terminate()", ""); }
void __throw_bad_exception() { end("std::bad_exception", ""); }
void __throw_bad_alloc() { end("std::bad_alloc", ""); }
void __throw_bad_array_new_length() { end("std::bad_array_new_length", ""); }
void __throw_bad_cast() { end("std::bad_cast", ""); }
void __throw_bad_typeid() { end("std::bad_typeid", ""); }
void __throw_bad_function_call() { end("std::bad_function_call", ""); }
void __throw_bad_optional_access() { end("std::bad_optional_access", ""); }
void __throw_logic_error(const char* why) { end("std::logic_error", why); }
void __throw_domain_error(const char* why) { end("std::domain_error", why); }
void __throw_invalid_argument(const char* why) { end("std::invalid_argument", why); }
void __throw_length_error(const char* why) { end("std::length_error", why); }
void __throw_out_of_range(const char* why) { end("std::out_of_range", why); }
void __throw_out_of_range_fmt(const char* why, ...) { end("std::out_of_range", why); }
void __throw_runtime_error(const char* why) { end("std::runtime_error", why); }
void __throw_range_error(const char* why) { end("std::range_error", why); }
void __throw_overflow_error(const char* why) { end("std::overflow_error", why); }
void __throw_underflow_error(const char* why) { end("std::underflow_error", why); }
void __throw_system_error(int) { end("std::system_error", ""); }
}  // namespace std
