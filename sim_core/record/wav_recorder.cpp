// SPDX-License-Identifier: MIT
#include "sim_core/record/wav_recorder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sim_core/sound/wav_file.h"

namespace sim {
namespace {
constexpr std::int64_t kHeaderBytes = 44;
constexpr std::int64_t kMostSamples = (INT64_C(1) << 31) - 64;  // sizes in the header have 32 bits
}  // namespace

WavRecorder::WavRecorder(std::string path, int rate_hz) : path_(std::move(path)), rate_hz_(rate_hz) {
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) {
    error_ = fmt::format("{}: cannot be written: {}", path_, std::strerror(errno));
    return;
  }
  write_at(wav_header(rate_hz_, 0), 0);
}

WavRecorder::~WavRecorder() {
  if (file_ >= 0) ::close(file_);
}

bool WavRecorder::append(const std::vector<std::int16_t>& samples) {
  if (!is_good() || samples.empty()) return is_good();
  const auto count = static_cast<std::int64_t>(samples.size());
  if (samples_ + count > kMostSamples) {
    error_ =
        fmt::format("{}: got more samples than a WAV file holds, expected at most {}", path_, kMostSamples);
    return false;
  }
  std::string bytes;
  bytes.reserve(samples.size() * 2);
  for (const std::int16_t sample : samples) {
    bytes += static_cast<char>(sample & 0xFF);
    bytes += static_cast<char>(sample >> 8 & 0xFF);
  }
  // samples first: a header that promises less than there is does no harm
  write_at(bytes, kHeaderBytes + 2 * samples_);
  samples_ += count;
  write_at(wav_header(rate_hz_, static_cast<std::uint32_t>(samples_)), 0);
  return is_good();
}

void WavRecorder::write_at(const std::string& bytes, std::int64_t place) {
  std::size_t done = 0;
  while (is_good() && done < bytes.size()) {
    const ssize_t wrote = ::pwrite(file_, bytes.data() + done, bytes.size() - done,
                                   static_cast<off_t>(place + static_cast<std::int64_t>(done)));
    if (wrote > 0) {
      done += static_cast<std::size_t>(wrote);
    } else if (errno != EINTR) {
      error_ = fmt::format("{}: cannot be written: {}", path_, std::strerror(errno));
    }
  }
}

}  // namespace sim
