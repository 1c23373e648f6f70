/* SPDX-License-Identifier: MIT
 * The rotary selector. In a file of its own, since many programs have a getselector() of theirs.
 * Source: [lib: utility/utility.c], facts restated.
 */
#include "hal.h"
#include "utility/utility.h"

int getselector() { return SELECTOR0 + 2 * SELECTOR1 + 4 * SELECTOR2 + 8 * SELECTOR3; }
