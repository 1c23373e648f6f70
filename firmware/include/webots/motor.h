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
/** Programs of the PC: a warning, as of all functions of force and torque below. */
void wb_motor_set_force(WbDeviceTag tag, double force);
void wb_motor_set_torque(WbDeviceTag tag, double torque);
void wb_motor_enable_force_feedback(WbDeviceTag tag, int sampling_period);
void wb_motor_disable_force_feedback(WbDeviceTag tag);
int wb_motor_get_force_feedback_sampling_period(WbDeviceTag tag);
double wb_motor_get_force_feedback(WbDeviceTag tag);
void wb_motor_enable_torque_feedback(WbDeviceTag tag, int sampling_period);
void wb_motor_disable_torque_feedback(WbDeviceTag tag);
int wb_motor_get_torque_feedback_sampling_period(WbDeviceTag tag);
double wb_motor_get_torque_feedback(WbDeviceTag tag);
double wb_motor_get_available_force(WbDeviceTag tag);
double wb_motor_get_max_force(WbDeviceTag tag);
double wb_motor_get_available_torque(WbDeviceTag tag);
double wb_motor_get_max_torque(WbDeviceTag tag);
double wb_motor_get_multiplier(WbDeviceTag tag);
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
