// SPDX-License-Identifier: MIT
// Reads a film back, pixel by pixel: WebM by libwebm's parser and libvpx, animated PNG chunk by chunk.
// Nothing here shares code with what writes them.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace film_test {

struct Read {
  std::string error;  ///< empty: whole and good
  int width_px = 0, height_px = 0;
  double duration_s = 0;  ///< as the file says; 0: it does not
  bool has_index = false;
  std::vector<double> time_s;  ///< when each frame is shown
  /// Per frame three bytes a pixel, rows from the top.
  std::vector<std::vector<std::uint8_t>> rgb;
};

/// Frames that cannot be read end the film; what came before them is kept.
Read read_webm(const std::string& path);
Read read_apng(const std::string& path);

}  // namespace film_test
