// SPDX-License-Identifier: MIT
// Page faults and arithmetic faults of natively run firmware become traps of that robot. The signal handler
// only redirects the thread to a recovery stack; the report is made there, in normal context, and the fiber
// is abandoned.
#include <pthread.h>
#include <signal.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif

#include "hal_sim/host/compiled_runner.h"
#include "hal_sim/host/faults.h"
#include "sim_core/base/check.h"

namespace host {

namespace {

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP};
struct sigaction previous[NSIG];
std::terminate_handler previous_terminate = nullptr;

struct Fault {
  int kind = 0;
  std::uintptr_t pc = 0, frame = 0, stack = 0, address = 0;
  bool is_write = false, has_address = false;
  bool is_call = false;     // there is no code where the program jumped to
  bool is_library = false;  // a function of the host was at it for the program
};
thread_local Fault last_fault;
thread_local StepGuest* step_guest = nullptr;

/// A thread that was told to halt, and where it did.
struct Halted {
  pthread_t thread = pthread_self();
  std::atomic<bool> has_halted{false};
  CompiledRunner* runner = nullptr;
  std::uintptr_t pc = 0, frame = 0;
};
std::mutex threads_changing;
std::vector<Halted*> threads;  // all that may run firmware
thread_local Halted* halted = nullptr;
constexpr int kHaltSignal = SIGUSR2;

constexpr std::size_t kSignalStackBytes = 256 * 1024;  // a debugger judges conditions on it
constexpr std::size_t kRecoveryStackBytes = 256 * 1024;
struct ThreadStacks {
  std::unique_ptr<char[]> signal{new char[kSignalStackBytes]};
  std::unique_ptr<char[]> recovery{new char[kRecoveryStackBytes]};
  Halted here;
  ThreadStacks() {
    std::lock_guard<std::mutex> lock(threads_changing);
    threads.push_back(&here);
    halted = &here;
  }
  ~ThreadStacks() {
    {
      std::lock_guard<std::mutex> lock(threads_changing);
      threads.erase(std::find(threads.begin(), threads.end(), &here));
      halted = nullptr;
    }
    stack_t off{};
    off.ss_flags = SS_DISABLE;
    sigaltstack(&off, nullptr);
  }
};
thread_local std::unique_ptr<ThreadStacks> stacks;

std::string describe(const Fault& f, const CompiledRunner& runner) {
  constexpr std::uintptr_t kNullPage = 64 * 1024;
  if (f.kind == TP_TRAP_STACK) return kStackOverflow;
  if (f.kind == TP_TRAP_MATH) return "arithmetic fault";
  if (f.kind == TP_TRAP_ILLEGAL)
    return "illegal instruction: the program ran into a place it can never reach";
  const std::string access =
      std::string(f.is_library ? "a function of the library was to " : "") + (f.is_call    ? "call through"
                                                                              : f.is_write ? "write through"
                                                                                           : "read through");
  if (f.has_address && f.address < 4096) return access + " a null pointer";
  if (f.has_address && f.address < kNullPage)
    return access + " a wild pointer (address " + std::to_string(f.address) + ")";
  if (f.is_call)
    return access +
           " a wild pointer: there is no code; a function pointer or, on the stack, a return address "
           "was overwritten";
  if (f.has_address && f.is_write && runner.owns_constant(f.address))
    return "write to a constant or to the program itself";
  if (f.has_address && runner.owns_address(f.address))
    return access + " a pointer or index that has left the program's memory";
  if (f.has_address && runner.fiber().is_beyond(f.address))
    return access + " a pointer or index that has left the stack: beyond the end of a local array";
  return access + " a wild pointer";
}

#if defined(__SANITIZE_ADDRESS__)
// the sanitizer learns that the thread has changed stacks, and forgets what earlier faults left on this one
__attribute__((no_sanitize("address"))) void tell_sanitizer() {
  ASAN_UNPOISON_MEMORY_REGION(stacks->recovery.get(), kRecoveryStackBytes);
  __sanitizer_start_switch_fiber(nullptr, stacks->recovery.get(), kRecoveryStackBytes);
  __sanitizer_finish_switch_fiber(nullptr, nullptr, nullptr);
}
#else
void tell_sanitizer() {}
#endif

[[noreturn]] void recover() {
  const Fault f = last_fault;
  sigset_t set;
  sigemptyset(&set);
  for (int s : kSignals) sigaddset(&set, s);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  CompiledRunner& runner = *CompiledRunner::running();
  runner.fault(f.kind, describe(f, runner), f.pc, f.frame, f.stack);
}

__attribute__((noreturn, no_sanitize("address"))) void land() {
  tell_sanitizer();
  recover();
}

/// An exception that a function of the host lets out to firmware.
[[noreturn]] void on_terminate() {
  char here;
  CompiledRunner* runner = CompiledRunner::running();
  if (runner && runner->fiber().is_on_stack(reinterpret_cast<std::uintptr_t>(&here))) {
    runner->last_words() = "a function of the library was given what it cannot use";
    runner->trap(TP_TRAP_ADDRESS, runner->last_words());
  }
  previous_terminate();
  std::abort();
}

void on_halt(int, siginfo_t*, void* raw) {
  if (!halted) return;
  const auto& r = static_cast<ucontext_t*>(raw)->uc_mcontext.gregs;
  halted->runner = CompiledRunner::running();
  halted->pc = static_cast<std::uintptr_t>(r[REG_RIP]);
  halted->frame = static_cast<std::uintptr_t>(r[REG_RBP]);
  halted->has_halted = true;
  for (;;) pause();  // what it was at stays as it is
}

void on_signal(int signal, siginfo_t* info, void* raw) {
  if (signal == SIGTRAP && step_guest && step_guest->take(info->si_code, raw)) return;
  auto* context = static_cast<ucontext_t*>(raw);
  auto& r = context->uc_mcontext.gregs;
  CompiledRunner* runner = CompiledRunner::running();
  auto pc = static_cast<std::uintptr_t>(r[REG_RIP]);
  const auto sp = static_cast<std::uintptr_t>(r[REG_RSP]);
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  bool ours = runner && runner->owns_code(pc);
  const bool is_fetch = signal == SIGSEGV && pc == address;
  // a function may have moved below the stack before it writes
  const bool on_stack =
      runner && (runner->fiber().is_on_stack(sp) || (signal == SIGSEGV && runner->fiber().is_in_reserve(sp)));
  bool is_library = false;
  if (runner && !ours && is_fetch) {
    // a jump to where no code is: a wild function pointer, whose caller left a return address, or a wild
    // return address
    ours = true;
    std::uintptr_t back = 0;
    if (on_stack && runner->fiber().is_on_stack(sp + sizeof back - 1))
      std::memcpy(&back, reinterpret_cast<const void*>(sp), sizeof back);
    pc = runner->owns_code(back) ? back - 1 : 0;
  } else if (runner && !ours && on_stack) {
    // one of the host's functions, called by firmware that has used up its stack: it gets the reserve and
    // goes on
    if (signal == SIGSEGV && runner->fiber().is_in_reserve(address) && runner->lend_reserve()) return;
    // or given a pointer that leads nowhere. On top of the stack, of a function without a frame, or along the
    // frames stands who called it
    ours = is_library = true;
    std::uintptr_t back = 0;
    if (runner->fiber().is_on_stack(sp)) std::memcpy(&back, reinterpret_cast<const void*>(sp), sizeof back);
    pc = runner->owns_code(back) ? back - 1 : 0;
  }
  // out of stack anywhere on the firmware's stack
  if (runner && signal == SIGSEGV && runner->fiber().is_in_guard(address)) ours = true;
  if (!ours) {
    sigaction(signal, &previous[signal],
              nullptr);  // not firmware: fault again with whoever was there before us
    return;
  }
  if (step_guest) step_guest->note_fault(raw);
  Fault& f = last_fault;
  f.pc = pc;
  f.frame = static_cast<std::uintptr_t>(r[REG_RBP]);
  f.stack = sp;
  f.address = address;
  f.is_call = is_fetch;
  f.is_library = is_library;
  f.has_address = signal == SIGSEGV && info->si_code != SI_KERNEL;
  f.is_write = (r[REG_ERR] & 2) != 0;
  f.kind = signal == SIGFPE                        ? TP_TRAP_MATH
           : signal == SIGILL || signal == SIGTRAP ? TP_TRAP_ILLEGAL
                                                   : TP_TRAP_ADDRESS;
  if (signal == SIGSEGV && runner->fiber().is_in_guard(address)) f.kind = TP_TRAP_STACK;
  const auto top = reinterpret_cast<std::uintptr_t>(stacks->recovery.get()) + kRecoveryStackBytes;
  r[REG_RSP] = static_cast<greg_t>((top & ~std::uintptr_t{15}) - 8);
  r[REG_RBP] = 0;
  r[REG_RIP] = static_cast<greg_t>(reinterpret_cast<std::uintptr_t>(&land));
}

}  // namespace

void set_step_guest(StepGuest* now) { step_guest = now; }

void catch_faults_on_this_thread() {
  if (stacks) return;
  static std::once_flag once;
  std::call_once(once, [] {
    struct sigaction action {};
    action.sa_sigaction = on_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (int s : kSignals) CHECK(sigaction(s, &action, &previous[s]) == 0, "cannot install a fault handler");
    previous_terminate = std::set_terminate(on_terminate);
    action.sa_sigaction = on_halt;
    CHECK(sigaction(kHaltSignal, &action, nullptr) == 0, "cannot install a handler");
  });
  stacks = std::make_unique<ThreadStacks>();
  stack_t stack{};
  stack.ss_sp = stacks->signal.get();
  stack.ss_size = kSignalStackBytes;
  CHECK(sigaltstack(&stack, nullptr) == 0, "cannot set a signal stack");
}

std::string halt_threads() {
  std::lock_guard<std::mutex> lock(threads_changing);
  for (Halted* t : threads) pthread_kill(t->thread, kHaltSignal);
  const auto all_have = [] {
    return std::all_of(threads.begin(), threads.end(), [](const Halted* t) { return t->has_halted.load(); });
  };
  for (int ms = 0; ms < 100 && !all_have(); ++ms) usleep(1000);
  std::string text;
  for (const Halted* t : threads) {
    if (!t->has_halted || !t->runner) continue;
    text += (text.empty() ? "robot '" : ", robot '") + t->runner->name() +
            "' was running: " + to_string(t->runner->place_of_code(t->pc, t->frame));
  }
  return text;
}

}  // namespace host
