/* SPDX-License-Identifier: MIT
 * The working array of the library's transform. It takes room only in programs that name it.
 */
#include "fft/e_fft.h"

/* the DSP engine fetches from Y memory, and reverses bits of addresses that begin at a multiple of the size */
fractcomplex sigCmpx[FFT_BLOCK_LENGTH] __attribute__((__space__(ymemory), __aligned__(FFT_BLOCK_LENGTH * 4)));
