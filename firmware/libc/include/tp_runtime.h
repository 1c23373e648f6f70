/* SPDX-License-Identifier: MIT
 * What the libc leaves to the runtime of the chip (hal_dspic/runtime/libc_calls.c). Not for programs. */
#ifndef TP_LIBC_RUNTIME_H
#define TP_LIBC_RUNTIME_H
/** The program begins anew. */
void tp_reset(void) __attribute__((__noreturn__));
/** abort(), or exit() with a failure: the same, and the simulator tells it by this function's name. */
void tp_give_up(void) __attribute__((__noreturn__));
/** Bytes to UART 1 or 2, which the program has set up; waits for room in its buffer. */
void tp_console(const char* bytes, int length, int uart);
/** A word of program memory or data EEPROM. */
unsigned tp_table_read(unsigned long address);
#endif
