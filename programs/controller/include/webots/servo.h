/* SPDX-License-Identifier: MIT
 * Servos of versions up to 7: motors, with their position sensor; see webots/motor.h. rad, rad/s. Force and
 * acceleration have no meaning for the e-puck's steppers.
 */
#ifndef WB_SERVO_H
#define WB_SERVO_H

#include <webots/types.h>

#define WB_SERVO_INFINITY INFINITY
#define WB_SERVO_ROTATIONAL 0
#define WB_SERVO_LINEAR 1

TP_C_BEGIN

void wb_servo_set_position(WbDeviceTag tag, double position);
void wb_servo_set_velocity(WbDeviceTag tag, double velocity);
void wb_servo_set_acceleration(WbDeviceTag tag, double acceleration);
void wb_servo_set_motor_force(WbDeviceTag tag, double force);
void wb_servo_set_force(WbDeviceTag tag, double force);
void wb_servo_set_control_p(WbDeviceTag tag, double p);
double wb_servo_get_target_position(WbDeviceTag tag);
double wb_servo_get_min_position(WbDeviceTag tag);
double wb_servo_get_max_position(WbDeviceTag tag);
int wb_servo_get_type(WbDeviceTag tag);

/** Period in ms; the position is NaN before the first period is over, and where the motor has no sensor. */
void wb_servo_enable_position(WbDeviceTag tag, int sampling_period);
void wb_servo_disable_position(WbDeviceTag tag);
int wb_servo_get_position_sampling_period(WbDeviceTag tag);
double wb_servo_get_position(WbDeviceTag tag);

/** A warning; 0. */
void wb_servo_enable_motor_force_feedback(WbDeviceTag tag, int sampling_period);
void wb_servo_disable_motor_force_feedback(WbDeviceTag tag);
double wb_servo_get_motor_force_feedback(WbDeviceTag tag);

TP_C_END

#endif
