// SPDX-License-Identifier: MIT
#include "hal_sim/board/displays.h"

#include <algorithm>
#include <cstdlib>

namespace board {

namespace {
constexpr int kMostPixels = 4096;  // a side
constexpr std::size_t kMostImages =
    100;  // kept at once: a program that forgets to delete them does not fill the PC
}  // namespace

std::vector<std::uint8_t> DisplayImage::rgb() const {
  std::vector<std::uint8_t> out;
  out.reserve(3 * pixels.size());
  for (const std::uint32_t p : pixels)
    for (const int shift : {16, 8, 0}) out.push_back(static_cast<std::uint8_t>(p >> shift));
  return out;
}

DisplayImage Display::blank(int width, int height) {
  DisplayImage image;
  image.width = std::clamp(width, 0, kMostPixels);
  image.height = std::clamp(height, 0, kMostPixels);
  image.pixels.assign(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                      0xFF000000u);
  return image;
}

void Display::put(int x, int y) {
  if (x < 0 || y < 0 || x >= screen_.width || y >= screen_.height) return;
  std::uint32_t& pixel =
      screen_.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(screen_.width) +
                     static_cast<std::size_t>(x)];
  std::uint32_t mixed = 0;
  const auto mix = [&](int shift, double wanted) {
    const double before = pixel >> shift & 0xFF;
    mixed |= static_cast<std::uint32_t>(before + (wanted - before) * opacity_ + 0.5) << shift;
  };
  mix(24, 255 * alpha_);
  for (const int shift : {16, 8, 0}) mix(shift, colour_ >> shift & 0xFF);
  pixel = mixed;
}

/// Bresenham's line.
void Display::line(int x0, int y0, int x1, int y1) {
  const int dx = std::abs(x1 - x0), dy = -std::abs(y1 - y0), sx = x0 < x1 ? 1 : -1, sy = y0 < y1 ? 1 : -1;
  int error = dx + dy;
  for (;;) {
    put(x0, y0);
    if (x0 == x1 && y0 == y1) return;
    const int twice = 2 * error;
    if (twice >= dy) error += dy, x0 += sx;
    if (twice <= dx) error += dx, y0 += sy;
  }
}

void Display::draw(const std::int16_t* x, const std::int16_t* y, int points) {
  if (points == 1) put(x[0], y[0]);
  for (int i = 1; i < points; ++i) line(x[i - 1], y[i - 1], x[i], y[i]);
}

void Display::fill(const std::int16_t* x, const std::int16_t* y, int points) {
  if (points < 1) return;
  const int top = std::max<int>(0, *std::min_element(y, y + points));
  const int bottom = std::min<int>(screen_.height - 1, *std::max_element(y, y + points));
  for (int row = top; row <= bottom; ++row) {
    std::vector<double> crossings;
    for (int i = 0; i < points; ++i) {
      const int j = (i + 1) % points, from = std::min(y[i], y[j]), to = std::max(y[i], y[j]);
      if (row < from || row > to) continue;
      if (y[i] == y[j]) {
        crossings.push_back(x[i]);
        crossings.push_back(x[j]);
      } else {
        crossings.push_back(x[i] + double(row - y[i]) * (x[j] - x[i]) / (y[j] - y[i]));
      }
    }
    if (crossings.empty()) continue;
    // shapes are convex but for a polygon of the program's own, whose dents are filled as well
    const auto [left, right] = std::minmax_element(crossings.begin(), crossings.end());
    const int end = std::min(screen_.width - 1, static_cast<int>(*right + 0.5));
    for (int column = std::max(0, static_cast<int>(*left + 0.5)); column <= end; ++column) put(column, row);
  }
}

int Display::keep(DisplayImage image) {
  if (images_.size() >= kMostImages) return 0;
  images_[++last_] = std::move(image);
  return last_;
}

int Display::copy(int x, int y, int width, int height) {
  DisplayImage image = blank(width, height);
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      if (x + column >= 0 && x + column < screen_.width && y + row >= 0 && y + row < screen_.height)
        image.pixels[static_cast<std::size_t>(row * image.width + column)] =
            screen_.pixels[static_cast<std::size_t>((y + row) * screen_.width + x + column)];
  return keep(std::move(image));
}

int Display::make(int width, int height, const unsigned char* bytes, int bytes_a_pixel, const int order[4]) {
  DisplayImage image = blank(width, height);
  for (std::uint32_t& pixel : image.pixels) {
    pixel = 0;
    for (int c = 0; c < 4; ++c)
      pixel |= std::uint32_t{order[c] < 0 ? std::uint8_t{255} : bytes[order[c]]}
               << (c == 3 ? 24 : 16 - 8 * c);
    bytes += bytes_a_pixel;
  }
  return keep(std::move(image));
}

void Display::paste(int image, int x, int y, bool blend) {
  const DisplayImage* from = this->image(image);
  if (!from || image == 0) return;
  for (int row = 0; row < from->height; ++row)
    for (int column = 0; column < from->width; ++column) {
      const int to_x = x + column, to_y = y + row;
      if (to_x < 0 || to_x >= screen_.width || to_y < 0 || to_y >= screen_.height) continue;
      const std::uint32_t pixel = from->pixels[static_cast<std::size_t>(row * from->width + column)];
      if (!blend || pixel >> 24 >= 128)
        screen_.pixels[static_cast<std::size_t>(to_y * screen_.width + to_x)] = pixel;
    }
}

const DisplayImage* Display::image(int number) const {
  if (number == 0) return &screen_;
  const auto found = images_.find(number);
  return found == images_.end() ? nullptr : &found->second;
}

}  // namespace board
