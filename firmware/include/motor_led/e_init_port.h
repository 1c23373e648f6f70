/* SPDX-License-Identifier: MIT
 * Pin directions and start levels: the first call of nearly every program.
 */
#ifndef _INIT_PORT
#define _INIT_PORT

#include "../twinpuck.h"

/** Makes LEDs, IR emitters, codec switch, motor coils, camera reset and I2C pins outputs at 0, and battery,
 *  remote, selector and camera data pins inputs. Then asks on the I2C bus whether this is a robot of revision
 *  1.3 (accelerometer at address 0x3C) and, if so, starts its accelerometer and gyroscope.
 *  Blocks for some tens of milliseconds (waiting loops of the I2C start-up).
 *  May be called again, and is: basic e_init_motors() and e_poxxxx_init_cam() call it, so LEDs go out and
 *  motors lose their current at that moment. Leaves analogue configuration alone. */
void e_init_port(void);

/** 1 on a robot of revision 1.3, else 0. Valid after e_init_port(). */
unsigned char isEpuckVersion1_3(void);
/** The same under the name that the library of 2013 gave it (revision 1.3 was to be 1.1). */
unsigned char isEpuckVersion1_1(void);

#endif
