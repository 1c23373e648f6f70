/* SPDX-License-Identifier: MIT
 * What exists only in the simulator: the console, and sensors that a supervisor defines
 * (twinpuck/virtual.h). Conventions as in pins.h; texts end with 0, numbers with a fraction are 32-bit floats
 * at addresses.
 */
#ifndef TWINPUCK_HOST_PINS_VIRTUAL_H
#define TWINPUCK_HOST_PINS_VIRTUAL_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** Text for the simulator's console; takes no time. Write. */
void tp_virtual_console(const char* bytes, tp_i64 length);

/** Value of the sensor that a supervisor defined under that name; 0: it has not. Horizon: now. */
tp_i64 tp_virtual_sensor(const char* name, tp_f32* value);

#ifdef __cplusplus
}
#endif
#endif
