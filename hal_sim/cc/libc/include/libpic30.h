/* SPDX-License-Identifier: MIT
 * What XC16's libpic30.h offers: exact delays. FCY may be defined before; default is the e-puck's. */
#ifndef TP_LIBC_LIBPIC30_H
#define TP_LIBC_LIBPIC30_H
#ifndef FCY
#define FCY 14745600UL
#endif
void __delay32(unsigned long cycles);
/* 1 or 2: the UART that printf() and its like write to */
extern int __C30_UART;
#define __delay_ms(d) __delay32((unsigned long)(((unsigned long long)(d)) * (FCY) / 1000ULL))
#define __delay_us(d) __delay32((unsigned long)(((unsigned long long)(d)) * (FCY) / 1000000ULL))
#endif
