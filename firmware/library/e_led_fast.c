/* SPDX-License-Identifier: MIT
 * LEDs, variant for the fast agenda.
 */
#include "motor_led/advance_one_timer/fast_agenda/e_led.h"

#include "motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h"
#include "hal.h"
#include "e_led_shared.h"
