/* SPDX-License-Identifier: MIT
 * The I2C bus as the e_* API sees it: the processor's master module, one operation at a time. Same rules as
 * in pins.h. Devices on the bus are hal_sim/board's; an operation reaches them when its last bit is over.
 */
#ifndef TWINPUCK_HOST_PINS_I2C_H
#define TWINPUCK_HOST_PINS_I2C_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** Module on with the baud rate register `brg` 0 to 511 (a bit is brg + 14 cycles), or off with -1. Either
 * way it starts afresh and what was under way is lost. Write. */
void tp_i2c_switch(tp_i64 brg);

/** Starts an operation and requests TP_V_MI2C for its end. `byte` 0 to 255 is sent by TP_I2C_WRITE and
 * ignored by the others. Answers the cycle at which it is over; -1 when the module is off or busy: nothing
 * happens. Write. */
tp_i64 tp_i2c_begin(tp_i64 operation, tp_i64 byte);
#define TP_I2C_START 0
#define TP_I2C_RESTART 1
#define TP_I2C_STOP 2
#define TP_I2C_ACKNOWLEDGE 3
#define TP_I2C_REFUSE 4
#define TP_I2C_READ 5
#define TP_I2C_WRITE 6

/** Cycle at which the operation under way is over; in the past when there is none. Horizon: that cycle. */
tp_i64 tp_i2c_busy_until(void);
/** 1 when a start / a stop was the last condition on the bus; both 0 while the module is off. Horizon: the
 * end of the operation under way. */
tp_i64 tp_i2c_started(void);
tp_i64 tp_i2c_stopped(void);
/** Byte received last, 0 to 255. Horizon: the end of the operation under way. */
tp_i64 tp_i2c_received(void);
/** 1 when the last byte sent was acknowledged. Horizon: the end of the operation under way. */
tp_i64 tp_i2c_acknowledged(void);

#ifdef __cplusplus
}
#endif
#endif
