/* SPDX-License-Identifier: MIT
 * Sensors that no robot has and that a supervisor program defines (docs/connecting.md), for firmware on the
 * e-puck's own library; programs for Webots' interfaces find them as distance sensors. On a robot
 * nobody could define them, so there are none, and there is no console.
 */
#ifndef TWINPUCK_VIRTUAL_H
#define TWINPUCK_VIRTUAL_H

#include "../twinpuck.h"

/** Value of the sensor of that name at `value`, in the unit that the supervisor gives it. Returns 1, or 0 (and leaves
 *  `value`) when nobody has defined it. New values come in between the world's ticks. Does not block. */
int twinpuck_virtual_sensor(const char* name, float* value);

/** A line on the simulator's console; a newline is added. Does not block. */
void twinpuck_tell(const char* text);

#endif
