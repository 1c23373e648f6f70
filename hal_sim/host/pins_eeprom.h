/* SPDX-License-Identifier: MIT
 * The data EEPROM as the API sees it: words at even addresses 0xF000 to 0xFFFE (of page 0x7F). Conventions as
 * in pins.h. Nothing here blocks; the time that erasing and writing take is the caller's to spend.
 */
#ifndef TWINPUCK_HOST_PINS_EEPROM_H
#define TWINPUCK_HOST_PINS_EEPROM_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** A word, 0 to 65535; 65535 when blank. Horizon: none, only the program changes it. */
tp_i64 tp_eeprom_read(tp_i64 address);
/** Clears the bits that are 0 in `value`. Write. */
void tp_eeprom_write(tp_i64 address, tp_i64 value);
/** Back to 65535. Write. */
void tp_eeprom_erase(tp_i64 address);

#ifdef __cplusplus
}
#endif
#endif
