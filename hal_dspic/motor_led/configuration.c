/* SPDX-License-Identifier: MIT
 * Configuration words of the e-puck: crystal of 7.3728 MHz times 8, so 14.7456 million instructions a second;
 * watchdog and brown-out reset off, reset pin on. scripts/build_dspic.sh leaves this file out when the program has
 * configuration words of its own.
 */
#include "p30F6014A.h"

_FOSC(CSW_FSCM_OFF & XT_PLL8)
_FWDT(WDT_OFF)
_FBORPOR(PBOR_OFF & MCLR_EN)
_FGS(CODE_PROT_OFF)
