// SPDX-License-Identifier: MIT
// The two ends of a serial line that programs of this machine talk to. Descriptors are non-blocking. Over
// Bluetooth the link has flow control: a program that reads slower than the robot sends loses nothing here
// either, up to kMostWaiting bytes; then the newest are lost, and the robot loses no time.
#pragma once
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>

#include "hal_sim/board/uart_end.h"

namespace board {

inline constexpr std::size_t kMostWaiting = std::size_t{1} << 20;  // bytes [assumed: ten minutes of pictures]

/// What the system said to the last call that failed: the text of errno.
inline std::string system_error() { return std::strerror(errno); }

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void reset(int fd = -1) {
    if (fd_ >= 0) ::close(fd_);
    fd_ = fd;
  }
  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }

 private:
  int fd_;
};

/// A pseudo-terminal with a symbolic link to it (none if `link` is empty). Null, and why, on failure.
std::unique_ptr<UartEnd> open_pty_end(const std::string& link, std::string& error);
/// A server on 127.0.0.1; port 0 takes a free one. Null, and why, on failure.
std::unique_ptr<UartEnd> open_tcp_end(int port, std::string& error);

}  // namespace board
