// SPDX-License-Identifier: MIT
#include "memory_limit.h"

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <new>

namespace cc {
namespace {

struct LastWords {
  std::string of_memory, of_file, of_time;
};
LastWords& last_words() {
  static LastWords words;
  return words;
}

[[noreturn]] void say_and_end(const std::string& words) {
  const ssize_t written = write(STDERR_FILENO, words.data(), words.size());
  _exit(written < 0 ? 2 : 1);
}

void bound(int what, std::uint64_t most) {
  rlimit limit;
  if (getrlimit(what, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, most);
  setrlimit(what, &limit);
}

}  // namespace

void bound_memory(std::uint64_t bytes) { bound(RLIMIT_AS, bytes); }

void limit_own_memory(const std::string& what) {
  const auto words = [&](const char* of, std::uint64_t bytes) {
    return what + ": " + of + ": got more than " + std::to_string(bytes >> 20) +
           " MB, expected at most that; does a macro, an array or .space grow without end?\n";
  };
  last_words().of_memory = words("memory", kMostToolBytes);
  last_words().of_file = words("output", kMostToolFileBytes);
  rlimit shells{};
  if (getrlimit(RLIMIT_FSIZE, &shells) == 0 && shells.rlim_cur < kMostToolFileBytes)
    last_words().of_file = what + ": output: got File too large (the shell's limit is " +
                           std::to_string(shells.rlim_cur) +
                           " bytes, ulimit -f), expected a file that can be written\n";
  bound(RLIMIT_FSIZE, kMostToolFileBytes);
  signal(SIGXFSZ, [](int) { say_and_end(last_words().of_file); });
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  bound_memory(kMostToolBytes);
  std::set_new_handler(end_without_memory);
#endif
}

void limit_own_time(const std::string& what) {
  bound(RLIMIT_CPU, kMostToolSeconds);
  rlimit limit{kMostToolSeconds, 0};
  getrlimit(RLIMIT_CPU, &limit);  // somebody may have said less
  last_words().of_time =
      what + ": compile time: got more than " + std::to_string(limit.rlim_cur) +
      " s of processor time, expected at most that; does a macro grow without end, or is a "
      "function or a switch huge? split it\n";
  signal(SIGXCPU, [](int) { say_and_end(last_words().of_time); });
}

void end_without_memory() { say_and_end(last_words().of_memory); }

}  // namespace cc
