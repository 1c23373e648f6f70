// SPDX-License-Identifier: MIT
// A line of the shell, and what it said.
#pragma once
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace shell {

struct Said {
  int exit_code = -1;  ///< 128 and the signal's number: a signal has ended it
  std::string text;    ///< stdout; and stderr, where the line says 2>&1
};

inline Said run(const std::string& line) {
  Said said;
  FILE* const pipe = popen(line.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    said.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  said.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return said;
}

}  // namespace shell
