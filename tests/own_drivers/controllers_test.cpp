// SPDX-License-Identifier: MIT
// The controllers of the repository with both HALs: busy drivers known by heart, and all of them as flashed.
// Same world, same seed, same noise: after 2 seconds without contact the robots stand within 1 mm of one
// another, have shown the same LEDs and sent the same bytes, and neither board nor chip has anything to say
// about them. Later, microseconds decide which way a robot turns. Players run alone: in company they touch.
#include <algorithm>
#include <cmath>

#include "tests/own_drivers/fixture.h"

namespace own_drivers {
namespace {

struct Course {
  const char* controller;
  const char* where =
      "floor";  // "floor", "wall" (a long one, 0.64 m away), "lamp" (far off), or a world file
  int selector = 0;
  const char* says = "";  // how the one diagnosis begins; empty: there is none
  double seconds = 2;
  double within_m = 0.001;
};

/// What a robot drives in one control period of 32 ms at 480 steps/s, and two steps more: where it stands at
/// its thresholds from the start, a sample a fifth of a millisecond apart decides a period earlier or later.
constexpr double kControlPeriod_m = (0.032 * 480 + 2) * 0.000129;

std::ostream& operator<<(std::ostream& out, const Course& c) {
  return out << c.controller << " at " << c.where << ", selector " << c.selector;
}

struct Seen {
  double x_m = 0, y_m = 0, distance_m = 0;
  int collisions = 0;
  std::vector<std::uint32_t> leds;  // each new pattern
  std::string sent, diagnoses;
};

class Controllers : public ::testing::TestWithParam<Course> {
 protected:
  static Seen run(const Course& course, const char* hal) {
    struct Run : OwnDrivers {
      void TestBody() override {}
      Seen go(const Course& c, const char* chosen_hal) {
        options.hal = chosen_hal;
        Robot& robot = place(c);
        // what noise decides is compared over many seeds: docs/time.md
        world.proximity.noise_scale = 0;
        Seen seen;
        for (int i = 0; i < 100 * c.seconds; ++i) {
          run_for(0.01);
          if (seen.leds.empty() || seen.leds.back() != robot.leds()) seen.leds.push_back(robot.leds());
        }
        seen.x_m = robot.x_m();
        seen.y_m = robot.y_m();
        seen.distance_m = robot.distance_m();
        seen.collisions = robot.collisions();
        seen.sent = robot.uart(1).text();
        seen.diagnoses = robot.diagnoses_text();
        for (const auto& t : robot.traps())
          ADD_FAILURE() << chosen_hal << ": " << t.message << " at " << to_string(t.place);
        return seen;
      }
      Robot& place(const Course& c) {
        const std::string where = c.where;
        if (where.find(".toml") != std::string::npos) {
          load_world(where);
          robot(0).settings().firmware = c.controller;
          return robot(0).selector(c.selector);
        }
        if (where == "wall") wall(0.64, -2, 0.64, 2);
        if (where == "lamp") {
          sim::LampDesc lamp;
          lamp.position_m = {1.8, 1.3, 0.3};
          lamp.intensity_w_m2 = 4;
          lamp.attenuation = {1, 0, 1};
          world.lamps.push_back(lamp);
        }
        return add_robot(c.controller).at(0, 0, 30).selector(c.selector);
      }
    } one;
    return one.go(course, hal);
  }
};

void expect_alike(const Course& course, const Seen& sim, const Seen& dspic) {
  EXPECT_NEAR(std::hypot(dspic.x_m - sim.x_m, dspic.y_m - sim.y_m), 0, course.within_m);
  EXPECT_NEAR(dspic.distance_m, sim.distance_m, course.within_m);
  EXPECT_EQ(dspic.leds, sim.leds);
  EXPECT_EQ(dspic.sent, sim.sent);
  EXPECT_EQ(sim.collisions, 0) << "courses without contact are comparable";
  const std::string expected = course.says;
  for (const std::string& said : {sim.diagnoses, dspic.diagnoses}) {
    EXPECT_EQ(said.substr(0, expected.size()), expected);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), expected.empty() ? 0 : 1) << said;
  }
}

TEST_P(Controllers, behave_alike_with_both_hals) {
  expect_alike(GetParam(), run(GetParam(), "sim"), run(GetParam(), "dspic"));
}

INSTANTIATE_TEST_SUITE_P(
    Repository, Controllers,
    ::testing::Values(Course{"blink"}, Course{"square"}, Course{"serial_echo"},
                      Course{"selector_demo", "floor", 3}, Course{"asercom"}, Course{"sound_locate"},
                      Course{"obstacle", "wall"}, Course{"u_obstacle", "wall"}, Course{"braiten", "wall"},
                      Course{"braitenberg", "wall"}, Course{"follow_wall", "wall"},
                      Course{"bench_braitenberg", "wall"}, Course{"tilt", "worlds/ramp.toml"},
                      Course{"line_follow", "worlds/line.toml"}, Course{"follow_light", "lamp"},
                      Course{"braitenberg_2a", "worlds/braitenberg.toml"},
                      Course{"braitenberg_2b", "worlds/braitenberg.toml"},
                      Course{"braitenberg_3a", "worlds/braitenberg.toml"},
                      Course{"braitenberg_3b", "worlds/braitenberg.toml"}, Course{"radio_flock"},
                      Course{"soccer_player"}, Course{"obstacle", "worlds/obstacle.toml"},
                      Course{"obstacle", "worlds/corridor.toml"}, Course{"obstacle", "worlds/corners.toml"},
                      Course{"obstacle", "worlds/pillars.toml"}, Course{"obstacle", "worlds/maze.toml"},
                      Course{"obstacle", "worlds/u_obstacle.toml", 0, "", 2.0, kControlPeriod_m},
                      Course{"braitenberg", "worlds/arena.toml"}, Course{"braitenberg", "worlds/lamp.toml"},
                      Course{"sound_locate", "worlds/clap.toml"}, Course{"e-puck", "worlds/myobstacle.toml"},
                      Course{"e-puck",
                             "wall"},  // a line of the picture holds agenda ticks off, as on the robot
                      Course{"camera_follow", "worlds/red_ball.toml", 0, "T2: missed interrupt"}),
    [](const auto& p) {
      const std::string where = p.param.where;
      std::string name = p.param.controller + std::string("_at_") +
                         where.substr(where.rfind('/') + 1, where.rfind('.') - where.rfind('/') - 1);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

// in company: who hears and sees whom follows from everything that went before
TEST_F(OwnDrivers, a_flock_of_ten_does_alike_with_both_hals) {
  struct Flock : OwnDrivers {
    void TestBody() override {}
    std::vector<sim::Vec2> end(const char* hal) {
      options.hal = hal;
      load_world("worlds/flock.toml");
      run_for(30);
      std::vector<sim::Vec2> places;
      for (int i = 0; i < 10; ++i) places.push_back({robot(i).x_m(), robot(i).y_m()});
      return places;
    }
  } one, other;
  const std::vector<sim::Vec2> of_sim = one.end("sim"), of_dspic = other.end("dspic");
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(std::hypot(of_dspic[i].x - of_sim[i].x, of_dspic[i].y - of_sim[i].y), 0, 0.02) << i;
}

}  // namespace
}  // namespace own_drivers
