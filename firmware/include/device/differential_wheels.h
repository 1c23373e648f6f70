/* SPDX-License-Identifier: MIT
 * Both wheels. Nothing here blocks.
 * Interface of 2005 to 2008; webots/differential_wheels.h has the later one.
 */
#ifndef DEVICE_DIFFERENTIAL_WHEELS_H
#define DEVICE_DIFFERENTIAL_WHEELS_H

#include "robot_types.h"

TP_C_BEGIN

/** Units times the speed unit are rad/s (key speed_unit of [webots]; 0.00628 if not set: 1000 is a turn a
 *  second). Limited to 6.283 rad/s. */
void differential_wheels_set_speed(int left, int right);

/** Period in ms. Steps, 1000 a turn, since the start or as set, 16 bits; 0 before the first period is over.
 */
void differential_wheels_enable_encoders(int ms);
void differential_wheels_disable_encoders(void);
int differential_wheels_get_left_encoder(void);
int differential_wheels_get_right_encoder(void);
void differential_wheels_set_encoders(int left, int right);

TP_C_END

#endif
