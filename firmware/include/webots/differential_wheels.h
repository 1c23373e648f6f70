/* SPDX-License-Identifier: MIT
 * Both wheels, as versions up to R2018 had them. Nothing here blocks.
 */
#ifndef WB_DIFFERENTIAL_WHEELS_H
#define WB_DIFFERENTIAL_WHEELS_H

#include "types.h"

TP_C_BEGIN

/** Units times the speed unit are rad/s (key speed_unit of [webots]; 0.00628 if not set: 1000 is a turn a
 *  second). Limited to 6.283 rad/s. */
void wb_differential_wheels_set_speed(double left, double right);
double wb_differential_wheels_get_left_speed(void);
double wb_differential_wheels_get_right_speed(void);

/** Period in ms. Steps, 1000 a turn (159.15 a rad), since the start or as set; 0 before the first period is
 * over. */
void wb_differential_wheels_enable_encoders(int sampling_period);
void wb_differential_wheels_disable_encoders(void);
int wb_differential_wheels_get_encoders_sampling_period(void);
double wb_differential_wheels_get_left_encoder(void);
double wb_differential_wheels_get_right_encoder(void);
void wb_differential_wheels_set_encoders(double left, double right);

/** rad/s; rad/s a unit. */
double wb_differential_wheels_get_max_speed(void);
double wb_differential_wheels_get_speed_unit(void);

TP_C_END

#endif
