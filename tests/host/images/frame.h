/* SPDX-License-Identifier: MIT
 * A firmware image written by hand for the host's own tests: what twinpuck-cc inserts is spelled out here, so
 * a failing host test never is the compiler's fault. Plain gcc, PC data model. */
#ifndef FRAME_H
#define FRAME_H
#include "hal_sim/host/image_abi.h"
#include "hal_sim/host/pins.h"

/* variables private to a robot live in one section of their own */
#define PRIVATE __attribute__((section("tpdata"), used))
extern char __start_tpdata[], __stop_tpdata[];

__attribute__((visibility("hidden"), weak)) struct tp_control tp_ctl;

/* the head of a block that costs n cycles */
#define BLOCK(n)                                \
  do {                                          \
    if ((tp_ctl.budget -= (n)) < 0) tp_event(); \
  } while (0)

void firmware_main(void);
PRIVATE static volatile tp_i64 keeps_the_section;

__attribute__((weak)) void _T1Interrupt(void);
__attribute__((weak)) void _T3Interrupt(void);
__attribute__((weak)) void _MathError(void);

__attribute__((visibility("default"))) struct tp_image tp_image = {
    .magic = TP_IMAGE_MAGIC,
    .abi = TP_IMAGE_ABI,
    .name = "by hand",
    .flags = "",
    .control = &tp_ctl,
    .start = firmware_main,
    .data_begin = __start_tpdata,
    .data_end = __stop_tpdata,
    .hole_begin = __stop_tpdata,
    .hole_end = __stop_tpdata,
    .vectors = {[TP_V_T1] = _T1Interrupt, [TP_V_T3] = _T3Interrupt},
    .trap_vectors = {0, 0, 0, _MathError},
};
#endif
