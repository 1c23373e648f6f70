/* SPDX-License-Identifier: MIT
 * Pin directions, as the library named them before 2006. See motor_led/e_init_port.h.
 */
#ifndef _INIT_PORT
#define _INIT_PORT

#include "epuck_ports.h"

/** Pin directions and start levels; LEDs off, motors without current. */
void InitPort(void);

#endif
