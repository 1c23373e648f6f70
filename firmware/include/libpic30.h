/* SPDX-License-Identifier: MIT
 * Delays of XC16's own library. FCY, cycles per second, must be defined before __delay_ms() and __delay_us()
 * are used: include motor_led/e_epuck_ports.h. With XC16 the vendor's header is used.
 */
#ifndef __TWINPUCK__
#include_next <libpic30.h>
#else
#ifndef TWINPUCK_LIBPIC30_H
#define TWINPUCK_LIBPIC30_H

/** Blocks for `cycles` instruction cycles, at least 12; interrupts go on. */
void __delay32(unsigned long cycles);

/** 1 or 2: the UART that printf() and its like write to. */
extern int __C30_UART;

/** A place in program memory or data EEPROM. */
typedef unsigned long _prog_addressT;
#define _init_prog_address(place, object) \
  ((place) = (_prog_addressT)__builtin_tblpage(&(object)) << 16 | __builtin_tbloffset(&(object)))

/** Copies `bytes` bytes from program memory or data EEPROM; returns the place behind them. */
_prog_addressT _memcpy_p2d16(void *to, _prog_addressT from, unsigned int bytes);

/* lengths: bytes of data EEPROM, instructions of program memory */
#define _EE_WORD 2
#define _EE_ROW 32
#define _FLASH_PAGE 32
#define _FLASH_ROW 32

/* what NVMCON takes for each operation [DS70143 table 7-1]; program memory itself is not written here */
#define _FLASH_ERASE_CODE 0x4041
#define _FLASH_WRITE_ROW_CODE 0x4001
#define _EE_ERASE_WORD_CODE 0x4044
#define _EE_ERASE_ROW_CODE 0x4045
#define _EE_ERASE_ALL_CODE 0x4046
#define _EE_WORD_WRITE_CODE 0x4004
#define _EE_ROW_WRITE_CODE 0x4005

/** Erases (to 0xFFFF) or writes a word or a row (_EE_WORD, _EE_ROW bytes) of data EEPROM, about 2 ms. */
void _erase_eedata(_prog_addressT place, int bytes);
void _erase_eedata_all(void);
void _write_eedata_word(_prog_addressT place, int word);
void _write_eedata_row(_prog_addressT place, int *words);
/** Returns when erasing or writing is done. */
void _wait_eedata(void);

#define __delay_ms(d) __delay32((unsigned long)((d) * (FCY) / 1000.0))
#define __delay_us(d) __delay32((unsigned long)((d) * (FCY) / 1000000.0))

#endif
#endif
