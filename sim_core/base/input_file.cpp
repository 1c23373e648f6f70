// SPDX-License-Identifier: MIT
#include "sim_core/base/input_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace sim {
namespace {

constexpr std::size_t kPiece = 4096;  // bytes, at least that many at once

std::string why() { return std::string("cannot be read: ") + std::strerror(errno); }

std::string read_open_file(int file, std::size_t most_bytes, std::string& text) {
  struct stat info {};
  if (::fstat(file, &info) != 0) return why();
  if (S_ISDIR(info.st_mode)) return "got a folder, expected a file";
  if (!S_ISREG(info.st_mode) && !S_ISFIFO(info.st_mode)) return "got a device, expected a regular file";
  // room for one byte more than it is said to hold, so that its end is met without more room
  const std::size_t told = static_cast<std::size_t>(S_ISREG(info.st_mode) ? info.st_size : 0);
  std::size_t had = 0;
  text.resize(std::min(std::max(told, kPiece), most_bytes) + 1);
  while (had <= most_bytes) {
    if (had == text.size()) text.resize(std::min(2 * had, most_bytes + 1));
    const ssize_t got = ::read(file, text.data() + had, text.size() - had);
    if (got == 0) {
      text.resize(had);
      return {};
    }
    if (got < 0 && errno == EAGAIN) {  // a pipe whose writer has not come to it yet
      pollfd wait{file, POLLIN, 0};
      ::poll(&wait, 1, -1);
    } else if (got < 0 && errno != EINTR) {
      return why();
    } else if (got > 0) {
      had += static_cast<std::size_t>(got);
    }
  }
  return "got more than " + std::to_string(most_bytes) + " bytes, expected at most that";
}

}  // namespace

std::string read_input_file(const std::string& path, std::size_t most_bytes, std::string& text) {
  text.clear();
  // opening does not wait for the writer of a pipe: one without a writer is an empty file
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (file < 0) return why();
  std::string wrong = read_open_file(file, most_bytes, text);
  ::close(file);
  if (!wrong.empty()) text.clear();
  return wrong;
}

}  // namespace sim
