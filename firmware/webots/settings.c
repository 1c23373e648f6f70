/* SPDX-License-Identifier: MIT
 * What a world's [webots] says, on the robot, where there is no world: the usual values. A run links its world's in
 * place of this file.
 */
#include "simulator.h"

const float webots_world_speed_unit = 0; /* rad/s; 0: of the interface that the program begins with */
const int webots_world_lab_order = -1;   /* whether sensors are numbered as in the lab; -1: so */
const int webots_world_nue = 0;          /* whether axes are nue */
const int webots_world_step_ms = 32;
