// SPDX-License-Identifier: MIT
// The run in a terminal of 80 by 24 characters (run --live): arena from above, two square pixels a character,
// robots with where they look and their LEDs, a line for each of the first robots, the last lines of text.
// Colours are those of xterm's 256. Nothing here reads the keyboard.
#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"

namespace outputs {

class TerminalView {
 public:
  static constexpr int kColumns = 80, kRows = 24;
  explicit TerminalView(const twin::Twin& twin);

  /// A line that a robot, or somebody else, said.
  void say(const std::string& line);
  /// All 24 lines, from the upper left corner on; `pace`: simulated seconds a second.
  std::string frame(double pace) const;

 private:
  using Pixels = std::vector<std::uint8_t>;  // colours, row by row from the top
  static constexpr int kMapRows = 16, kHigh = 2 * kMapRows, kRobotRows = 2;

  std::uint8_t& at(Pixels& pixels, int x, int y) const {
    return pixels[static_cast<std::size_t>(y * kColumns + x)];
  }
  void disc(Pixels& pixels, sim::Vec2 at_m, double radius_m, std::uint8_t colour) const;
  void solid(Pixels& pixels, const sim::Placed& placed, const sim::Colour& colour) const;
  std::string robot_line(int robot) const;

  const twin::Twin& twin_;
  double px_per_m_;
  sim::Vec2 left_top_m_;
  Pixels ground_;  // floor and what is fixed
  std::deque<std::string> said_;
};

/// The terminal belongs to the picture as long as this lives; what was on it comes back then.
class TerminalScreen {
 public:
  TerminalScreen();
  ~TerminalScreen();
  TerminalScreen(const TerminalScreen&) = delete;
  TerminalScreen& operator=(const TerminalScreen&) = delete;
  void show(const std::string& frame);
  /// From any thread, and twice, too.
  static void give_back();
};

}  // namespace outputs
