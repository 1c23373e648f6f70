/* SPDX-License-Identifier: MIT
 * The library's pauses.
 */
#include "hal.h"
#include "hal_sim/api/takes.h"

TAKES(0) void hal_pause(unsigned int rounds) { tp_spend((tp_i64)rounds * T_PAUSE_ROUND + T_PAUSE); }
