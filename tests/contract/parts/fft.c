/* SPDX-License-Identifier: MIT
 * Transform: an impulse of 0.25 is 0.25 / 256 = 32 / 32768 at every frequency. */
#include "say.h"
#include <fft/e_fft.h>

extern fractcomplex sigCmpx[FFT_BLOCK_LENGTH];

int main(void) {
  int i, wrong = 0;
  begin();
  for (i = 0; i < FFT_BLOCK_LENGTH; i++) sigCmpx[i].real = sigCmpx[i].imag = 0;
  sigCmpx[0].real = 8192;
  e_doFFT_asm(sigCmpx);
  for (i = 0; i < FFT_BLOCK_LENGTH; i++)
    if (sigCmpx[i].real != 32 || sigCmpx[i].imag != 0) wrong++;
  say("first", sigCmpx[0].real);
  say("wrong", wrong);
  end();
}
