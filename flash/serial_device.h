// SPDX-License-Identifier: MIT
// A serial device of this PC: /dev/rfcomm0, /dev/ttyUSB0, or the pty of a simulated robot.
#pragma once
#include <string>

#include "flash/upload.h"

namespace flash {

class SerialDevice : public SerialLine {
 public:
  /// Opens it raw at 115,200 baud, 8N1; nobody else may have it open. Errors: error() is not empty.
  explicit SerialDevice(const std::string& path);
  ~SerialDevice() override;
  SerialDevice(const SerialDevice&) = delete;

  bool write(const std::vector<std::uint8_t>& bytes) override;
  std::optional<std::uint8_t> read(double seconds) override;
  double now_s() const override;
  /// "PATH: cannot be opened: ..."
  const std::string& error() const { return error_; }

 private:
  int fd_ = -1;
  std::string error_;
};

}  // namespace flash
