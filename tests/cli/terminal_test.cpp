// SPDX-License-Identifier: MIT
// run --live: what stands on a terminal after a frame, what is written for it, keys, and that the terminal is
// given back.
#include <array>
#include <map>

#include "hal_sim/twin/world_file.h"
#include "outputs/terminal_screen.h"
#include "outputs/terminal_view.h"
#include "tests/cli/pty.h"

namespace {

using namespace cli_test;

/// As much of a terminal as the frames need: places, colours, erasing to the end of a line.
struct Terminal {
  struct Cell {
    std::string sign = " ";
    int fore = -1, back = -1;
  };
  static constexpr int kColumns = 130, kRows = 50;
  std::array<std::array<Cell, kColumns>, kRows> cells;
  int written = 0;  // characters
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
        ASSERT_LT(row, kRows);
        ASSERT_LT(column, kColumns) << "row " << row;
        ++written;
        cells[row][column++] = {bytes.substr(i, end - i), fore, back};
        i = end;
      }
    }
  }
  void obey(const std::string& what, char order) {
    if (order == 'H') {
      row = column = 0;
      if (const std::size_t semicolon = what.find(';'); semicolon != std::string::npos) {
        row = std::stoi(what) - 1;
        column = std::stoi(what.substr(semicolon + 1)) - 1;
      }
    }
    if (order == 'J') cells = {};
    if (order == 'm' && what == "0") fore = back = -1;
    if (order == 'm' && what.rfind("38;5;", 0) == 0) fore = std::stoi(what.substr(5));
    if (order == 'm' && what.rfind("48;5;", 0) == 0) back = std::stoi(what.substr(5));
  }
  std::string line(int y, int columns = 80) const {
    std::string out;
    for (int x = 0; x < columns; ++x) out += cells[y][x].sign;
    return out.erase(out.find_last_not_of(' ') + 1);
  }
  bool operator==(const Terminal& o) const {
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x) {
        const Cell &a = cells[y][x], &b = o.cells[y][x];
        if (a.sign != b.sign || a.fore != b.fore || a.back != b.back) return false;
      }
    return true;
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
  outputs::TerminalPainter painter;
  terminal.show(painter.changes(view.picture(1)));
  // 2.02 m on 78 pixels: 38.6 a metre; the middle of the picture is the arena's
  const auto robot = terminal.spot(kGreen), box = terminal.spot(kBlue);
  EXPECT_NEAR(robot.x, 39.5 - 0.5 * 38, 1.2);
  EXPECT_NEAR(robot.y, 15.5 - 0.2 * 38, 1.2);
  EXPECT_NEAR(box.x, 39.5 + 0.5 * 38, 1.2);
  EXPECT_NEAR(box.count, 0.1 * 0.4 * 38 * 38, 22);  // 5 by 16 pixels where it lies on their borders
  EXPECT_TRUE(reads(terminal.line(0), "    0.000 s  x1      two walls"));
  EXPECT_TRUE(reads(terminal.line(17), "puck         x -0.500 y  0.200 m    0 deg  LEDs ..........  runs"));
  EXPECT_EQ(terminal.spot(kLed).count, 0);

  // moved: nothing of it stays where it was; text that is too long, or would command the terminal, is not
  twin->simulation().move(0, {0.0, 0.0, 0}, 0);
  for (int i = 0; i < 9; ++i) view.say("line " + std::to_string(i));
  view.say("\x1b[2J" + std::string(200, 'x'));
  terminal.written = 0;
  terminal.show(painter.changes(view.picture(1)));
  // only what is another: 5 lines of text, and the places of a robot that was and is
  EXPECT_LT(terminal.written, 5 * 80 + 60);
  Terminal anew;
  anew.show(outputs::TerminalPainter().changes(view.picture(1)));
  EXPECT_TRUE(terminal == anew);
  EXPECT_EQ(painter.changes(view.picture(1)), "");
  EXPECT_NEAR(terminal.spot(kGreen).x, 39.5, 1.2);
  EXPECT_TRUE(reads(terminal.line(22), "line 8"));
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
  outputs::TerminalPainter painter;
  terminal.show(painter.changes(view.picture(1)));
  EXPECT_EQ(terminal.spot(kLed).count, 1);
  EXPECT_TRUE(reads(terminal.line(17), "puck         x -0.500 y  0.200 m    0 deg  LEDs ..2.......  waits"));
  twin->simulation().run_until(sim::from_seconds(2));
  terminal.show(painter.changes(view.picture(1)));
  // the processor resets, and the program goes on from its beginning
  EXPECT_TRUE(reads(terminal.line(17),
                    "puck         x -0.500 y  0.200 m    0 deg  LEDs ..2.......  RESET …x, waits"));
}

TEST_F(Live, without_colours_a_sign_stands_for_each_thing) {
  std::vector<std::string> problems;
  auto twin = twin::Twin::open(std::move(*twin::load_world(path("world.toml")).world), {}, problems);
  ASSERT_TRUE(twin) << problems.front();
  outputs::TerminalView view(*twin, false);
  const std::string bytes = outputs::TerminalPainter().changes(view.picture(1));
  EXPECT_EQ(bytes.find("38;5"), std::string::npos);
  Terminal terminal;
  terminal.show(bytes);
  // the robot is at column 20.5 and pixel row 7.9 of 32: text rows 4 and 5 below the first
  EXPECT_NE((terminal.line(4) + terminal.line(5)).find('o'), std::string::npos);
  EXPECT_NE(terminal.line(9).find("####"), std::string::npos)
      << terminal.line(9);  // the box: 4 characters wide
  EXPECT_EQ(terminal.cells[9][10].sign, ".");
}

TEST_F(Live, any_size_of_terminal_is_filled) {
  std::vector<std::string> problems;
  auto twin = twin::Twin::open(std::move(*twin::load_world(path("world.toml")).world), {}, problems);
  ASSERT_TRUE(twin) << problems.front();
  outputs::TerminalView view(*twin, true, {120, 40});
  Terminal terminal;
  outputs::TerminalPainter painter;
  terminal.show(painter.changes(view.picture(1)));
  EXPECT_EQ(terminal.cells[10][119].back, 234);  // outside the arena
  EXPECT_EQ(terminal.cells[10][120].back, -1);
  view.resize({50, 12});
  terminal.show(painter.changes(view.picture(1)));
  EXPECT_EQ(terminal.cells[2][49].back, 234);
  EXPECT_EQ(terminal.cells[2][50].back, -1);
  EXPECT_EQ(terminal.cells[20][5].sign, " ");
  for (const outputs::TerminalSize size : {outputs::TerminalSize{1, 1}, {3, 2}, {80, 3}, {2, 49}}) {
    view.resize(size);
    Terminal small;
    small.show(outputs::TerminalPainter().changes(view.picture(1)));
    EXPECT_EQ(small.cells[0][size.columns].sign, " ");
  }
}

TEST_F(Live, text_takes_as_many_columns_as_a_terminal_gives_it) {
  std::vector<std::string> problems;
  auto twin = twin::Twin::open(std::move(*twin::load_world(path("world.toml")).world), {}, problems);
  ASSERT_TRUE(twin) << problems.front();
  outputs::TerminalView view(*twin);
  view.say(
      "\xE6\xBC\xA2"
      "a"
      "\xC3\xA9"
      "e"
      "\xCC\x81"
      "|\xFF|"
      "\xC2\x9B"
      "|");  // a wide one, é, e with an accent, no UTF-8, C1
  const outputs::TerminalPicture picture = view.picture(1);
  const auto* const cells = &picture.cells[19 * 80];
  EXPECT_EQ(cells[0].sign, "\xE6\xBC\xA2");
  EXPECT_EQ(cells[1].sign, "");
  EXPECT_EQ(cells[2].sign, "a");
  EXPECT_EQ(cells[3].sign, "\xC3\xA9");
  EXPECT_EQ(cells[4].sign, "e\xCC\x81");
  EXPECT_EQ(cells[5].sign, "|");
  EXPECT_EQ(cells[6].sign, "?");
  EXPECT_EQ(cells[7].sign, "|");
  EXPECT_EQ(cells[8].sign, "|");
}

TEST_F(Live, the_terminal_has_its_real_size_and_may_change_it) {
  Pty pty("run " + path("world.toml") + " --live -q --for 1000", {}, 100, 30);
  ASSERT_TRUE(pty.until("p pause"));
  pty.resize(60, 20);
  pty.type("p");
  ASSERT_TRUE(pty.until("\x1b[2J")) << pty.said;  // all of it anew
  const std::size_t begin = pty.said.rfind("\x1b[2J");
  ASSERT_TRUE(pty.until("PAUSED"));
  Terminal terminal;
  pty.type("\x03");
  EXPECT_EQ(pty.end(), 130);
  const std::size_t end = pty.said.rfind("\x1b[0m\x1b[?25h");
  ASSERT_NE(end, std::string::npos) << pty.said;
  ASSERT_LT(begin, end) << pty.said;
  terminal.show(pty.said.substr(begin, end - begin));
  EXPECT_EQ(terminal.cells[5][59].back, 234);
  EXPECT_EQ(terminal.cells[5][60].back, -1);
}

TEST_F(Live, p_pauses_n_is_one_tick_and_p_goes_on) {
  Pty pty("run " + path("world.toml") + " --live -q --for 1000", {}, 80, 24);
  ASSERT_TRUE(pty.until("p pause, n next tick"));
  const auto shown_s = [&pty] {
    Terminal terminal;
    const std::size_t end = pty.said.rfind("\x1b[");  // of whole orders
    terminal.show(pty.said.substr(pty.said.find("\x1b[0m\x1b[2J"), end - pty.said.find("\x1b[0m\x1b[2J")));
    return std::stod(terminal.line(0));
  };
  pty.type("p");
  ASSERT_TRUE(pty.until("AUSED")) << pty.said;
  pty.listen(300);
  const double paused_s = shown_s();
  pty.type("n");
  pty.listen(300);
  EXPECT_NEAR(shown_s(), paused_s + 1.0 / 512, 0.0011);  // three decimals are shown
  pty.type("p");
  ASSERT_TRUE(pty.until("p pause")) << pty.said.substr(pty.said.size() - 300);
  EXPECT_FALSE(pty.is_as_before());  // keys come without Enter
  pty.type("\x03");
  EXPECT_EQ(pty.end(), 130);
}

TEST_F(Live, every_end_gives_the_terminal_back) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGABRT}) {
    Pty pty("run " + path("world.toml") + " --live -q --for 1000", {}, 80, 24);
    ASSERT_TRUE(pty.until("p pause")) << number;
    pty.signal(number);
    const bool came_back = pty.until("\x1b[?25h\x1b[?1049l");
    EXPECT_TRUE(came_back) << number;
    const int code = pty.end();
    EXPECT_EQ(code, number == SIGABRT ? 128 + number : 130);
    EXPECT_TRUE(pty.is_as_before()) << number;
  }
}

TEST_F(Live, no_color_and_a_dumb_terminal_are_obeyed) {
  Pty plain("run " + path("world.toml") + " --live -q --for 0.3", {"NO_COLOR=1"}, 80, 24);
  EXPECT_EQ(plain.end(), 0);
  EXPECT_NE(plain.said.find("\x1b[?1049h"), std::string::npos);
  EXPECT_EQ(plain.said.find("38;5"), std::string::npos);
  EXPECT_NE(plain.said.find("###"), std::string::npos);
  Pty empty("run " + path("world.toml") + " --live -q --for 0.3", {"NO_COLOR="}, 80, 24);
  EXPECT_EQ(empty.end(), 0);
  EXPECT_NE(empty.said.find("38;5"), std::string::npos);  // an empty one says nothing
  Pty dumb("run " + path("world.toml") + " --live -q --for 0.3", {"TERM=dumb"}, 80, 24);
  EXPECT_EQ(dumb.end(), 0);
  EXPECT_EQ(dumb.said.find('\x1b'), std::string::npos) << dumb.said;
  EXPECT_NE(dumb.said.find("puck         x -0.500 y  0.200 m"), std::string::npos) << dumb.said;
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
