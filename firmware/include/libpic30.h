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

#define __delay_ms(d) __delay32((unsigned long)((d) * (FCY) / 1000.0))
#define __delay_us(d) __delay32((unsigned long)((d) * (FCY) / 1000000.0))

#endif
#endif
