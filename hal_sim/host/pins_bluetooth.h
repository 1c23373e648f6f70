/* SPDX-License-Identifier: MIT
 * The one thing about the Bluetooth module that is not bytes on UART 1 (pins.h). Conventions as in pins.h.
 */
#ifndef TWINPUCK_HOST_PINS_BLUETOOTH_H
#define TWINPUCK_HOST_PINS_BLUETOOTH_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** UART `number` 1 or 2 off, bytes under way lost, its transmit pin low for `cycles` from now: a break.
 * Returns at once; whoever waits for its end waits himself. The UART stays off until it is initialised.
 * Write. */
void tp_uart_break(tp_i64 number, tp_i64 cycles);

#ifdef __cplusplus
}
#endif
#endif
