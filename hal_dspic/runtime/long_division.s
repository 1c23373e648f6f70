; SPDX-License-Identifier: MIT
; Runtime of the chip: division of longs. Dividend w1:w0, divisor w3:w2; quotient or remainder in w1:w0.
;
; A divisor of one word takes two divisions of the chip, 19 cycles each: upper word first, its rest before the lower.
; A longer one takes sixteen steps of shifting and subtracting: the quotient has 16 bits then.
; Handlers must keep RCOUNT; ours and XC16's do. Divided by 0: the chip's trap.

        .equ    ROUNDS, 17

; w1:w0 / w3:w2 -> quotient w1:w0, remainder w3:w2; uses w4 to w7
        .section .text.divide_long, "ax"
        .global __divide_long
__divide_long:
        cp0     w3
        bra     nz, long_divisor
        mov     w2, w4                  ; divisor
        mov     w0, w5                  ; lower word
        mov     w1, w6
        repeat  #ROUNDS
        div.uw  w6, w4                  ; w0 quotient, w1 rest
        mov     w0, w7
        mov     w5, w0
        repeat  #ROUNDS
        div.ud  w0, w4                  ; w1:w0, which is rest:lower
        mov     w1, w2
        clr     w3
        mov     w7, w1
        return
long_divisor:
        mov     w2, w4                  ; divisor w5:w4
        mov     w3, w5
        mov     w1, w2                  ; rest w3:w2, the dividend's upper word to begin with
        clr     w3
        clr     w1
        mov     #16, w6
step:   sl      w0, w0                  ; next bit of the lower word into the rest
        rlc     w2, w2
        rlc     w3, w3
        sub     w2, w4, w7
        subb    w3, w5, w7
        bra     ltu, smaller
        sub     w2, w4, w2
        subb    w3, w5, w3
        bset    w0, #0                  ; its place is free, since the word has moved up
smaller:
        dec     w6, w6
        bra     nz, step
        return

        .section .text.___udivsi3, "ax"
        .global ___udivsi3
___udivsi3:
        goto    __divide_long

        .section .text.___umodsi3, "ax"
        .global ___umodsi3
___umodsi3:
        call    __divide_long
        mov     w2, w0
        mov     w3, w1
        return

; the quotient is negative when the signs differ, the remainder when the dividend is
        .section .text.___divsi3, "ax"
        .global ___divsi3
___divsi3:
        xor     w1, w3, w4
        push    w4
        call    absolute
        call    __divide_long
        pop     w4
        btss    w4, #15
        return
        subr    w0, #0, w0
        subbr   w1, #0, w1
        return

        .section .text.___modsi3, "ax"
        .global ___modsi3
___modsi3:
        push    w1
        call    absolute
        call    __divide_long
        pop     w4
        btss    w4, #15
        bra     positive
        subr    w2, #0, w0
        subbr   w3, #0, w1
        return
positive:
        mov     w2, w0
        mov     w3, w1
        return

        .section .text.absolute, "ax"
absolute:
        btss    w1, #15
        bra     second
        subr    w0, #0, w0
        subbr   w1, #0, w1
second: btss    w3, #15
        return
        subr    w2, #0, w2
        subbr   w3, #0, w3
        return
