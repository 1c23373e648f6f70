// SPDX-License-Identifier: MIT
#include "flash/serial_device.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>

namespace flash {

SerialDevice::SerialDevice(const std::string& path) {
  fd_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) {
    error_ = path + ": cannot be opened: " + std::strerror(errno);
    return;
  }
  termios settings{};
  if (tcgetattr(fd_, &settings) != 0) {
    error_ = path + ": got a file, expected a serial device such as /dev/rfcomm0 or /dev/ttyUSB0";
    return;
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  cfsetspeed(&settings, B115200);
  if (tcsetattr(fd_, TCSANOW, &settings) != 0 || ioctl(fd_, TIOCEXCL) != 0)
    error_ = path + ": cannot be set to 115,200 baud: " + std::strerror(errno);
  tcflush(fd_, TCIOFLUSH);
}

SerialDevice::~SerialDevice() {
  if (fd_ < 0) return;
  tcdrain(fd_);
  ioctl(fd_, TIOCNXCL);
  ::close(fd_);
}

bool SerialDevice::write(const std::vector<std::uint8_t>& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t n = ::write(fd_, bytes.data() + sent, bytes.size() - sent);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
      continue;
    }
    if (n < 0 && errno != EAGAIN && errno != EINTR) return false;
    pollfd wait{fd_, POLLOUT, 0};
    if (poll(&wait, 1, 5000) <= 0) return false;
  }
  return true;
}

std::optional<std::uint8_t> SerialDevice::read(double seconds) {
  const double end = now_s() + seconds;
  while (true) {
    std::uint8_t byte;
    if (::read(fd_, &byte, 1) == 1) return byte;
    const double left = end - now_s();
    if (left <= 0) return std::nullopt;
    pollfd wait{fd_, POLLIN, 0};
    poll(&wait, 1, static_cast<int>(std::ceil(1000 * left)));
    // a robot that is gone hangs up, and would be polled again at once
    if (wait.revents & (POLLHUP | POLLERR)) usleep(10000);
  }
}

double SerialDevice::now_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace flash
