/* SPDX-License-Identifier: MIT
 * Virtual sensors and the console for firmware on the e-puck's own library.
 */
#include "twinpuck/virtual.h"

#include <string.h>

#include "hal_sim/host/pins_virtual.h"

int twinpuck_virtual_sensor(const char* name, float* value) { return (int)tp_virtual_sensor(name, value); }

void twinpuck_tell(const char* text) {
  tp_virtual_console(text, (tp_i64)strlen(text));
  tp_virtual_console("\n", 1);
}
