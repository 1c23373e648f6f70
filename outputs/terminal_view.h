// SPDX-License-Identifier: MIT
// The run in a terminal (run --live): arena from above, two square pixels a character, robots with where they
// look and their LEDs, a line for each of the first robots, the last lines of text. Colours are those of
// xterm's 256; without colours (NO_COLOR) a sign stands for each thing. terminal_screen.h brings it onto a
// terminal.
#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"

namespace outputs {

/// Characters of a terminal.
struct TerminalSize {
  int columns = 80, rows = 24;
  bool operator==(const TerminalSize& o) const { return columns == o.columns && rows == o.rows; }
};

/// What stands on a terminal, row by row from the top.
struct TerminalPicture {
  struct Cell {
    std::string sign = " ";    ///< one character in UTF-8; empty: the right half of the one before
    int fore = -1, back = -1;  ///< of xterm's 256 colours; -1: the terminal's own
    bool operator==(const Cell& o) const { return sign == o.sign && fore == o.fore && back == o.back; }
  };
  TerminalSize size;
  std::vector<Cell> cells;  ///< columns times rows
};

class TerminalView {
 public:
  /// `colours`: false draws with signs: # what stands, % what can be moved, o a robot, + where it looks, * an
  /// LED, . the floor, : where it is dark.
  explicit TerminalView(const twin::Twin& twin, bool colours = true, TerminalSize size = {});

  /// The terminal has another size now, 1 by 1 or more; what has no room is left out.
  void resize(TerminalSize size);
  TerminalSize size() const { return size_; }
  /// A line that a robot, or somebody else, said.
  void say(const std::string& line);
  /// `pace`: simulated seconds a second; `hint`: the rest of the first line, for example what keys do.
  TerminalPicture picture(double pace, const std::string& hint = "") const;
  /// Time, pace and the first robots in one line of plain text, for terminals that obey nothing.
  std::string line(double pace) const;

 private:
  struct Pixel {
    std::uint8_t colour;
    char sign;
  };
  using Pixels = std::vector<Pixel>;  // row by row from the top

  int high() const { return 2 * map_rows_; }
  Pixel& at(Pixels& pixels, int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.columns) +
                  static_cast<std::size_t>(x)];
  }
  void disc(Pixels& pixels, sim::Vec2 at_m, double radius_m, Pixel pixel) const;
  void solid(Pixels& pixels, const sim::Placed& placed, Pixel pixel) const;
  void lay_ground();
  void put(TerminalPicture& picture, int row, const std::string& text) const;
  void put_map(TerminalPicture& picture, Pixels& pixels) const;
  std::string robot_line(int robot) const;

  const twin::Twin& twin_;
  const bool colours_;
  TerminalSize size_;
  int map_rows_ = 0, robot_rows_ = 0;
  double px_per_m_ = 1;
  sim::Vec2 left_top_m_;
  Pixels ground_;  // floor and what is fixed
  std::deque<std::string> said_;
};

}  // namespace outputs
