// SPDX-License-Identifier: MIT
// Displays: pictures that programs for Webots draw and write to files. No e-puck has one; nobody sees them
// while a program runs. Pixels are 0xAARRGGBB; shapes are hard-edged.
#pragma once
#include <cstdint>
#include <map>
#include <vector>

namespace board {

struct DisplayImage {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
  /// Red, green, blue of each pixel, rows from the top.
  std::vector<std::uint8_t> rgb() const;
};

class Display {
 public:
  Display(int width, int height) { screen_ = blank(width, height); }
  const DisplayImage& screen() const { return screen_; }
  void set_colour(std::uint32_t rgb) { colour_ = rgb & 0xFFFFFF; }
  /// 0 to 1 each: how solid a pixel becomes, and how much of what is drawn covers what was there.
  void set_alpha(double alpha) { alpha_ = alpha; }
  void set_opacity(double opacity) { opacity_ = opacity; }

  /// Lines from point to point; one point is a pixel.
  void draw(const std::int16_t* x, const std::int16_t* y, int points);
  /// The inside of a polygon, its edge included.
  void fill(const std::int16_t* x, const std::int16_t* y, int points);

  /// Images by number from 1; 0: it cannot be had.
  int copy(int x, int y, int width, int height);
  /// `order`: which byte of a pixel holds red, green, blue and alpha; -1: there is none.
  int make(int width, int height, const unsigned char* bytes, int bytes_a_pixel, const int order[4]);
  void paste(int image, int x, int y, bool blend);
  void remove(int image) { images_.erase(image); }
  /// Null: there is none of that number. 0 is the screen.
  const DisplayImage* image(int number) const;

 private:
  static DisplayImage blank(int width, int height);
  void put(int x, int y);
  void line(int x0, int y0, int x1, int y1);
  int keep(DisplayImage image);

  DisplayImage screen_;
  std::uint32_t colour_ = 0xFFFFFF;
  double alpha_ = 1, opacity_ = 1;
  std::map<int, DisplayImage> images_;
  int last_ = 0;
};

}  // namespace board
