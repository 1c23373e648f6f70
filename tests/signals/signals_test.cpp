// SPDX-License-Identifier: MIT
// The table of signals: each can be read of a robot, and tells what the fixture tells.
#include "hal_sim/signals/signals.h"

#include <cmath>
#include <set>

#include "tests/support/firmware_test.h"

namespace {

using signals::find;

class SignalsTest : public firmware_test::FirmwareTest {
 protected:
  double look(const std::string& name, int robot = 0) { return find(twin(), robot, name).value(twin()); }
  std::string refused(const std::string& name, int robot = 0) {
    try {
      find(twin(), robot, name);
      return "";
    } catch (const std::runtime_error& e) {
      return e.what();
    }
  }
};

constexpr const char* kDriver = R"(
#include <motor_led/e_init_port.h>
#include <motor_led/e_motors.h>
#include <motor_led/e_led.h>
#include <uart/e_uart_char.h>
int state = 3;
long counts[3] = {10, -20, 70000};
struct wheel { int speed; unsigned char on; } wheels[2] = {{400, 1}, {-300, 0}};
float gain = 1.5f;
int main(void) {
  static int turns;
  e_init_port();
  e_init_motors();
  e_init_uart1();
  e_send_uart1_char("hello", 5);
  e_set_speed_left(500);
  e_set_speed_right(-500);
  e_set_led(2, 1);
  e_set_body_led(1);
  for (;;) ++turns;
}
)";

TEST_F(SignalsTest, every_signal_can_be_read_and_lies_in_its_range) {
  arena(1, 1);
  add_robot_with_source(kDriver).at(0, 0).selector(6);
  run_for(0.5);
  std::set<std::string> seen;
  for (const std::string& name : signals::names(true)) {
    EXPECT_TRUE(seen.insert(name).second) << name;
    const double value = look(name);
    EXPECT_TRUE(std::isfinite(value)) << name;
    for (const signals::Signal& s : signals::all()) {
      const bool is_it = s.count == 0
                             ? name == s.name
                             : name.rfind(s.name, 0) == 0 && name.size() == std::string(s.name).size() + 1;
      if (!is_it) continue;
      EXPECT_GE(value, s.least) << name;
      EXPECT_LE(value, s.most) << name;
      EXPECT_FALSE(std::string(s.what).empty());
    }
  }
  EXPECT_GT(seen.size(), 60u);
}

TEST_F(SignalsTest, they_tell_what_the_robot_does) {
  arena(1, 1);
  auto& robot = add_robot_with_source(kDriver).at(0, -0.1, 90).selector(6);
  run_for(0.5);
  EXPECT_DOUBLE_EQ(look("time_s"), 0.5);
  EXPECT_EQ(look("robots"), 1);
  EXPECT_DOUBLE_EQ(look("x_m"), robot.x_m());
  EXPECT_DOUBLE_EQ(look("heading_deg"), robot.heading_deg());
  EXPECT_EQ(look("left_steps"), static_cast<double>(robot.left_steps()));
  // 500 steps/s on each side: 20 agenda ticks of 1475 cycles a step, as the rotor follows them
  EXPECT_NEAR(look("left_steps_s"), 14745600.0 / (20 * 1475), 5);
  EXPECT_NEAR(look("right_steps_s"), -14745600.0 / (20 * 1475), 5);
  EXPECT_LT(look("turn_deg_s"), -100);
  EXPECT_EQ(look("led2"), 1);
  EXPECT_EQ(look("led3"), 0);
  EXPECT_EQ(look("leds"), 1);
  EXPECT_EQ(look("body_led"), 1);
  EXPECT_EQ(look("selector"), 6);
  EXPECT_EQ(look("uart1_bytes"), 5);
  EXPECT_EQ(look("traps"), 0);
  EXPECT_EQ(look("stopped"), 0);
  EXPECT_GT(look("load"), 0);
  EXPECT_NEAR(look("nearest_wall_m"), 0.4 - 0.037, 1e-4);
  EXPECT_EQ(look("nearest_robot_m"), signals::kNothingNearM);
}

enum Who { kAhead, kTurns, kEar, kOff, kTraps, kWaits, kPushes };
struct Told {
  Who who;
  const char* name;
  double value, tolerance;
};
constexpr double kStepM = 2 * 3.14159265358979 * 0.0205 / 1000;     // a thousandth of a turn of the wheel
constexpr double kStepsS = 14745600.0 / (20 * 1475);                // a step each 20 ticks of 1475 cycles
constexpr double kToneCounts = 0.632456 / 2 * 0.0794 / 3.3 * 4096;  // 90 dB at 1 m, heard at 2 m

// Each signal has a value that was worked out by hand, of the robot that shows it best.
constexpr Told kTold[] = {
    {kAhead, "time_s", 0.5, 0},
    {kAhead, "robots", 7, 0},
    {kTurns, "x_m", -0.6, 1e-4},
    {kAhead, "y_m", 0.1 + 236 * kStepM, 5e-4},
    {kAhead, "heading_deg", 90, 0.1},
    {kAhead, "speed_m_s", kStepsS* kStepM, 1e-3},
    {kTurns, "turn_deg_s", -2 * kStepsS* kStepM / 0.053 * 180 / 3.14159265, 2},  // wheels 53 mm apart
    {kAhead, "distance_m", 236 * kStepM, 5e-4},
    {kPushes, "collisions", 1, 0},
    {kPushes, "wall_touch_s", 0.425, 0.02},  // 3 mm from the wall, about 30 ms until it drives
    {kPushes, "longest_wall_touch_s", 0.425, 0.02},
    {kPushes, "touch_s", 0.425, 0.02},
    {kOff, "nearest_wall_m", 0.1 - 0.037, 1e-6},
    {kOff, "nearest_robot_m", 0.5 - 2 * 0.037, 1e-6},
    {kEar, "proximity4", 25, 1},  // scattered inside
    {kEar, "light3", 2, 1e-9},
    {kOff, "mic0", 2048, 60},
    {kEar, "mic_level0", kToneCounts, 1},
    {kEar, "mic_level2", kToneCounts, 1},
    {kEar, "loudness", kToneCounts, 1},
    {kEar, "sound_bearing_deg", 45, 1},
    {kEar, "speaker", 0, 0},
    {kEar, "acc_x", 2048, 30},
    {kEar, "acc_y", 2048, 30},
    {kEar, "acc_z", 2048 + 768, 30},
    {kAhead, "left_steps", 236, 2},
    {kTurns, "right_steps", -236, 2},
    {kAhead, "left_steps_s", kStepsS, 5},
    {kTurns, "right_steps_s", -kStepsS, 5},
    {kAhead, "led2", 1, 0},
    {kAhead, "led3", 0, 0},
    {kAhead, "led8", 1, 0},
    {kTurns, "led9", 0, 0},
    {kAhead, "body_led", 1, 0},
    {kTurns, "body_led", 0, 0},
    {kTurns, "front_led", 0, 0},
    {kAhead, "front_led", 1, 0},
    {kAhead, "leds", 2, 0},
    {kAhead, "selector", 6, 0},
    {kOff, "battery_v", 4.026, 1e-6},
    {kEar, "battery_v", 4.026 - 0.2 * 0.13, 1e-3},  // 0.2 ohm
    {kOff, "charge", 0.8575, 1e-6},
    {kEar, "current_a", 0.13, 1e-6},
    {kEar, "load", 0, 1e-3},
    {kOff, "cycles", 7372800, 0},
    {kAhead, "interrupts", 499, 3},  // one for each step of an idle agenda's motor
    {kTraps, "traps", 1, 0},
    {kTraps, "resets", 0, 0},
    {kTraps, "stopped", 0, 0},
    {kWaits, "waiting", 1, 0},
    {kOff, "waiting", 0, 0},
    {kWaits, "diagnoses", 1, 0},
    {kAhead, "uart1_bytes", 5, 0},
    {kAhead, "uart2_bytes", 3, 0},
    {kAhead, "uart1_received", 4, 0},
    {kAhead, "uart2_received", 2, 0},
};

TEST_F(SignalsTest, each_has_the_value_that_the_scene_gives_it) {
  arena(2, 2);
  world.ambient_w_m2 = 2;
  sim::SoundDesc tone;
  tone.kind = sim::SoundKind::Tone;
  tone.frequency_hz = 1000;
  tone.level_db = 90;
  tone.position_m = {0.4 - 2 * std::sqrt(0.5), 0.4 + 2 * std::sqrt(0.5), 0.035};  // to the ear's left
  world.sounds.push_back(tone);
  const auto driver = [](int right, bool is_lit) {
    return "#include <motor_led/e_init_port.h>\n#include <motor_led/e_motors.h>\n#include "
           "<motor_led/e_led.h>\n"
           "#include <uart/e_uart_char.h>\nint main(void) {\n  e_init_port();\n  e_init_motors();\n"
           "  e_init_uart1();\n  e_init_uart2();\n  e_send_uart1_char(\"hello\", 5);\n"
           "  e_send_uart2_char(\"abc\", 3);\n  e_set_led(2, 1);\n  e_set_led(7, 1);\n" +
           std::string(is_lit ? "  e_set_body_led(1);\n  e_set_front_led(1);\n" : "") +
           "  e_set_speed_left(500);\n  e_set_speed_right(" + std::to_string(right) +
           ");\n  for (;;) continue;\n}\n";
  };
  auto& ahead = add_robot_with_source(driver(500, true), "ahead").at(-0.6, 0.1, 90).selector(6);
  add_robot_with_source(driver(-500, false), "turns").at(-0.6, -0.6);
  add_robot_with_source("int main(void) { for (;;) continue; }", "ear").at(0.4, 0.4, 90);
  add_robot("", "off").at(0.9, 0, 0);
  add_robot_with_source(
      "int main(void) {\n  static int begun __attribute__((persistent));\n  if (begun != 7) {\n    begun = "
      "7;\n"
      "    asm(\".pword 0x018001\");\n  }\n  for (;;) continue;\n}",
      "traps")
      .at(0.9, -0.5);
  add_robot_with_source("volatile int go; int main(void) { while (!go) continue; }", "waits").at(0.9, -0.7);
  add_robot_with_source(driver(500, false), "pushes").at(0.96, 0.5);
  ahead.uart(1).send("four");
  ahead.uart(2).send("2!");
  run_for(0.5);
  std::set<std::string> told;
  for (const Told& row : kTold) {
    EXPECT_NEAR(look(row.name, row.who), row.value, row.tolerance) << row.name << " of robot " << row.who;
    std::string name = row.name;
    told.insert(name);
    told.insert(name.substr(0, name.find_last_not_of("0123456789") + 1));
  }
  for (const signals::Signal& s : signals::all()) EXPECT_TRUE(told.count(s.name)) << s.name << ": got no row";
}

TEST_F(SignalsTest, variables_are_c_and_pins_and_registers_are_the_chips) {
  add_robot_with_source(kDriver);
  run_for(0.2);
  EXPECT_EQ(look("$state"), 3);
  EXPECT_EQ(look("var(state)"), 3);
  EXPECT_EQ(look("$counts[2]"), 70000);
  EXPECT_EQ(look("$counts[1]"), -20);
  EXPECT_EQ(look("$wheels[1].speed"), -300);
  EXPECT_EQ(look("var(wheels[0].on)"), 1);
  EXPECT_EQ(look("$gain"), 1.5);
  EXPECT_EQ(look("var(wheels[state - 2].speed + 1)"), -299);
  EXPECT_EQ(look("var(*(counts + 1))"), -20);
  EXPECT_NE(look("$main:turns"), 0);
  EXPECT_EQ(look("pin(C2)"), 1);  // the body LED
  EXPECT_GE(look("reg(SPLIM)"), 2048);
}

TEST_F(SignalsTest, what_nothing_has_is_told_with_what_may_be_meant) {
  add_robot_with_source(kDriver, "e-puck");
  run_for(0.1);
  const auto says = [&](const std::string& name, const std::string& what, int robot = 0) {
    EXPECT_EQ(refused(name, robot), what);
  };
  says("x_n",
       "got 'x_n', expected a signal; did you mean 'x_m'?; twinpuck list signals names them, $NAME is a "
       "variable of the program");
  says("led10",
       "got 'led10', expected a signal; did you mean 'led0'?; twinpuck list signals names them, $NAME is a "
       "variable of the program");
  says("x_m", "got 'x_m' without a robot, expected ROBOT.x_m; the robots are e-puck", -1);
  says("$sate", "got 'sate', expected a variable of the image that is known here");
  says("$wheels", "got 'wheels', expected a number; name a member or element");
  says("pin(Q3)", "got pin 'Q3', expected a port and a bit of the chip's, such as D3");
  says("reg(T2C0N)",
       "got 'T2C0N', expected a pin, a port, a register, an interrupt, a UART's line or a variable (got "
       "'T2C0N', expected a variable of the image that is known here); did you mean 'T2CON'?");
}

TEST_F(SignalsTest, the_nearest_robot_is_the_gap_between_two_bodies) {
  add_robot("", "a").at(0, 0);
  add_robot("", "b").at(0.1, 0);
  run_for(0.1);
  EXPECT_NEAR(look("nearest_robot_m", 0), 0.1 - 2 * 0.037, 1e-9);
  EXPECT_NEAR(look("nearest_robot_m", 1), 0.1 - 2 * 0.037, 1e-9);
  EXPECT_EQ(look("nearest_wall_m", 0), signals::kNothingNearM);
  EXPECT_EQ(look("load", 0), 0);  // switched off
}

}  // namespace
