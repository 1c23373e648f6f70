// SPDX-License-Identifier: MIT
// Pictures that programs write.
#pragma once
#include <png.h>

#include <cstdint>
#include <string>
#include <vector>

namespace fake {

/// Rows of a picture as text, '.' black, '#' white, else '+'; empty: no picture.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> argb;
  std::string text() const {
    std::string out;
    for (int y = 0; y < height; ++y, out += '\n')
      for (int x = 0; x < width; ++x) {
        const std::uint32_t p = argb[static_cast<std::size_t>(y * width + x)] & 0xFFFFFF;
        out += p == 0 ? '.' : p == 0xFFFFFF ? '#' : '+';
      }
    return out;
  }
};

inline Picture read_picture(const std::string& file) {
  Picture picture;
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, file.c_str())) return picture;
  png.format = PNG_FORMAT_BGRA;
  picture.width = static_cast<int>(png.width);
  picture.height = static_cast<int>(png.height);
  picture.argb.resize(png.width * png.height);
  png_image_finish_read(&png, nullptr, picture.argb.data(), 0, nullptr);
  return picture;
}

}  // namespace fake
