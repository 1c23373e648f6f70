// SPDX-License-Identifier: MIT
// WAV files in and out, by libsndfile: any samples that it decodes, one or two channels (two are averaged).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

struct sf_private_tag;  // libsndfile's file

namespace sim {

struct WavSound {
  double rate_hz = 0;          ///< samples per second
  std::vector<float> samples;  ///< -1 to 1
};

/// Reads a file into `out`. Returns what is wrong as "got ..., expected ...", or an empty string. A file that was
/// cut off, or that is still being written, gives what is there.
std::string read_wav(const std::string& path, WavSound& out);

/// Same for bytes already in memory.
std::string parse_wav(std::string_view bytes, WavSound& out);

/// A file of 16-bit samples, one channel, that grows: after every append() what is in the file is a whole
/// WAV file, so a crash loses nothing. Nothing throws; the first error is kept.
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

 private:
  std::string path_;
  sf_private_tag* file_ = nullptr;
  std::int64_t samples_ = 0;
  std::string error_;
};

}  // namespace sim
