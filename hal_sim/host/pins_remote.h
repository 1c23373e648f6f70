/* SPDX-License-Identifier: MIT
 * The remote control's receiver as the API sees it. Its level is pin RF6 (tp_pins_read), its falling edge the
 * external interrupt 0; conventions as in pins.h.
 */
#ifndef TWINPUCK_HOST_PINS_REMOTE_H
#define TWINPUCK_HOST_PINS_REMOTE_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** Level of RF6, 0 or 1: 1 is idle. Horizon: its next change. */
tp_i64 tp_remote_level(void);

#ifdef __cplusplus
}
#endif
#endif
