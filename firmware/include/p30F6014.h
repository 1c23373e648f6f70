/* SPDX-License-Identifier: MIT
 * The first e-pucks carried the 6014, later ones the 6014A; the registers a robot's program uses are the
 * same.
 */
#ifndef __TWINPUCK__
#include_next <p30F6014.h>
#else
#include "p30F6014A.h"
#endif
