// SPDX-License-Identifier: MIT
// One supervisor's program in memory: a private copy of its shared object, its main() on a fiber of its own.
// It runs only when run() is called and comes back when it waits, ends or crashes. What ends a process
// (exit(), abort(), a signal, an exception that nobody catches) ends this program only. Not caught: threads
// of its own, exec. An endless loop that never steps ends with the run (tools/run_guard.h).
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/host/faults.h"
#include "hal_sim/host/fiber.h"
#include "hal_sim/host/shared_object.h"
#include "hal_sim/host/symbols.h"

namespace supervisor {

class Program final : host::FaultGuest {
 public:
  enum class State { Waiting, Done, Crashed };

  /// Loads `path` once more. Null, with a line in `problems`, when it is no program. `owner` is what
  /// current() answers while it runs.
  /// `folder` is where it works: names of files without a path are of that folder; `args` are words between
  /// blanks for main().
  static std::unique_ptr<Program> open(const std::string& path, const std::string& name,
                                       const std::string& folder, const std::string& args, void* owner,
                                       std::vector<std::string>& problems);
  ~Program() override;
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Lets it go on until it waits or is over. Nothing when it is over.
  void run();
  State state() const { return state_; }
  /// What main() returned or exit() was given; only when Done.
  int exit_status() const { return exit_status_; }
  /// True: it was exit() and not main's end.
  bool has_exited() const { return exited_; }
  /// What happened and where; only when Crashed.
  const std::string& crash() const { return crash_; }

  /// The owner of the program that runs on this thread; null outside of programs.
  static void* current();
  /// Called by the program: back to whoever called run().
  static void wait();
  /// Called by the program instead of exit().
  [[noreturn]] static void exit(int status);

 private:
  Program(std::string path, std::string name, void* owner);
  static void enter(void* self);
  [[noreturn]] static void land();
  bool take(int signal, void* context, std::uintptr_t address) override;
  std::string what_runs(std::uintptr_t pc, std::uintptr_t frame) const override;
  [[noreturn]] void leave(State state);
  [[noreturn]] void crash_with(std::string what, std::uintptr_t pc, std::uintptr_t frame);
  bool is_code(std::uintptr_t pc) const { return object_->is_code(pc); }
  std::string place_of(std::uintptr_t pc, std::uintptr_t frame) const;

  std::string path_, name_, folder_;
  std::vector<std::string> words_;  // the program's name and its arguments
  std::vector<char*> arguments_;    // argv; here, for the program's own frames are dropped when it ends
  void* owner_;
  std::unique_ptr<host::SharedObject> object_;
  int (*main_)(int, char**, char**) = nullptr;
  host::Fiber fiber_;
  host::Symbols symbols_;
  State state_ = State::Waiting;
  int exit_status_ = 0;
  bool exited_ = false;
  std::string crash_;
  struct Fault {
    int signal = 0;
    std::uintptr_t pc = 0, frame = 0, address = 0;
  } fault_;

  friend struct AbortHandler;
};

}  // namespace supervisor
