; SPDX-License-Identifier: MIT
; Runtime of the chip: void __delay32(unsigned long cycles) of libpic30.h. Call, test and return take 13 cycles; a round of the
; loop takes 6, and what is left is waited for one by one.
        .equ    FIXED, 13
        .equ    ROUND, 6

        .section .text.___delay32, "ax"
        .global ___delay32
___delay32:
        sub     w0, #FIXED, w0
        subb    w1, #0, w1
        bra     ltu, done
round:  sub     w0, #ROUND, w0
        subb    w1, #0, w1
        nop
        nop
        bra     geu, round
done:   return
