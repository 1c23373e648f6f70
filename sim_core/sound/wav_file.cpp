// SPDX-License-Identifier: MIT
#include "sim_core/sound/wav_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sndfile.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>

#include "sim_core/base/input_file.h"
#include "sim_core/base/output_file.h"

namespace sim {
namespace {

constexpr std::size_t kLongestFile = 64u << 20;   // bytes: twelve minutes at 44.1 kHz, 16 bits, mono
constexpr std::size_t kMostRead = 64u << 20;      // samples: a short file may be long when it is unpacked
constexpr std::size_t kUnknownSize = 0x7FFF0000;  // and more: what sox and ffmpeg say of a stream
constexpr int kLowestRateHz = 1000;
constexpr int kHighestRateHz = 192000;
constexpr std::int64_t kMostWritten = (INT64_C(1) << 31) - 64;  // sizes in the header have 32 bits

/// A file in memory, as libsndfile asks for it.
struct Memory {
  std::string_view bytes;
  sf_count_t at = 0;

  static Memory& of(void* user) { return *static_cast<Memory*>(user); }
  static sf_count_t length(void* user) { return static_cast<sf_count_t>(of(user).bytes.size()); }
  static sf_count_t tell(void* user) { return of(user).at; }
  static sf_count_t seek(sf_count_t offset, int from, void* user) {
    const sf_count_t base = from == SEEK_SET ? 0 : from == SEEK_CUR ? of(user).at : length(user);
    return of(user).at = std::clamp<sf_count_t>(base + offset, 0, length(user));
  }
  static sf_count_t read(void* to, sf_count_t count, void* user) {
    count = std::clamp<sf_count_t>(count, 0, length(user) - of(user).at);
    std::memcpy(to, of(user).bytes.data() + of(user).at, static_cast<std::size_t>(count));
    of(user).at += count;
    return count;
  }
};

struct Closes {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

std::string four_bytes(std::size_t value) {
  std::string four;
  for (int shift = 0; shift < 32; shift += 8) four += static_cast<char>(value >> shift & 0xFF);
  return four;
}

/// The chunks that samples need, as a file of its own with sizes that are right. libsndfile goes on for minutes through a
/// chunk of another kind that says it is longer than the file.
/// `cut`: what is wrong with a file that ends within its samples.
std::string samples_alone(std::string_view bytes, std::string& cut) {
  constexpr std::size_t kHead = 8;
  std::string chunks = "WAVE";
  for (std::size_t at = 12; at + kHead <= bytes.size();) {
    const std::string_view id = bytes.substr(at, 4);
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i)
      size |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + 4 + i])) << 8 * i;
    const std::size_t rest = bytes.size() - at - kHead;
    const bool is_data = id == "data";
    // whoever wrote it to a pipe did not know how much would come
    if (is_data && (size == 0 || size >= kUnknownSize)) size = rest;
    if (is_data && size > rest) {
      cut = fmt::format("got {} of {} bytes of samples, expected a whole file", rest, size);
      return "";
    }
    if (size > rest) break;
    if (is_data || id == "fmt " || id == "fact") {
      chunks += id;
      chunks += four_bytes(size);
      chunks += bytes.substr(at + kHead, size);
      if (size % 2 == 1) chunks += '\0';
    }
    if (is_data) break;
    at += kHead + size + size % 2;
  }
  return "RIFF" + four_bytes(chunks.size()) + chunks;
}

/// The system's reason, where it has one, says more than libsndfile's.
std::string refused(const std::string& path, SNDFILE* file) {
  return fmt::format("{}: cannot be written: {}", path, errno ? std::strerror(errno) : sf_strerror(file));
}

}  // namespace

std::string parse_wav(std::string_view bytes, WavSound& out) {
  // libsndfile reads other formats, too, by what it finds
  if (bytes.size() < 12 || bytes.substr(0, 4) != "RIFF" || bytes.substr(8, 4) != "WAVE")
    return "got a file that does not begin as a WAV file does, expected \"RIFF....WAVE\"";
  std::string cut;
  const std::string alone = samples_alone(bytes, cut);
  if (!cut.empty()) return cut;
  // it would decode MPEG, too, by a library that writes to the terminal
  if (const std::size_t format = alone.find("fmt "); format < alone.size() - 9 && alone[format + 9] == 0)
    if (const char number = alone[format + 8]; number == 0x50 || number == 0x55)
      return "got samples in MPEG, expected a WAV file of another format";
  SF_VIRTUAL_IO access{Memory::length, Memory::seek, Memory::read, nullptr, Memory::tell};
  Memory memory{alone};
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, Closes> file(sf_open_virtual(&access, SFM_READ, &info, &memory));
  if (!file)
    return fmt::format("got a WAV file that cannot be read ({}), expected a whole one", sf_strerror(nullptr));
  if (info.channels != 1 && info.channels != 2)
    return fmt::format("got {} channels, expected 1 or 2", info.channels);
  if (info.samplerate < kLowestRateHz || info.samplerate > kHighestRateHz)
    return fmt::format("got {} samples a second, expected {} to {}", info.samplerate, kLowestRateHz,
                       kHighestRateHz);

  // Samples from -1 to 1, the mean of both channels. Numbers with a point may be larger, or none.
  out.rate_hz = info.samplerate;
  out.samples.clear();
  std::array<double, 4096> block;
  while (const sf_count_t frames = sf_readf_double(file.get(), block.data(),
                                                   static_cast<sf_count_t>(block.size()) / info.channels)) {
    if (out.samples.size() + static_cast<std::size_t>(frames) > kMostRead)
      return fmt::format("got more samples than {}, expected a shorter sound", kMostRead);
    for (sf_count_t i = 0; i < frames; ++i) {
      const double* const frame = block.data() + i * info.channels;
      const double mean = info.channels == 1 ? frame[0] : (frame[0] + frame[1]) / 2;
      out.samples.push_back(std::isnan(mean) ? 0 : static_cast<float>(std::clamp(mean, -1.0, 1.0)));
    }
  }
  return out.samples.empty() ? "got no samples, expected a \"data\" chunk with at least one" : "";
}

std::string read_wav(const std::string& path, WavSound& out) {
  std::string text;
  const std::string wrong = read_input_file(path, kLongestFile, text);
  return wrong.empty() ? parse_wav(text, out) : wrong;
}

WavRecorder::WavRecorder(std::string path, int rate_hz) : path_(std::move(path)) {
  std::string why_not;
  const int opened = open_output(path_, O_RDWR, why_not);
  if (opened < 0) {
    error_ = path_ + ": cannot be written: " + why_not;
    return;
  }
  SF_INFO info{};
  info.samplerate = rate_hz;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
  // a device cannot be cut, and has nothing to be cut off
  if (::ftruncate(opened, 0) == 0 || errno == EINVAL) file_ = sf_open_fd(opened, SFM_WRITE, &info, SF_TRUE);
  if (!file_) {
    error_ = refused(path_, nullptr);
    return;
  }
  // the header is there at once, and is written anew behind all samples
  sf_command(file_, SFC_UPDATE_HEADER_NOW, nullptr, 0);
  sf_command(file_, SFC_SET_UPDATE_HEADER_AUTO, nullptr, SF_TRUE);
}

WavRecorder::~WavRecorder() {
  if (file_) sf_close(file_);
}

bool WavRecorder::append(const std::vector<std::int16_t>& samples) {
  if (!is_good() || samples.empty()) return is_good();
  const auto count = static_cast<sf_count_t>(samples.size());
  samples_ += count;
  errno = 0;
  if (samples_ > kMostWritten)
    error_ =
        fmt::format("{}: got more samples than a WAV file holds, expected at most {}", path_, kMostWritten);
  else if (sf_write_short(file_, samples.data(), count) != count)
    error_ = refused(path_, file_);
  return is_good();
}

}  // namespace sim
