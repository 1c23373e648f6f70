/* SPDX-License-Identifier: MIT
 * The simulator's own functions on a robot: nobody has defined a sensor, and there is no console. hal_sim fills them.
 */
#include "twinpuck/virtual.h"

int twinpuck_virtual_sensor(const char* name, float* value) {
  (void)name;
  (void)value;
  return 0;
}

void twinpuck_tell(const char* text) { (void)text; }
