/* SPDX-License-Identifier: MIT
 * The wheels: "left wheel motor" and "right wheel motor", stepper motors of 1000 steps a turn.
 *
 * Speeds are those of the robot's motor driver: whole steps/s, quantised
 * (motor_led/advance_one_timer/e_motors.h), up to 6.283 rad/s. A motor begins at position control with target
 * 0 and its greatest speed: set the position to INFINITY and the velocity to drive. Positions are reached by
 * counting steps, looked at every 10 ms; a new target counts from there. Steppers have no torque to set.
 * Nothing here blocks.
 */
#ifndef WB_MOTOR_H
#define WB_MOTOR_H

#include "types.h"

TP_C_BEGIN

/** Target, rad, forward positive; INFINITY (or -INFINITY): turn for ever at the set velocity. */
void wb_motor_set_position(WbDeviceTag tag, double position);

/** rad/s, -6.283 to 6.283; more is limited with a warning. NaN is ignored with a warning. */
void wb_motor_set_velocity(WbDeviceTag tag, double velocity);

/** rad/s2; steppers start at once: ignored. */
void wb_motor_set_acceleration(WbDeviceTag tag, double acceleration);
void wb_motor_set_available_torque(WbDeviceTag tag, double torque);
void wb_motor_set_available_force(WbDeviceTag tag, double force);
void wb_motor_set_control_pid(WbDeviceTag tag, double p, double i, double d);

/** rad, rad/s. */
double wb_motor_get_target_position(WbDeviceTag tag);
double wb_motor_get_velocity(WbDeviceTag tag);
double wb_motor_get_max_velocity(WbDeviceTag tag);

/** 0 and 0: no limits; unlimited acceleration: -1. */
double wb_motor_get_min_position(WbDeviceTag tag);
double wb_motor_get_max_position(WbDeviceTag tag);
double wb_motor_get_acceleration(WbDeviceTag tag);

/** WB_ROTATIONAL. */
WbJointType wb_motor_get_type(WbDeviceTag tag);

/** The sensor of the same wheel; there is no brake: 0. */
WbDeviceTag wb_motor_get_position_sensor(WbDeviceTag tag);
WbDeviceTag wb_motor_get_brake(WbDeviceTag tag);

TP_C_END

#endif
