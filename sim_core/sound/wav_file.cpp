// SPDX-License-Identifier: MIT
#include "sim_core/sound/wav_file.h"

#include <algorithm>

#include "sim_core/base/input_file.h"

namespace sim {
namespace {

constexpr std::size_t kLongestFile = 64u << 20;  // bytes: twelve minutes at 44.1 kHz, 16 bits, mono
constexpr std::uint32_t kLowestRateHz = 1000;
constexpr std::uint32_t kHighestRateHz = 192000;

std::uint32_t little(std::string_view bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = count - 1; i >= 0; --i)
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

void put(std::string& out, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

}  // namespace

std::string parse_wav(std::string_view bytes, WavSound& out) {
  if (bytes.size() < 12 || bytes.substr(0, 4) != "RIFF" || bytes.substr(8, 4) != "WAVE")
    return "got a file that does not begin as a WAV file does, expected \"RIFF....WAVE\"";
  // Chunks: the format, and the first one with samples; all others are passed over.
  std::uint32_t channels = 0, bits = 0, rate = 0;
  std::string_view data;
  bool has_data = false;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::string_view name = bytes.substr(at, 4);
    const std::size_t said = little(bytes, at + 4, 4);
    const std::size_t begin = at + 8;
    // a file that was cut off, or that is still being written, gives what is there
    const std::size_t length = std::min(said, bytes.size() - begin);
    if (name == "fmt ") {
      if (length < 16) return "got a short \"fmt \" chunk, expected at least 16 bytes";
      const std::uint32_t format = little(bytes, begin, 2);
      if (format != 1)
        return "got samples of format " + std::to_string(format) + ", expected 1 (uncompressed)";
      channels = little(bytes, begin + 2, 2);
      rate = little(bytes, begin + 4, 4);
      bits = little(bytes, begin + 14, 2);
    } else if (name == "data" && !has_data) {
      data = bytes.substr(begin, length);
      has_data = true;
    }
    if (said > bytes.size() - begin) break;
    at = begin + said + (said & 1);
  }
  // Is the format one that we know?
  if (channels == 0 && bits == 0) return "got no \"fmt \" chunk, expected one before the samples";
  if (channels != 1 && channels != 2) return "got " + std::to_string(channels) + " channels, expected 1 or 2";
  if (bits != 8 && bits != 16) return "got " + std::to_string(bits) + " bits a sample, expected 8 or 16";
  if (rate < kLowestRateHz || rate > kHighestRateHz)
    return "got " + std::to_string(rate) + " samples a second, expected " + std::to_string(kLowestRateHz) +
           " to " + std::to_string(kHighestRateHz);
  const std::size_t frame = channels * bits / 8;
  if (!has_data || data.size() < frame) return "got no samples, expected a \"data\" chunk with at least one";

  // Samples from -1 to 1, the mean of both channels.
  out.rate_hz = rate;
  out.samples.clear();
  out.samples.reserve(data.size() / frame);
  for (std::size_t at = 0; at + frame <= data.size(); at += frame) {
    double sum = 0;
    for (std::uint32_t c = 0; c < channels; ++c) {
      const std::size_t place = at + c * bits / 8;
      // 8 bits count from 0 with silence at 128; 16 bits are signed
      sum += bits == 8 ? (little(data, place, 1) - 128.0) / 128.0
                       : static_cast<std::int16_t>(little(data, place, 2)) / 32768.0;
    }
    out.samples.push_back(static_cast<float>(sum / channels));
  }
  return {};
}

std::string read_wav(const std::string& path, WavSound& out) {
  std::string text;
  const std::string wrong = read_input_file(path, kLongestFile, text);
  return wrong.empty() ? parse_wav(text, out) : wrong;
}

std::string wav_header(int rate_hz, std::uint32_t samples) {
  std::string out = "RIFF";
  put(out, 36 + 2 * samples, 4);
  out += "WAVEfmt ";
  put(out, 16, 4);
  put(out, 1, 2);                                        // uncompressed
  put(out, 1, 2);                                        // channels
  put(out, static_cast<std::uint32_t>(rate_hz), 4);      // samples a second
  put(out, static_cast<std::uint32_t>(2 * rate_hz), 4);  // bytes a second
  put(out, 2, 2);                                        // bytes of all channels
  put(out, 16, 2);                                       // bits
  out += "data";
  put(out, 2 * samples, 4);
  return out;
}

}  // namespace sim
