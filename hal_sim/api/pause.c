/* SPDX-License-Identifier: MIT
 * The library's pauses.
 */
#include "hal.h"
#include "hal_sim/api/takes.h"

/* of a call and of each round of its loop [measured: register way] */
#define CALL_CYCLES 5
#define ROUND_CYCLES 10

TAKES(0) void hal_pause(unsigned int rounds) { tp_spend((tp_i64)rounds * ROUND_CYCLES + CALL_CYCLES); }
