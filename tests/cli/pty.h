// SPDX-License-Identifier: MIT
// Runs the `twinpuck` command on a terminal of its own: what it shows there, and what a person types.
#pragma once
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>

#include <array>

#include "tests/cli/command.h"

namespace cli_test {

/// The command on a terminal of its own.
class Pty {
 public:
  explicit Pty(const std::string& arguments, const std::vector<std::string>& environment = {},
               int columns = 80, int rows = 24) {
    winsize size{};
    size.ws_col = static_cast<unsigned short>(columns);
    size.ws_row = static_cast<unsigned short>(rows);
    pid_ = forkpty(&fd_, nullptr, nullptr, &size);
    if (pid_ == 0) {
      unsetenv("NO_COLOR");
      if (chdir(TWINPUCK_SOURCE_DIR) != 0) _exit(127);
      setenv("TERM", "xterm-256color", 1);
      for (const std::string& e : environment) putenv(const_cast<char*>(e.c_str()));
      execl("/bin/sh", "sh", "-c", ("exec '" + executable() + "' " + arguments).c_str(), nullptr);
      _exit(127);
    }
    tcgetattr(fd_, &before_);
  }
  ~Pty() {
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
    close(fd_);
  }
  /// Reads until `text` has come behind what was read before; false where it never does.
  bool until(const std::string& text) {
    for (int patience = 0; patience < 400; ++patience) {
      if (const std::size_t at = said.find(text, seen_); at != std::string::npos) {
        seen_ = at + text.size();
        return true;
      }
      if (!read_some(50) && ended_) return false;
    }
    return false;
  }
  /// Whatever comes in so many ms, and on a busy machine later.
  void listen(int ms) {
    for (int quiet = 0; quiet < ms;) quiet = read_some(50) ? 0 : quiet + 50;
  }
  void type(const std::string& keys) {
    EXPECT_EQ(write(fd_, keys.data(), keys.size()), ssize_t(keys.size()));
  }
  void resize(int columns, int rows) {
    winsize size{};
    size.ws_col = static_cast<unsigned short>(columns);
    size.ws_row = static_cast<unsigned short>(rows);
    ioctl(fd_, TIOCSWINSZ, &size);
  }
  void signal(int number) { kill(pid_, number); }
  bool is_as_before() const {
    termios now;
    return tcgetattr(fd_, &now) == 0 && now.c_lflag == before_.c_lflag &&
           now.c_cc[VSUSP] == before_.c_cc[VSUSP];
  }
  /// Its exit code, or 128 and its signal.
  int end() {
    for (int patience = 0; !ended_ && patience < 400; ++patience) read_some(50);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string said;

 private:
  bool read_some(int ms) {
    pollfd p{fd_, POLLIN, 0};
    if (poll(&p, 1, ms) <= 0) return false;
    std::array<char, 65536> buffer;
    const ssize_t n = read(fd_, buffer.data(), buffer.size());
    ended_ = n <= 0;
    if (n > 0) said.append(buffer.data(), static_cast<std::size_t>(n));
    return n > 0;
  }
  int fd_ = -1;
  pid_t pid_ = 0;
  termios before_{};
  std::size_t seen_ = 0;
  bool ended_ = false;
};

}  // namespace cli_test
