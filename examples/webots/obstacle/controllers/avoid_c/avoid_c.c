/* SPDX-License-Identifier: MIT
 * Drives on and turns away from what is near.
 */
#include <stdio.h>
#include <webots/distance_sensor.h>
#include <webots/motor.h>
#include <webots/robot.h>

#define TIME_STEP 64
#define CRUISE 4.0 /* rad/s */
#define MOST 6.28

/* rad/s a count of ps0 to ps7, clockwise from the front right, for the left and the right wheel */
static const double weights[8][2] = {{-0.004, 0.006}, {-0.003, 0.004}, {-0.001, 0.002}, {0.001, 0.001},
                                     {0.001, 0.001},  {0.002, -0.001}, {0.004, -0.003}, {0.006, -0.008}};

static double limited(double speed) { return speed > MOST ? MOST : speed < -MOST ? -MOST : speed; }

int main(void) {
  wb_robot_init();
  WbDeviceTag wheels[2] = {wb_robot_get_device("left wheel motor"), wb_robot_get_device("right wheel motor")};
  WbDeviceTag sensors[8];
  for (int i = 0; i < 8; i++) {
    char name[] = "ps0";
    name[2] = '0' + i;
    sensors[i] = wb_robot_get_device(name);
    wb_distance_sensor_enable(sensors[i], TIME_STEP);
  }
  for (int wheel = 0; wheel < 2; wheel++) wb_motor_set_position(wheels[wheel], INFINITY);

  while (wb_robot_step(TIME_STEP) != -1)
    for (int wheel = 0; wheel < 2; wheel++) {
      double speed = CRUISE;
      for (int i = 0; i < 8; i++) speed += weights[i][wheel] * wb_distance_sensor_get_value(sensors[i]);
      wb_motor_set_velocity(wheels[wheel], limited(speed));
    }
  printf("drove for %.0f s\n", wb_robot_get_time());
  wb_robot_cleanup();
  return 0;
}
