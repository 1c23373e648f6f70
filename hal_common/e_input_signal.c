/* SPDX-License-Identifier: MIT
 * The working array of the library's transform. It takes room only in programs that name it.
 */
#include "fft/e_fft.h"

__attribute__((weak)) fractcomplex sigCmpx[FFT_BLOCK_LENGTH];
