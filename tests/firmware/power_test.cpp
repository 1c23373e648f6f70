// SPDX-License-Identifier: MIT
// The battery as programs meet it.
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

// four coils of 60 mA through 0.2 ohm: the detector at 3.4 V falls while the robot drives, and recovers
TEST_F(FirmwareTest, low_battery_pin_follows_the_sag) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
int before, driving, after;
int main(void) {
  long i;
  e_init_port();
  e_init_motors();
  e_start_agendas_processing();
  before = BATT_LOW;
  e_set_speed_left(800);
  e_set_speed_right(800);
  for (i = 0; i < 100000; i++) driving = BATT_LOW;
  e_set_speed_left(0);
  e_set_speed_right(0);
  after = BATT_LOW;
  while (1);
}
)")
                     .battery(3.42);
  run_for(2);
  EXPECT_EQ(robot.variable("before"), 1);
  EXPECT_EQ(robot.variable("driving"), 0);
  EXPECT_EQ(robot.variable("after"), 1);
}

// 0.1 Wh at some 0.13 A and 3.4 V are about 13 minutes; from 3.45 V, 5 % or less of that are left
TEST_F(FirmwareTest, a_wait_for_the_low_battery_pin_is_jumped_over_and_ends_on_time) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <motor_led/e_led.h>
int main(void) {
  e_init_port();
  while (BATT_LOW);
  LED0 = 1;
  while (1);
}
)")
                     .battery(3.42);
  robot.settings().battery_wh = 0.1;
  ASSERT_TRUE(run_until([&] { return robot.led(0); }, 60));
  // at rest 3.446 V, and 3.426 V when the terminals reach 3.4 V: shares 0.04956 and 0.04733
  // of 94.03 As; 0.13 A
  const double charge_as = 0.1 / 3.8285 * 3600;
  const auto share = [](double rest_v) { return 0.05 * (rest_v - 3.0) / 0.45; };
  EXPECT_NEAR(now_s(), (share(3.42 + 0.026) - share(3.4 + 0.026)) * charge_as / 0.13, 0.1);
  EXPECT_LT(robot.cpu_load(), 0.2);
  EXPECT_NEAR(robot.battery_v(), 3.4, 0.002);
}

}  // namespace
