; SPDX-License-Identifier: MIT
; Runtime of the chip: division of 64-bit integers. Dividend w3..w0, divisor w7..w4; quotient or remainder in w3..w0.
; Where both fit 32 bits it is the 32-bit division; else a bit a round, from the dividend's first word that is not 0 on.
; Divided by 0: the chip's trap, in the 32-bit division.

        .equ    ROUNDS, 64
        .equ    WORD, 16                ; bits

; w3..w0 / w7..w4 -> quotient w3..w0, remainder w7..w4
        .section .text.__divide_long_long, "ax"
        .global __divide_long_long
__divide_long_long:
        push.d  w8
        push.d  w10
        push    w12
        ior     w2, w3, w8
        ior     w6, w7, w9
        ior     w8, w9, w8
        bra     nz, wide
narrow: mov     w4, w2
        mov     w5, w3
        call    __divide_long
        mov     w2, w4                  ; w7:w6 is 0, but the routine has used it
        mov     w3, w5
        clr     w2
        clr     w3
        clr     w6
        clr     w7
        bra     end
wide:   ior     w4, w5, w8
        ior     w8, w9, w8
        bra     z, narrow               ; divided by 0
        clr     w8                      ; remainder w11..w8
        clr     w9
        clr     w10
        clr     w11
        mov     #ROUNDS, w12
skip:   cp0     w3
        bra     nz, round
        mov     w2, w3                  ; sixteen bits of the quotient are 0
        mov     w1, w2
        mov     w0, w1
        clr     w0
        sub     #WORD, w12
        bra     nz, skip
        bra     divided
round:  sl      w0, w0                  ; next bit of the dividend into the remainder
        rlc     w1, w1
        rlc     w2, w2
        rlc     w3, w3
        rlc     w8, w8
        rlc     w9, w9
        rlc     w10, w10
        rlc     w11, w11
        bra     c, larger               ; 65 bits
        cp      w8, w4
        cpb     w9, w5
        cpb     w10, w6
        cpb     w11, w7
        bra     ltu, smaller
larger: sub     w8, w4, w8
        subb    w9, w5, w9
        subb    w10, w6, w10
        subb    w11, w7, w11
        bset    w0, #0
smaller:
        dec     w12, w12
        bra     nz, round
divided:
        mov     w8, w4
        mov     w9, w5
        mov     w10, w6
        mov     w11, w7
end:    pop     w12
        pop.d   w10
        pop.d   w8
        return

        .macro  negate a, b, c, d
        subr    \a, #0, \a
        subbr   \b, #0, \b
        subbr   \c, #0, \c
        subbr   \d, #0, \d
        .endm

; remainder w7..w4 to w3..w0
        .macro  take_remainder
        mov     w4, w0
        mov     w5, w1
        mov     w6, w2
        mov     w7, w3
        .endm

        .section .text.magnitudes_long_long, "ax"
magnitudes_long_long:
        btss    w3, #15
        bra     divisor
        negate  w0, w1, w2, w3
divisor:
        btss    w7, #15
        return
        negate  w4, w5, w6, w7
        return

        .section .text.___udivdi3, "ax"
        .global ___udivdi3
___udivdi3:
        bra     __divide_long_long

        .section .text.___umoddi3, "ax"
        .global ___umoddi3
___umoddi3:
        rcall   __divide_long_long
        take_remainder
        return

; the quotient is negative when the signs differ, the remainder when the dividend is
        .section .text.___divdi3, "ax"
        .global ___divdi3
___divdi3:
        push    w8
        xor     w3, w7, w8
        rcall   magnitudes_long_long
        rcall   __divide_long_long
        btss    w8, #15
        bra     positive
        negate  w0, w1, w2, w3
positive:
        pop     w8
        return

        .section .text.___moddi3, "ax"
        .global ___moddi3
___moddi3:
        push    w8
        mov     w3, w8
        rcall   magnitudes_long_long
        rcall   __divide_long_long
        take_remainder
        btss    w8, #15
        bra     not_negative
        negate  w0, w1, w2, w3
not_negative:
        pop     w8
        return
