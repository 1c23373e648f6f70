/* SPDX-License-Identifier: MIT
 * Infrared remote control.
 */
#include "motor_led/advance_one_timer/e_remote_control.h"
#include "unsimulated.h"
#define DEVICE "infrared remote control"

UNSIMULATED_VOID(e_init_remote_control, (void))
UNSIMULATED_VOID(e_read_remote_control, (void))
UNSIMULATED(unsigned char, e_get_check, (void))
UNSIMULATED(unsigned char, e_get_address, (void))
UNSIMULATED(unsigned char, e_get_data, (void))
