// SPDX-License-Identifier: MIT
#include "hal_sim/board/displays.h"

#include <gtest/gtest.h>

namespace {

std::uint32_t at(const board::DisplayImage& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y * image.width + x)] & 0xFFFFFF;
}

TEST(Display, shapes_cover_exactly_their_pixels) {
  board::Display d(8, 6);
  d.set_colour(0xFF8000);
  const std::int16_t x[] = {2, 4, 4, 2}, y[] = {1, 1, 2, 2};
  d.fill(x, y, 4);
  d.set_colour(0x0000FF);
  const std::int16_t line_x[] = {0, 5}, line_y[] = {5, 5}, out_x[] = {-3, 20}, out_y[] = {0, 0};
  d.draw(line_x, line_y, 2);
  d.draw(out_x, out_y, 2);  // cut at the edges
  int orange = 0, blue = 0;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 8; ++column) {
      orange += at(d.screen(), column, row) == 0xFF8000;
      blue += at(d.screen(), column, row) == 0x0000FF;
    }
  EXPECT_EQ(orange, 6);
  EXPECT_EQ(blue, 6 + 8);
  EXPECT_EQ(at(d.screen(), 2, 1), 0xFF8000u);
  EXPECT_EQ(at(d.screen(), 4, 2), 0xFF8000u);
}

TEST(Display, pictures_are_copied_made_from_bytes_and_pasted) {
  board::Display d(4, 4);
  const unsigned char bgra[] = {1, 2, 3, 255, 4, 5, 6, 255};
  const int order[] = {2, 1, 0, 3};
  const int made = d.make(2, 1, bgra, 4, order);
  d.paste(made, 1, 1, false);
  EXPECT_EQ(at(d.screen(), 1, 1), 0x030201u);
  EXPECT_EQ(at(d.screen(), 2, 1), 0x060504u);
  const int copy = d.copy(1, 1, 2, 2);
  d.paste(copy, 3, 3, false);  // all but one pixel lies outside
  EXPECT_EQ(at(d.screen(), 3, 3), 0x030201u);
  d.remove(copy);
  EXPECT_EQ(d.image(copy), nullptr);
}

}  // namespace
