/* SPDX-License-Identifier: MIT
 * TAKES(n): a call of this function takes n processor cycles, RETURN included, whatever the compiler
 * estimates for its body: those of the driver's function of that name. The numbers are those of timings.h.
 */
#ifndef TWINPUCK_API_TAKES_H
#define TWINPUCK_API_TAKES_H

#include "hal_sim/api/timings.h"

#define TAKES(cycles) TWINPUCK_TAKES(cycles)
#define TWINPUCK_TAKES(cycles) __attribute__((__noinline__, __annotate__("twinpuck cycles " #cycles)))

#endif
