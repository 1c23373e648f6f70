// SPDX-License-Identifier: MIT
// Hardware faults (SIGSEGV, SIGBUS, SIGFPE, SIGILL) of native code that runs on a thread of ours: compiled
// firmware's become traps of its robot, all others go to the handlers that were there before.
#pragma once
#include <cstdint>
#include <string>

namespace host {

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

/// Stops every thread that has run firmware, for good, and says what each was at: "robot 'puck' was running:
/// main (main.c:9)". Empty: none was. For whoever ends the process next; called by a thread that is none of
/// them.
std::string halt_threads();

}  // namespace host
