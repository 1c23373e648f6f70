// SPDX-License-Identifier: MIT
// A WAV file of 16-bit samples, one channel, that grows: after every append() what is in the file is a whole
// WAV file, so a crash loses nothing. Nothing throws; the first error is kept.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sim {

class WavRecorder {
 public:
  /// Creates or empties the file.
  WavRecorder(std::string path, int rate_hz);
  ~WavRecorder();
  WavRecorder(const WavRecorder&) = delete;
  WavRecorder& operator=(const WavRecorder&) = delete;

  /// False from the first failure on.
  bool append(const std::vector<std::int16_t>& samples);
  bool is_good() const { return error_.empty(); }
  const std::string& error() const { return error_; }  ///< "path: cannot be written: reason"; empty: none
  std::int64_t samples() const { return samples_; }

 private:
  void write_at(const std::string& bytes, std::int64_t place);

  std::string path_;
  int rate_hz_;
  int file_ = -1;
  std::int64_t samples_ = 0;
  std::string error_;
};

}  // namespace sim
