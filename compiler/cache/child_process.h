// SPDX-License-Identifier: MIT
// Compilers and linkers are processes of their own, each with a group of processes, so that all of it can be
// ended, and with a bound on its memory. They end with whoever started them, however that ends.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace cc {

constexpr int kBySignal = 128;
struct ProcessResult {
  int status = -1;     ///< exit code; kBySignal and a signal's number
  std::string output;  ///< standard output and error together
};

/// Runs a program and collects what it prints. Nothing comes to it on standard input.
ProcessResult run_process(const std::vector<std::string>& argv);

/// Ends all that run_process() has started, and every ChildGroup, with the processes that they started; what
/// is started from now on ends at once. From any thread, also while others are halted.
void end_children();

/// A process that the caller started and that leads a group, for as long as it is not waited for.
class ChildGroup {
 public:
  explicit ChildGroup(pid_t pid);
  ~ChildGroup();
  ChildGroup(const ChildGroup&) = delete;
  ChildGroup& operator=(const ChildGroup&) = delete;

 private:
  std::size_t slot_;
};
/// The other side of a ChildGroup, first thing in the child: leads a group, and ends with its parent.
void lead_child_group(pid_t parent);

}  // namespace cc
