// SPDX-License-Identifier: MIT
// See child_process.h. posix_spawn() can neither bound memory nor tie a child to its parent, so this is what
// it does inside, with these two.
#include "child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "memory_limit.h"

namespace cc {
namespace {

constexpr std::size_t kMostChildren = 512;  // at once; more are not ended before their parent is
constexpr std::size_t kMostOutputBytes = std::size_t{4} << 20;  // of messages; nobody reads more

std::array<std::atomic<pid_t>, kMostChildren> children{};
std::atomic<bool> ending{false};

std::size_t note_child(pid_t pid) {
  std::size_t slot = 0;
  for (pid_t free = 0; slot < kMostChildren; ++slot, free = 0)
    if (children[slot].compare_exchange_strong(free, pid)) break;
  if (ending) kill(-pid, SIGKILL);
  return slot;
}

void forget_child(std::size_t slot) {
  if (slot < kMostChildren) children[slot] = 0;
}

/// The child's side of vfork(): system calls only, for its memory is the parent's. Returns when it cannot.
void become(char* const* argv, int output, int input, pid_t parent, const sigset_t& before, int* why) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it has ended meanwhile
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) signal(s, SIG_DFL);
  bound_memory(kMostChildBytes);
  if (dup2(input, 0) >= 0 && dup2(output, 1) >= 0 && dup2(output, 2) >= 0) {
    sigprocmask(SIG_SETMASK, &before, nullptr);
    execvp(argv[0], argv);
  }
  *why = errno;
}

/// Process of `argv`; -1 with errno in `why`.
pid_t start(char* const* argv, int output, int input, int& why) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t parent = getpid();
  volatile int wrong = 0;
  const pid_t pid = vfork();
  if (pid == 0) {
    become(argv, output, input, parent, before, const_cast<int*>(&wrong));
    _exit(127);
  }
  why = pid < 0 ? errno : wrong;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (pid > 0 && why != 0) {
    while (waitpid(pid, nullptr, 0) < 0 && errno == EINTR) continue;
    return -1;
  }
  return pid;
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& argv) {
  ProcessResult result;
  // It reads nothing, and what it writes comes through a pipe.
  int ends[2];
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing < 0 || pipe2(ends, O_CLOEXEC) != 0) {
    result.output = argv[0] + ": cannot start it: " + std::strerror(errno) + "\n";
    if (nothing >= 0) close(nothing);
    return result;
  }
  std::vector<char*> raw;
  for (const auto& a : argv) raw.push_back(const_cast<char*>(a.c_str()));
  raw.push_back(nullptr);
  int why = 0;
  const pid_t pid = start(raw.data(), ends[1], nothing, why);
  close(ends[1]);
  close(nothing);
  if (pid < 0) {
    close(ends[0]);
    result.output = argv[0] + ": cannot start it: " + std::string(std::strerror(why)) + "\n";
    return result;
  }
  const std::size_t slot = note_child(pid);
  // Read it to the end, so that it never waits for us; what is too much is thrown away.
  char buffer[4096];
  for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) != 0;) {
    if (n < 0 && errno != EINTR) break;
    if (n > 0 && result.output.size() < kMostOutputBytes) result.output.append(buffer, std::size_t(n));
  }
  close(ends[0]);
  // its number stays its own until it is waited for, so only then it is forgotten
  siginfo_t info;
  while (waitid(P_PID, id_t(pid), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) continue;
  forget_child(slot);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : kBySignal + WTERMSIG(status);
  return result;
}

void end_children() {
  ending = true;
  for (const auto& child : children)
    if (const pid_t pid = child.load(); pid > 0) kill(-pid, SIGKILL);
}

ChildGroup::ChildGroup(pid_t pid) {
  setpgid(pid, pid);  // both sides do it, for neither knows who comes first
  slot_ = note_child(pid);
}
ChildGroup::~ChildGroup() { forget_child(slot_); }

void lead_child_group(pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) signal(s, SIG_DFL);
  if (getppid() != parent) _exit(127);
}

}  // namespace cc
