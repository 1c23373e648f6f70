/* SPDX-License-Identifier: MIT
 * Part of every firmware image: the budget, the self-description the host looks for, and the slow path of the
 * cycle accounting. Compiled by twinpuck-cc itself, so its int has 16 bits as everywhere in the image.
 */
#include "hal_sim/host/image_abi.h"

__attribute__((section("tpctl"), aligned(64), visibility("hidden"))) struct tp_control tp_ctl = {0, 0, 0};

/* Budget spent. Keeps every general register, so the fast path needs no saving around the call. */
__attribute__((preserve_most, noinline)) void tp_image_event(void)
{
  tp_event();
}

#ifndef TP_IMAGE_NAME
#define TP_IMAGE_NAME ""
#endif

extern int main(void);

#ifdef TP_WEBOTS
/* constructors of C++, those of libraries last */
extern void (*const tp_inits_begin[])(void), (*const tp_inits_end[])(void);

/* a program for Webots' interfaces looks at its arguments, and has ended when main() returns */
static void tp_image_start(void)
{
  static char *arguments[2] = {(char *)TP_IMAGE_NAME, 0};
  void (*const *init)(void) = tp_inits_end;
  while (init != tp_inits_begin) (*--init)();
  ((int (*)(int, char **))main)(1, arguments);
  for (;;) tp_power_save(1); /* the robot's interrupts go on */
}
#else
static void tp_image_start(void)
{
  main();
}
#endif

/* the linker script puts these around the image's data and tables */
extern char tp_data_begin[], tp_data_end[];
extern const char tp_eedata_begin[], tp_eedata_end[];
extern const struct tp_function tp_functions_begin[], tp_functions_end[];
extern const struct tp_coverage_line tp_coverage_begin[], tp_coverage_end[];

#define H(name) extern void name(void) __attribute__((weak));
#define VECTORS(X) \
  X(_INT0Interrupt) X(_IC1Interrupt) X(_OC1Interrupt) X(_T1Interrupt) X(_IC2Interrupt) X(_OC2Interrupt) \
  X(_T2Interrupt) X(_T3Interrupt) X(_SPI1Interrupt) X(_U1RXInterrupt) X(_U1TXInterrupt) X(_ADCInterrupt) \
  X(_NVMInterrupt) X(_SI2CInterrupt) X(_MI2CInterrupt) X(_CNInterrupt) X(_INT1Interrupt) X(_IC7Interrupt) \
  X(_IC8Interrupt) X(_OC3Interrupt) X(_OC4Interrupt) X(_T4Interrupt) X(_T5Interrupt) X(_INT2Interrupt) \
  X(_U2RXInterrupt) X(_U2TXInterrupt) X(_SPI2Interrupt) X(_C1Interrupt) X(_IC3Interrupt) X(_IC4Interrupt) \
  X(_IC5Interrupt) X(_IC6Interrupt) X(_OC5Interrupt) X(_OC6Interrupt) X(_OC7Interrupt) X(_OC8Interrupt) \
  X(_INT3Interrupt) X(_INT4Interrupt) X(_C2Interrupt) X(_PWMInterrupt) X(_QEIInterrupt) X(_DCIInterrupt) \
  X(_LVDInterrupt) X(_FLTAInterrupt) X(_FLTBInterrupt) X(_Interrupt45) X(_Interrupt46) X(_Interrupt47) \
  X(_Interrupt48) X(_Interrupt49) X(_Interrupt50) X(_Interrupt51) X(_Interrupt52) X(_Interrupt53)
VECTORS(H)
H(_OscillatorFail) H(_AddressError) H(_StackError) H(_MathError)
/* those of the alternate table */
#define ALTERNATE_VECTORS(X) \
  X(_AltINT0Interrupt) X(_AltIC1Interrupt) X(_AltOC1Interrupt) X(_AltT1Interrupt) X(_AltIC2Interrupt) \
  X(_AltOC2Interrupt) X(_AltT2Interrupt) X(_AltT3Interrupt) X(_AltSPI1Interrupt) X(_AltU1RXInterrupt) \
  X(_AltU1TXInterrupt) X(_AltADCInterrupt) X(_AltNVMInterrupt) X(_AltSI2CInterrupt) X(_AltMI2CInterrupt) \
  X(_AltCNInterrupt) X(_AltINT1Interrupt) X(_AltIC7Interrupt) X(_AltIC8Interrupt) X(_AltOC3Interrupt) \
  X(_AltOC4Interrupt) X(_AltT4Interrupt) X(_AltT5Interrupt) X(_AltINT2Interrupt) X(_AltU2RXInterrupt) \
  X(_AltU2TXInterrupt) X(_AltSPI2Interrupt) X(_AltC1Interrupt) X(_AltIC3Interrupt) X(_AltIC4Interrupt) \
  X(_AltIC5Interrupt) X(_AltIC6Interrupt) X(_AltOC5Interrupt) X(_AltOC6Interrupt) X(_AltOC7Interrupt) \
  X(_AltOC8Interrupt) X(_AltINT3Interrupt) X(_AltINT4Interrupt) X(_AltC2Interrupt) X(_AltPWMInterrupt) \
  X(_AltQEIInterrupt) X(_AltDCIInterrupt) X(_AltLVDInterrupt) X(_AltFLTAInterrupt) X(_AltFLTBInterrupt) \
  X(_AltInterrupt45) X(_AltInterrupt46) X(_AltInterrupt47) X(_AltInterrupt48) X(_AltInterrupt49) \
  X(_AltInterrupt50) X(_AltInterrupt51) X(_AltInterrupt52) X(_AltInterrupt53)
ALTERNATE_VECTORS(H)
H(_AltOscillatorFail) H(_AltAddressError) H(_AltStackError) H(_AltMathError)
H(_DefaultInterrupt)

/* _FOSC() and _FWDT() of p30F6014A.h */
extern const unsigned int tp_config_fosc __attribute__((weak)), tp_config_fwdt __attribute__((weak));

#define A(name) name,
#ifndef TP_IMAGE_FLAGS
#define TP_IMAGE_FLAGS ""
#endif

__attribute__((visibility("default"), aligned(64))) const struct tp_image tp_image = {
  TP_IMAGE_MAGIC, TP_IMAGE_ABI, TP_IMAGE_NAME, TP_IMAGE_FLAGS, &tp_ctl, tp_image_start,
  tp_data_begin, tp_data_end,
  tp_data_end, tp_data_end, /* the shared sections lie outside the data: no hole */
  { VECTORS(A) },
  { _OscillatorFail, _AddressError, _StackError, _MathError },
  tp_functions_begin, tp_functions_end,
#ifdef TP_COVERAGE
  tp_coverage_begin, tp_coverage_end,
#else
  0, 0,
#endif
  &tp_config_fosc, &tp_config_fwdt,
  { ALTERNATE_VECTORS(A) },
  { _AltOscillatorFail, _AltAddressError, _AltStackError, _AltMathError },
  _DefaultInterrupt,
  tp_eedata_begin, tp_eedata_end
};
