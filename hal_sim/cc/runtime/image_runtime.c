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

static void tp_image_start(void)
{
  main();
}

/* the linker script puts these around the image's data and tables */
extern char tp_data_begin[], tp_data_end[];
extern const char tp_eedata_begin[], tp_eedata_end[];
extern const struct tp_function tp_functions_begin[], tp_functions_end[];
extern const struct tp_coverage_line tp_coverage_begin[], tp_coverage_end[];

/* handlers that the program may have, by the interrupts' order, of both tables */
#define HANDLER(name) extern void name(void) __attribute__((weak));
#define IRQ(id, name) HANDLER(_##name##Interrupt) HANDLER(_Alt##name##Interrupt)
#define UNUSED_IRQ(bit, handler) HANDLER(_##handler) HANDLER(_Alt##handler)
#include "dspic30/memory/irqs.inc"
HANDLER(_OscillatorFail) HANDLER(_AddressError) HANDLER(_StackError) HANDLER(_MathError)
HANDLER(_AltOscillatorFail) HANDLER(_AltAddressError) HANDLER(_AltStackError) HANDLER(_AltMathError)
HANDLER(_DefaultInterrupt)

/* _FOSC() and _FWDT() of p30F6014A.h */
extern const unsigned int tp_config_fosc __attribute__((weak)), tp_config_fwdt __attribute__((weak));

#ifndef TP_IMAGE_FLAGS
#define TP_IMAGE_FLAGS ""
#endif

__attribute__((visibility("default"), aligned(64))) const struct tp_image tp_image = {
  TP_IMAGE_MAGIC, TP_IMAGE_ABI, TP_IMAGE_NAME, TP_IMAGE_FLAGS, &tp_ctl, tp_image_start,
  tp_data_begin, tp_data_end,
  tp_data_end, tp_data_end, /* the shared sections lie outside the data: no hole */
  {
#define IRQ(id, name) _##name##Interrupt,
#define UNUSED_IRQ(bit, handler) _##handler,
#include "dspic30/memory/irqs.inc"
  },
  { _OscillatorFail, _AddressError, _StackError, _MathError },
  tp_functions_begin, tp_functions_end,
#ifdef TP_COVERAGE
  tp_coverage_begin, tp_coverage_end,
#else
  0, 0,
#endif
  &tp_config_fosc, &tp_config_fwdt,
  {
#define IRQ(id, name) _Alt##name##Interrupt,
#define UNUSED_IRQ(bit, handler) _Alt##handler,
#include "dspic30/memory/irqs.inc"
  },
  { _AltOscillatorFail, _AltAddressError, _AltStackError, _AltMathError },
  _DefaultInterrupt,
  tp_eedata_begin, tp_eedata_end
};
