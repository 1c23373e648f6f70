// SPDX-License-Identifier: MIT
// Hardware faults (SIGSEGV, SIGBUS, SIGFPE, SIGILL) of native code that runs on a thread of ours: compiled
// firmware's become traps of its robot, a guest's are its own, all others go to the handlers that were there
// before.
#pragma once
#include <cstdint>
#include <string>

namespace host {

/// Other native code that a thread runs between the robots' turns and that answers for its own faults.
class FaultGuest {
 public:
  virtual ~FaultGuest() = default;
  /// In the signal handler: a fault of `signal` at `address` (0 unknown) was not firmware's. True: `context`
  /// (ucontext_t) was changed to go on elsewhere.
  virtual bool take(int signal, void* context, std::uintptr_t address) = 0;
  /// Who it is, and at what: the thread has been stopped there for good.
  virtual std::string what_runs(std::uintptr_t pc, std::uintptr_t frame) const = 0;
};
/// The guest that runs on this thread now; null: none.
void set_fault_guest(FaultGuest* guest);

/// Who runs a program's code on this thread instruction by instruction: a debugger.
class StepGuest {
 public:
  virtual ~StepGuest() = default;
  /// In the signal handler, on the thread's signal stack: an instruction has been carried out, or a
  /// breakpoint was met. It may block: the code that was interrupted is the program's own. False: it is none
  /// of its own.
  virtual bool take(int code, void* context) = 0;
  /// A fault of the program's code will be reported; `context` is as it was there.
  virtual void note_fault(void* context) = 0;
};
/// Null: none.
void set_step_guest(StepGuest* guest);

/// Installs the fault handlers of this process (SIGSEGV, SIGBUS, SIGFPE, SIGILL) once, and this thread's
/// signal and recovery stacks. Faults outside firmware go to the handlers that were there before.
void catch_faults_on_this_thread();

/// Stops every thread that has run firmware or supervisors, for good, and says what each was at: "robot
/// 'puck' was running: main (main.c:9)". Empty: neither was. For whoever ends the process next; called by a
/// thread that is none of them.
std::string halt_threads();

}  // namespace host
