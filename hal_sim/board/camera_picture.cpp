// SPDX-License-Identifier: MIT
// What a program got from its camera, as colours.
#include <algorithm>

#include "hal_sim/board/camera.h"

namespace board {

namespace {
std::uint8_t clamp(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }
}  // namespace

std::vector<std::uint8_t> decode_picture(const CameraPicture& picture) {
  using Format = SensorSetup::Format;
  const std::size_t pixels =
      static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows);
  const std::size_t step = pixels ? std::max<std::size_t>(1, picture.bytes.size() / pixels) : 1;
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * pixels);
  const auto byte = [&](std::size_t i) {
    return i < picture.bytes.size() ? picture.bytes[i] : std::uint8_t{0};
  };
  // a program that asks for one byte of a pixel of two sees just that byte
  const Format format = step < 2 ? Format::Grey : picture.format;
  for (std::size_t p = 0; p < pixels; ++p) {
    const int first = byte(p * step), second = byte(p * step + 1);
    if (format == Format::Rgb565) {
      const int r = first >> 3, g = (first & 7) << 3 | second >> 5, b = second & 31;
      rgb.push_back(static_cast<std::uint8_t>(r << 3 | r >> 2));
      rgb.push_back(static_cast<std::uint8_t>(g << 2 | g >> 4));
      rgb.push_back(static_cast<std::uint8_t>(b << 3 | b >> 2));
    } else if (format == Format::Yuv) {
      // blue difference with even pixels, red difference with odd ones
      const bool even = p % static_cast<std::size_t>(picture.columns) % 2 == 0;
      const std::size_t other = even ? p + 1 : p - 1;
      const double mine = second - 128.0, his = byte(other * step + 1) - 128.0;
      const double cb = even ? mine : his, cr = even ? his : mine;
      rgb.push_back(clamp(first + cr / 0.713));
      rgb.push_back(clamp(first - 0.714 * cr - 0.344 * cb));
      rgb.push_back(clamp(first + cb / 0.564));
    } else {
      for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<std::uint8_t>(first));
    }
  }
  return rgb;
}

}  // namespace board
