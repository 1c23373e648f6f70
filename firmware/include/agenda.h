/* SPDX-License-Identifier: MIT
 * Agendas. No program was found that uses older names than today's, so this is today's header.
 */
#include "motor_led/advance_one_timer/e_agenda.h"
