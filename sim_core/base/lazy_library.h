// SPDX-License-Identifier: MIT
// Functions of a shared library that is loaded when one of them is called. For libraries that take longer to
// load than all that most runs do and that most runs never call. A program is linked against these functions
// instead of the library, so a function that is missing in the list is missed by the linker. x86-64.
//
//   #define CALLS(X) X(cairo, cairo_arc) X(cairo, cairo_clip)
//   LAZY_LIBRARY(cairo, "libcairo.so.2", CALLS)
//
// In a file of its own, without the library's header, whose declarations would stand against these.
#pragma once
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

/// Nothing but what it says in assembler, also in a build that counts calls.
#define LAZY_JUMP __attribute__((naked, no_profile_instrument_function, used, visibility("hidden")))

/// Each function jumps to where its slot points, so any signature will do: first to the loader, which keeps
/// all registers that arguments can be in, then to the library.
#define LAZY_FUNCTION(library, name)                                       \
  extern "C" {                                                             \
  LAZY_JUMP void lazy_first_##name() {                                     \
    __asm__("call lazy_load_" #library "\n jmp *lazy_at_" #name "(%rip)"); \
  }                                                                        \
  __attribute__((used, visibility("hidden"))) void* lazy_at_##name =       \
      reinterpret_cast<void*>(&lazy_first_##name);                         \
  LAZY_JUMP void name() { __asm__("jmp *lazy_at_" #name "(%rip)"); }       \
  }

#define LAZY_FIND(library, name) \
  if (void* found = dlsym(handle, #name)) lazy_at_##name = found, ++places;

#define LAZY_COUNT(library, name) +1

#define LAZY_LIBRARY(library, file, CALLS)                                                                   \
  CALLS(LAZY_FUNCTION)                                                                                       \
  extern "C" __attribute__((used, visibility("hidden"))) void lazy_open_##library() {                        \
    void* const handle = dlopen(file, RTLD_NOW | RTLD_LOCAL);                                                \
    int places = 0;                                                                                          \
    if (handle) {                                                                                            \
      CALLS(LAZY_FIND)                                                                                       \
    }                                                                                                        \
    if (places == 0 CALLS(LAZY_COUNT)) return;                                                               \
    std::fprintf(stderr, "%s: cannot be loaded: %s\n", file,                                                 \
                 handle ? "it is of another version" : dlerror());                                           \
    std::abort();                                                                                            \
  }                                                                                                          \
  extern "C" LAZY_JUMP void lazy_load_##library() {                                                          \
    __asm__(                                                                                                 \
        "push %rax\n push %rdi\n push %rsi\n push %rdx\n push %rcx\n push %r8\n push %r9\n sub $136, %rsp\n" \
        "movups %xmm0, (%rsp)\n movups %xmm1, 16(%rsp)\n movups %xmm2, 32(%rsp)\n movups %xmm3, 48(%rsp)\n"  \
        "movups %xmm4, 64(%rsp)\n movups %xmm5, 80(%rsp)\n movups %xmm6, 96(%rsp)\n movups %xmm7, "          \
        "112(%rsp)\n"                                                                                        \
        "call lazy_open_" #library                                                                           \
        "\n"                                                                                                 \
        "movups (%rsp), %xmm0\n movups 16(%rsp), %xmm1\n movups 32(%rsp), %xmm2\n movups 48(%rsp), %xmm3\n"  \
        "movups 64(%rsp), %xmm4\n movups 80(%rsp), %xmm5\n movups 96(%rsp), %xmm6\n movups 112(%rsp), "      \
        "%xmm7\n"                                                                                            \
        "add $136, %rsp\n pop %r9\n pop %r8\n pop %rcx\n pop %rdx\n pop %rsi\n pop %rdi\n pop %rax\n ret");  \
  }
