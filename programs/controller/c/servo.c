/* SPDX-License-Identifier: MIT
 * Servos of versions up to 7, over motors.
 */
#include <math.h>

#include "programs/controller/c/library.h"

void wb_servo_set_position(WbDeviceTag tag, double position) { wb_motor_set_position(tag, position); }
void wb_servo_set_velocity(WbDeviceTag tag, double velocity) { wb_motor_set_velocity(tag, velocity); }
void wb_servo_set_acceleration(WbDeviceTag tag, double acceleration) { wb_motor_set_acceleration(tag, acceleration); }
void wb_servo_set_motor_force(WbDeviceTag tag, double force) { wb_motor_set_available_force(tag, force); }
void wb_servo_set_force(WbDeviceTag tag, double force) { wb_motor_set_force(tag, force); }
void wb_servo_set_control_p(WbDeviceTag tag, double p) { wb_motor_set_control_pid(tag, p, 0, 0); }
double wb_servo_get_target_position(WbDeviceTag tag) { return wb_motor_get_target_position(tag); }
double wb_servo_get_min_position(WbDeviceTag tag) { return wb_motor_get_min_position(tag); }
double wb_servo_get_max_position(WbDeviceTag tag) { return wb_motor_get_max_position(tag); }
int wb_servo_get_type(WbDeviceTag tag) { return wb_motor_get_type(tag) == WB_LINEAR; }

/* 0: the motor has none, which is no mistake of the program's */
static WbDeviceTag sensor(WbDeviceTag tag) { return wb_motor_get_position_sensor(tag); }
void wb_servo_enable_position(WbDeviceTag tag, int sampling_period) {
  if (sensor(tag)) wb_position_sensor_enable(sensor(tag), sampling_period);
}
void wb_servo_disable_position(WbDeviceTag tag) { wb_servo_enable_position(tag, 0); }
int wb_servo_get_position_sampling_period(WbDeviceTag tag) {
  return sensor(tag) ? wb_position_sensor_get_sampling_period(sensor(tag)) : 0;
}
double wb_servo_get_position(WbDeviceTag tag) { return sensor(tag) ? wb_position_sensor_get_value(sensor(tag)) : NAN; }

void wb_servo_enable_motor_force_feedback(WbDeviceTag tag, int sampling_period) {
  wb_motor_enable_force_feedback(tag, sampling_period);
}
void wb_servo_disable_motor_force_feedback(WbDeviceTag tag) { wb_motor_disable_force_feedback(tag); }
double wb_servo_get_motor_force_feedback(WbDeviceTag tag) { return wb_motor_get_force_feedback(tag); }
