/* SPDX-License-Identifier: MIT
 * Settings of a world for the library behind webots/ and device/ (settings.c). Without a world a program of 2005 has
 * those of the lab's worlds and others the usual ones.
 */
#ifndef WEBOTS_SIMULATOR_H
#define WEBOTS_SIMULATOR_H

#include "twinpuck.h"

/** Whether the program began with robot_live(), of 2005. */
int webots_is_of_2005(void);
void webots_begin_2005(void);

extern const float webots_world_speed_unit;
extern const int webots_world_lab_order, webots_world_nue, webots_world_step_ms;

/* rad/s a unit, as worlds/obstacle.toml has it */
#define OF_2005_SPEED_UNIT 0.1f
#define twin_time_step_ms() ((double)webots_world_step_ms)
#define twin_speed_unit()                                  \
  (webots_world_speed_unit > 0   ? webots_world_speed_unit \
   : webots_is_of_2005() ? OF_2005_SPEED_UNIT              \
                         : 0.0f)
#define twin_lab_order() (webots_world_lab_order >= 0 ? webots_world_lab_order : webots_is_of_2005())
#define twin_nue() webots_world_nue

#endif
