/* SPDX-License-Identifier: MIT
 * The transform itself: the rounding of Microchip's signal-processing library is not reproduced yet. The two
 * helpers need nothing and are in e_fft_utilities.c.
 */
#include "fft/e_fft.h"
#include "unsimulated.h"
#define DEVICE "fixed-point transform"

UNSIMULATED_VOID(e_doFFT_asm, (fractcomplex *sigCmpx))
