/* SPDX-License-Identifier: MIT
 * Seam B for the accelerometers: their part of the ADC scan, the question whether there is one on the bus,
 * and the drivers that take Timer 1 from the basic proximity driver while they convert. Conventions as in
 * pins.h. Single conversions: tp_convert(5) to (7).
 */
#ifndef TWINPUCK_HOST_PINS_ACC_H
#define TWINPUCK_HOST_PINS_ACC_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** The driver's accelerometer samples, counts 0 to 4095 (0 where there is none yet), into an array
 * [3][50] of 16-bit words: x, y, z; the newest at tp_scan_acc_index(). Revision 1.3: x and y 0, z the
 * battery. Horizon: the next sample. From the first call on the board works the samples out tick by tick. */
void tp_scan_acc_values(void* samples);
/** Newest sample of axis 0, 1 or 2; 0 before the first. Horizon: the next sample. */
tp_i64 tp_scan_acc_newest(tp_i64 axis);

/** tp_scan_acc_index(), and tp_scan_values(). Horizon: the next sample that is filed there. */
tp_i64 tp_scan_acc_index_until_next(void);
void tp_scan_ir_values(void* dark, void* lit);

/** How often e_init_ad_scan() has run since reset. Horizon: none. */
tp_i64 tp_scan_starts(void);

/** 1 when the device at 0x3C on the I2C bus says in register 0x0F that it is an LSM330 (0x40). A whole
 * transaction that takes no time: for e_init_port(), whose cost is its own. Write.
 * Source: [lib: motor_led/e_init_port.c]. */
tp_i64 tp_lsm330_answers(void);

#ifdef __cplusplus
}
#endif
#endif
