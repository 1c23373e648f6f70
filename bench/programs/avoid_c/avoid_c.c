/* SPDX-License-Identifier: MIT
 * Steps of 32 ms, eight sensors: what a program of the PC costs (docs/dev/performance.md).
 */
#include <math.h>

#include <webots/distance_sensor.h>
#include <webots/motor.h>
#include <webots/robot.h>

#define STEP_MS 32
#define NEAR 300 /* counts of four sensors */

int main(void) {
  static const char *const kNames[8] = {"ps0", "ps1", "ps2", "ps3", "ps4", "ps5", "ps6", "ps7"};
  WbDeviceTag sensors[8], left, right;
  int i;
  wb_robot_init();
  for (i = 0; i < 8; i++) {
    sensors[i] = wb_robot_get_device(kNames[i]);
    wb_distance_sensor_enable(sensors[i], STEP_MS);
  }
  left = wb_robot_get_device("left wheel motor");
  right = wb_robot_get_device("right wheel motor");
  wb_motor_set_position(left, INFINITY);
  wb_motor_set_position(right, INFINITY);
  while (wb_robot_step(STEP_MS) != -1) {
    double v[8];
    for (i = 0; i < 8; i++) v[i] = wb_distance_sensor_get_value(sensors[i]);
    wb_motor_set_velocity(left, 3);
    wb_motor_set_velocity(right, v[0] + v[1] + v[6] + v[7] > NEAR ? -3 : 3);
  }
  wb_robot_cleanup();
  return 0;
}
