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
  says("pin(Q3)", "got pin 'Q3', expected a port and a bit, such as D3");
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
