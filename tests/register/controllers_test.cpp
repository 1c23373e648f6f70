// SPDX-License-Identifier: MIT
// The controllers of the repository in both ways: the library's functions as closed forms, and the drivers of
// the real robot on the models of the chip. Same world, same seed, no noise: after 30 seconds without contact
// the robots stand within 1 cm of one another, have shown the same LEDs and sent the same bytes. Two turn
// away from a wall at counts that the ways sample at different instants; each turn differs by up to two
// degrees, and the way after it multiplies that: their courses state what is allowed.
#include "tests/register/register_fixture.h"

namespace register_test {
namespace {

struct Course {
  const char* controller;
  int selector;
  bool with_wall;
  double within_m = 0.01;
};

std::ostream& operator<<(std::ostream& out, const Course& c) {
  return out << c.controller << ' ' << c.selector;
}

struct Seen {
  double x_m = 0, y_m = 0, heading_deg = 0, distance_m = 0;
  std::vector<std::uint32_t> leds;  // each new pattern
  std::string sent;
  std::size_t traps = 0;
};

class Controllers : public ::testing::TestWithParam<Course> {
 protected:
  static Seen run(const Course& course, const char* way) {
    struct Run : RegisterTest {
      void TestBody() override {}
      Seen go(const Course& c, const char* chosen_way) {
        options.way = chosen_way;
        world.proximity.noise_scale = 0;
        if (c.with_wall) wall(0.6, -2, 0.6, 2);
        Robot& robot = add_robot(c.controller).at(0, 0, 30).selector(c.selector);
        Seen seen;
        for (int i = 0; i < 300; ++i) {
          run_for(0.1);
          if (seen.leds.empty() || seen.leds.back() != robot.leds()) seen.leds.push_back(robot.leds());
        }
        seen.x_m = robot.x_m();
        seen.y_m = robot.y_m();
        seen.heading_deg = robot.heading_deg();
        seen.distance_m = robot.distance_m();
        seen.sent = robot.uart1_text();
        seen.traps = robot.traps().size();
        for (const auto& t : robot.traps())
          ADD_FAILURE() << chosen_way << ": " << t.message << " at " << to_string(t.place);
        return seen;
      }
    } one;
    return one.go(course, way);
  }
};

TEST_P(Controllers, behave_alike_in_both_ways) {
  const Seen native = run(GetParam(), "native"), chip = run(GetParam(), "register");
  EXPECT_NEAR(chip.x_m, native.x_m, GetParam().within_m);
  EXPECT_NEAR(chip.y_m, native.y_m, GetParam().within_m);
  EXPECT_NEAR(chip.distance_m, native.distance_m, 0.02);
  EXPECT_EQ(chip.leds.size(), native.leds.size());
  EXPECT_EQ(chip.leds, native.leds);
  EXPECT_EQ(chip.sent, native.sent);
}

INSTANTIATE_TEST_SUITE_P(
    Repository, Controllers,
    ::testing::Values(Course{"blink", 0, false}, Course{"square", 0, false},
                      Course{"obstacle", 0, true, 0.08}, Course{"braitenberg_2a", 0, false},
                      Course{"serial_echo", 0, false}, Course{"selector_demo", 3, false},
                      Course{"tilt", 0, false}, Course{"braitenberg", 0, true},
                      Course{"follow_wall", 0, true}, Course{"asercom", 0, false},
                      Course{"bench_braitenberg", 0, true, 0.04}, Course{"sound_locate", 0, false}),
    [](const auto& p) { return std::string(p.param.controller) + std::to_string(p.param.selector); });

}  // namespace
}  // namespace register_test
