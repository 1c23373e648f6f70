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

// [lib: utility/utility.c]: 2070 counts at 3.4 V, 490 more at 4.2 V; robots before 1.3 have no such input
TEST_F(FirmwareTest, charge_of_revision_1_3_is_a_percentage_of_counts) {
  const char* const text = R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/e_init_port.h>
#include <utility/utility.h>
unsigned int raw = 7, percent = 7;
int main(void) {
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  raw = getBatteryValueRaw();
  percent = getBatteryValuePercentage();
  while (1);
}
)";
  const double volts[] = {3.6, 4.0};
  for (int i = 0; i < 3; ++i) {
    Robot& robot = add_robot_with_source(text, "r" + std::to_string(i)).battery(volts[i % 2]);
    robot.settings().own["revision"] = i < 2 ? "1.3" : "1.2";
    robot.at(0, i);
  }
  run_for(1);
  for (int i = 0; i < 2; ++i) {
    const double share = (volts[i] - 3.4) / 0.8;
    EXPECT_NEAR(robot(i).variable<std::uint16_t>("raw"), 2070 + 490 * share, 15) << volts[i];
    EXPECT_NEAR(robot(i).variable<std::uint16_t>("percent"), 100 * share, 3) << volts[i];
  }
  EXPECT_EQ(robot(2).variable<std::uint16_t>("raw"), 0);
  EXPECT_EQ(robot(2).variable<std::uint16_t>("percent"), 0);
}

}  // namespace
