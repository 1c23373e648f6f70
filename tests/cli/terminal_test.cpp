// SPDX-License-Identifier: MIT
// run --live: what stands on a terminal of 80 by 24 after a frame, and that the terminal is given back.
#include <array>
#include <map>

#include "hal_sim/twin/world_file.h"
#include "outputs/terminal_view.h"
#include "tests/cli/command.h"

namespace {

using namespace cli_test;

/// As much of a terminal as the frames need: places, colours, erasing to the end of a line.
struct Terminal {
  struct Cell {
    std::string sign = " ";
    int fore = -1, back = -1;
  };
  std::array<std::array<Cell, 80>, 24> cells;
  int row = 0, column = 0, fore = -1, back = -1;

  void show(const std::string& bytes) {
    for (std::size_t i = 0; i < bytes.size();) {
      if (bytes[i] == '\x1b') {
        std::size_t end = i + 2;
        while (!isalpha(static_cast<unsigned char>(bytes[end]))) ++end;
        obey(bytes.substr(i + 2, end - i - 2), bytes[end]);
        i = end + 1;
      } else if (bytes[i] == '\r' || bytes[i] == '\n') {
        bytes[i] == '\r' ? column = 0 : ++row;
        ++i;
      } else {
        std::size_t end = i + 1;
        while (end < bytes.size() && (bytes[end] & 0xC0) == 0x80) ++end;
        ASSERT_LT(row, 24);
        ASSERT_LT(column, 80) << "row " << row;
        cells[row][column++] = {bytes.substr(i, end - i), fore, back};
        i = end;
      }
    }
  }
  void obey(const std::string& what, char order) {
    if (order == 'H') row = column = 0;
    if (order == 'K')
      for (int x = column; x < 80; ++x) cells[row][x] = {" ", -1, -1};
    if (order == 'm' && what == "0") fore = back = -1;
    if (order == 'm' && what.rfind("38;5;", 0) == 0) fore = std::stoi(what.substr(5));
    if (order == 'm' && what.rfind("48;5;", 0) == 0) back = std::stoi(what.substr(5));
  }
  std::string line(int y) const {
    std::string out;
    for (const Cell& cell : cells[y]) out += cell.sign;
    return out;
  }
  /// How many pixels of that colour, and the mean of their columns and rows.
  struct Spot {
    int count = 0;
    double x = 0, y = 0;
  };
  Spot spot(int colour) const {
    Spot s;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 80; ++x)
        if ((y % 2 ? cells[1 + y / 2][x].back : cells[1 + y / 2][x].fore) == colour) {
          ++s.count;
          s.x += x;
          s.y += y;
        }
    if (s.count) s.x /= s.count, s.y /= s.count;
    return s;
  }
};

const char* const kWorld = R"(twinpuck = 1
title = "two walls"
[arena]
size = [2.0, 0.8]
[[box]]
position = [0.5, 0]
size = [0.1, 0.4, 0.1]
colour = [0, 0, 1]
[[robot]]
name = "puck"
firmware = "selector_demo"
colour = [0, 1, 0]
position = [-0.5, 0.2]
)";
constexpr int kGreen = 16 + 6 * 5, kBlue = 16 + 5, kLed = 196;

class Live : public CommandTest {
 protected:
  Live() { write("world.toml", kWorld); }
};

TEST_F(Live, a_frame_shows_arena_robot_and_text) {
  std::vector<std::string> problems;
  auto twin = twin::Twin::open(std::move(*twin::load_world(path("world.toml")).world), {}, problems);
  ASSERT_TRUE(twin) << problems.front();
  outputs::TerminalView view(*twin);
  Terminal terminal;
  terminal.show(view.frame(1));
  // 2.02 m on 78 pixels: 38.6 a metre; the middle of the picture is the arena's
  const auto robot = terminal.spot(kGreen), box = terminal.spot(kBlue);
  EXPECT_NEAR(robot.x, 39.5 - 0.5 * 38, 1.2);
  EXPECT_NEAR(robot.y, 15.5 - 0.2 * 38, 1.2);
  EXPECT_NEAR(box.x, 39.5 + 0.5 * 38, 1.2);
  EXPECT_NEAR(box.count, 0.1 * 0.4 * 38 * 38, 22);  // 5 by 16 pixels where it lies on their borders
  EXPECT_NE(terminal.line(0).find("0.000 s"), std::string::npos);
  EXPECT_NE(terminal.line(0).find("two walls"), std::string::npos);
  EXPECT_NE(terminal.line(17).find("puck         x -0.500 y  0.200 m    0 deg"), std::string::npos)
      << terminal.line(17);
  EXPECT_EQ(terminal.spot(kLed).count, 0);

  // moved: nothing of it stays where it was; text that is too long, or would command the terminal, is not
  twin->simulation().move(0, {0.0, 0.0, 0}, 0);
  for (int i = 0; i < 9; ++i) view.say("line " + std::to_string(i));
  view.say("\x1b[2J" + std::string(200, 'x'));
  terminal.show(view.frame(1));
  EXPECT_NEAR(terminal.spot(kGreen).x, 39.5, 1.2);
  EXPECT_NE(terminal.line(22).find("line 8"), std::string::npos);
  EXPECT_EQ(terminal.line(23), "[2J" + std::string(77, 'x'));
}

TEST_F(Live, leds_shine_and_traps_are_told) {
  write("led/main.c", R"(#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_led.h>
volatile int zero;
int main(void) {
  long i;
  e_init_port();
  e_set_led(2, 1);
  for (i = 0; i < 300000; i++) asm("nop");
  return 1 / zero;
}
)");
  twin::Options options;
  options.firmware = {{"*", path("led")}};
  std::vector<std::string> problems;
  auto twin = twin::Twin::open(std::move(*twin::load_world(path("world.toml")).world), options, problems);
  ASSERT_TRUE(twin) << problems.front();
  twin->simulation().run_until(sim::from_seconds(0.05));
  outputs::TerminalView view(*twin);
  Terminal terminal;
  terminal.show(view.frame(1));
  EXPECT_EQ(terminal.spot(kLed).count, 1);
  EXPECT_NE(terminal.line(17).find("LEDs ..2.......  waits"), std::string::npos) << terminal.line(17);
  twin->simulation().run_until(sim::from_seconds(2));
  terminal.show(view.frame(1));
  // the processor resets, and the program goes on from its beginning
  EXPECT_NE(terminal.line(17).find("LEDs ..2.......  RESET "), std::string::npos) << terminal.line(17);
}

TEST_F(Live, the_terminal_is_given_back) {
  const Said run = twinpuck("", "script -qec '" + executable() + " run " + path("world.toml") +
                                    " --live --for 0.5 --speed 5' /dev/null #");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  const std::size_t begin = run.text.find("\x1b[?1049h"), end = run.text.rfind("\x1b[?1049l");
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  EXPECT_LT(begin, end);
  // the summary stands on the terminal that was
  EXPECT_GT(run.text.find("0.5 s simulated"), end);
  EXPECT_EQ(twinpuck("run " + path("world.toml") + " --live").exit_code, 2);  // no terminal
}

}  // namespace
