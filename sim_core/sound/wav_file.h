// SPDX-License-Identifier: MIT
// WAV files with uncompressed samples: 8 or 16 bits, one or two channels (two are averaged). Other chunks
// than "fmt " and "data" are skipped. Source: the RIFF/WAVE format as published by Microsoft and IBM, 1991.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sim {

struct WavSound {
  double rate_hz = 0;          ///< samples per second
  std::vector<float> samples;  ///< -1 to 1
};

/// Reads a file into `out`. Returns what is wrong as "got ..., expected ...", or an empty string.
std::string read_wav(const std::string& path, WavSound& out);

/// Same for bytes already in memory.
std::string parse_wav(std::string_view bytes, WavSound& out);

/// The 44 bytes that begin a file of 16-bit samples, one channel.
std::string wav_header(int rate_hz, std::uint32_t samples);

}  // namespace sim
