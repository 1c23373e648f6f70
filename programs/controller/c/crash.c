/* SPDX-License-Identifier: MIT
 * A program that dies of a signal says where: signal, file, offset in it and function, in a CRASH record.
 *
 * The handler runs on a stack of its own, allocates nothing, and walks the frames to the first one that is the
 * program's rather than a library's. Then the signal does what it does without a handler.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <ucontext.h>
#include <unistd.h>

#include "programs/controller/c/library.h"

#define STACK_BYTES 131072
#define MOST_FRAMES 64

static const int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
static int crash_socket = -1;
static _Alignas(8) unsigned char crash_bytes[8192];

static void* place_of(const ucontext_t* context) {
#if defined(__x86_64__)
  return (void*)context->uc_mcontext.gregs[REG_RIP];
#elif defined(__aarch64__)
  return (void*)context->uc_mcontext.pc;
#else
  return (void)context, (void*)0;
#endif
}

struct place {
  char file[1024], function[256];
  uintptr_t offset; /* as in the file's own table of addresses */
  bool is_library;  /* of the system, or this one */
};

static bool find_place(void* address, struct place* place) {
  Dl_info info;
  struct link_map* map = 0;
  memset(place, 0, sizeof *place);
  if (!dladdr1(address, &info, (void**)&map, RTLD_DL_LINKMAP) || !map) return false;
  place->offset = (uintptr_t)address - (uintptr_t)map->l_addr;
  if (map->l_name && *map->l_name)
    strncpy(place->file, map->l_name, sizeof place->file - 1);
  else if (readlink("/proc/self/exe", place->file, sizeof place->file - 1) < 0)
    place->file[0] = 0;
  if (info.dli_sname) strncpy(place->function, info.dli_sname, sizeof place->function - 1);
  place->is_library = strncmp(place->file, "/lib", 4) == 0 || strncmp(place->file, "/usr/lib", 8) == 0 ||
                      strstr(place->file, "libcontroller.so") || strstr(place->file, "linux-vdso");
  return true;
}

static void on_signal(int number, siginfo_t* info, void* context) {
  void* frames[MOST_FRAMES];
  void* at = place_of(context);
  struct place place, frame;
  struct link_packet out = {.bytes = crash_bytes, .capacity = sizeof crash_bytes};
  bool is_found = find_place(at, &place);
  int i, count;
  (void)info;

  /* a crash within a library is told where the program called it */
  if (!is_found || place.is_library) {
    bool is_below = false;
    count = backtrace(frames, MOST_FRAMES);
    for (i = 0; i < count; i++) {
      if (frames[i] == at) {
        is_below = true;
        continue;
      }
      if ((is_below || !at) && find_place((char*)frames[i] - 1, &frame) && !frame.is_library) {
        place = frame;
        break;
      }
    }
  }

  link_begin(&out, LINK_CRASH);
  link_int(&out, number);
  link_text(&out, place.file);
  link_int(&out, (int64_t)place.offset);
  link_text(&out, place.function);
  link_end(&out);
  send(crash_socket, out.bytes, out.size, MSG_NOSIGNAL | MSG_DONTWAIT);

  signal(number, SIG_DFL);
  raise(number);
}

void crash_install(int socket) {
  struct sigaction action, before;
  stack_t stack = {0};
  void* primer[1];
  size_t i;
  crash_socket = socket;
  if (session_language == 3) return; /* Java's machine needs these signals */

  /* loads what walks the frames, which a handler must not */
  (void)backtrace(primer, 1);
  if (sigaltstack(0, &stack) == 0 && (stack.ss_flags & SS_DISABLE)) {
    stack.ss_sp = mmap(0, STACK_BYTES, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    stack.ss_size = STACK_BYTES;
    stack.ss_flags = 0;
    if (stack.ss_sp == MAP_FAILED || sigaltstack(&stack, 0) != 0) return;
  }
  memset(&action, 0, sizeof action);
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (i = 0; i < sizeof kSignals / sizeof *kSignals; i++)
    if (sigaction(kSignals[i], 0, &before) == 0 && !(before.sa_flags & SA_SIGINFO) && before.sa_handler == SIG_DFL)
      sigaction(kSignals[i], &action, 0);
}
