// SPDX-License-Identifier: MIT
// Programs for Webots' interfaces on the drivers of the real robot: the library behind the interfaces is the
// same in both ways, what it stands on is not. Expectations from the programs' text.
#include <cmath>

#include "tests/register/register_fixture.h"

namespace register_test {
namespace {

class WebotsWays : public firmware_test::FirmwareTest, public ::testing::WithParamInterface<const char*> {
 protected:
  WebotsWays() { options.way = GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Webots, WebotsWays, ::testing::Values("native", "register"),
                         [](const auto& p) { return std::string(p.param); });

// the lab's example: 20 and 16 units of 0.1 rad/s, which the driver quantises to 322.6 and 256.4 steps/s;
// run() asks for 64 ms
TEST_P(WebotsWays, the_labs_example_drives_its_curve_and_prints) {
  world.webots.speed_unit_rad_s = 0.1;
  world.webots.sensor_order = "lab";
  Robot& r = add_robot("e-puck");
  run_for(0.3);
  const auto left = r.left_steps(), right = r.right_steps();
  const std::size_t lines = r.console().size();
  run_for(2.0);
  EXPECT_NEAR(r.left_steps() - left, 2.0 * 322.6, 15);
  EXPECT_NEAR(r.right_steps() - right, 2.0 * 256.4, 12);
  EXPECT_NEAR(r.console().size() - lines, 2000 / 64, 1);
  expect_no_traps();
}

// wheels at 3 rad/s for 2 s: 6 rad x 20.5 mm = 123 mm, by the encoders as well; an LED each other step; a
// wall 1 cm from ps0 and ps7
TEST_P(WebotsWays, a_controller_of_todays_interface) {
  wall(0.2, -0.3, 0.2, 0.3);
  Robot& r = add_robot_with_source(R"(
#include <stdio.h>
#include <webots/distance_sensor.h>
#include <webots/led.h>
#include <webots/motor.h>
#include <webots/position_sensor.h>
#include <webots/robot.h>
double turned, front;
int steps;
int main(int argc, char **argv) {
  WbDeviceTag left, right, encoder, ps0, led;
  wb_robot_init();
  left = wb_robot_get_device("left wheel motor");
  right = wb_robot_get_device("right wheel motor");
  encoder = wb_robot_get_device("left wheel sensor");
  ps0 = wb_robot_get_device("ps0");
  led = wb_robot_get_device("led0");
  wb_distance_sensor_enable(ps0, 64);
  wb_position_sensor_enable(encoder, 64);
  wb_motor_set_position(left, INFINITY);
  wb_motor_set_position(right, INFINITY);
  wb_motor_set_velocity(left, 3.0);
  wb_motor_set_velocity(right, 3.0);
  while (wb_robot_step(64) != -1) {
    steps++;
    turned = wb_position_sensor_get_value(encoder);
    front = wb_distance_sensor_get_value(ps0);
    wb_led_set(led, steps & 1);
    if (steps == 31) {
      wb_motor_set_velocity(left, 0.0);
      wb_motor_set_velocity(right, 0.0);
      printf("turned %.1f\n", turned);
    }
  }
  wb_robot_cleanup();
  return 0;
})");
  run_for(3);
  EXPECT_NEAR(r.variable<float>("turned"), 31 * 0.064 * 3, 0.3);
  EXPECT_NEAR(r.x_m(), r.variable<float>("turned") * 0.0205, 0.003);
  EXPECT_GT(r.variable<float>("front"), 50);
  ASSERT_FALSE(r.console().empty());
  EXPECT_EQ(r.console()[0].substr(0, 7), "turned ");
  expect_no_traps();
}

}  // namespace
}  // namespace register_test
