; SPDX-License-Identifier: MIT
; Runtime of the chip: sum, difference, product and quotient of two floats. a in w1:w0, b in w3:w2, result in w1:w0; IEEE, to
; nearest, ties to even. Here are numbers with a hidden bit; zeros, subnormal numbers, infinities and not-a-number go to
; float.c with the operands as they came. In between:
;
;       w1:w0   a, then the result: 24 bits with the leading one at the top, and eight that decide the rounding, the
;               lowest of which says whether anything lay below
;       w3:w2   b alike         w4      exponent, as the number has it         w6      bit 15: sign
;       stack   both operands, w9:w8
        .equ    LARGEST, 254            ; exponent of the largest number
        .equ    BIAS, 127
        .equ    OPERANDS, 8             ; bytes on the stack

; exponents to w4 and w5; where one is 0 or 255, to \other
        .macro  open other
        push.d  w0
        push.d  w2
        push.d  w8
        sl      w1, w4
        lsr     w4, #8, w4
        sl      w3, w5
        lsr     w5, #8, w5
        mov     #LARGEST, w7
        dec     w4, w6
        cp      w6, w7
        bra     geu, \other
        dec     w5, w6
        cp      w6, w7
        bra     geu, \other
        .endm

; 24 bits below sign and exponent become 32
        .macro  widen high, low
        sl      \high, #8, \high
        lsr     \low, #8, w7
        ior     \high, w7, \high
        bset    \high, #15
        sl      \low, #8, \low
        .endm

        .macro  leave_to function
        pop.d   w8
        pop.d   w2
        pop.d   w0
        goto    \function
        .endm

; --- sum and difference

        .section .text.___addsf3, "ax"
        .global ___subsf3
        .global ___addsf3
___subsf3:
        btg     w3, #15
___addsf3:
        open    other_sum
        sub     w4, w5, w5
        bra     geu, in_order           ; a is to have the larger exponent
        exch    w0, w2
        exch    w1, w3
        sub     w4, w5, w4
        neg     w5, w5
in_order:
        mov     w1, w6
        xor     w1, w3, w8              ; bit 15: the signs differ
        widen   w1, w0
        widen   w3, w2
        cp      w5, #16                 ; b moves down by w5, w9 is what falls out
        bra     geu, far
        subr    w5, #16, w7
        sl      w2, w7, w9
        lsr     w2, w5, w2
        sl      w3, w7, w7
        ior     w2, w7, w2
        lsr     w3, w5, w3
        bra     moved
far:    sub     w5, #16, w5
        cp      w5, #15
        bra     leu, not_beyond
        mov     #15, w5
not_beyond:
        subr    w5, #16, w7
        sl      w3, w7, w9
        ior     w2, w9, w9
        lsr     w3, w5, w2
        clr     w3
moved:  cp0     w9
        bra     z, nothing_lost
        bset    w2, #0
nothing_lost:
        btsc    w8, #15
        bra     subtract
        add     w0, w2, w0
        addc    w1, w3, w1
        bra     nc, __float_round
        rrc     w1, w1
        rrc     w0, w0
        bra     nc, carried
        bset    w0, #0
carried:
        inc     w4, w4
        bra     __float_round
subtract:
        sub     w0, w2, w0
        subb    w1, w3, w1
        bra     c, is_positive
        subr    w0, #0, w0              ; the exponents were the same
        subbr   w1, #0, w1
        btg     w6, #15
is_positive:
        btsc    w1, #15
        bra     __float_round
        cp0     w1
        bra     nz, leading_word
        mov     w0, w1
        clr     w0
        sub     #16, w4
        cp0     w1
        bra     z, nothing_left
leading_word:
        ff1l    w1, w7
        dec     w7, w7
        sl      w1, w7, w1
        subr    w7, #16, w5
        lsr     w0, w5, w5
        ior     w1, w5, w1
        sl      w0, w7, w0
        sub     w4, w7, w4
        bra     gt, __float_round
other_sum:
        leave_to ___any_addsf3
nothing_left:
        pop.d   w8
        sub     w15, #OPERANDS, w15
        return

; --- rounds w1:w0 and puts exponent and sign to it; w4 is above 0
        .section .text.__float_round, "ax"
        .global __float_round
__float_round:
        mov     #LARGEST, w7
        cp      w4, w7
        bra     gt, infinite
        mov     #0x7F, w7               ; half a unit, less one if the fraction is even
        btsc    w0, #8
        inc     w7, w7
        add     w0, w7, w0
        addc    w1, #0, w1
        bra     nc, rounded
        bset    w1, #15                 ; 1.11..1 has become 10.0
        inc     w4, w4
rounded:
        lsr     w0, #8, w0
        sl      w1, #8, w7
        ior     w0, w7, w0
        lsr     w1, #8, w1
        dec     w4, w4                  ; the hidden bit counts the exponent up by one
        sl      w4, #7, w4
        add     w1, w4, w1
finish: btsc    w6, #15
        bset    w1, #15
        pop.d   w8
        sub     w15, #OPERANDS, w15
        return
infinite:
        clr     w0
        mov     #0x7F80, w1
        bra     finish

; --- product: 24 x 24 bits, of which the upper 32 count

        .section .text.___mulsf3, "ax"
        .global ___mulsf3
___mulsf3:
        open    other_product
        add     w4, w5, w9
        xor     w1, w3, w8
        bset    w1, #7
        ze      w1, w1
        bset    w3, #7
        ze      w3, w3
        mul.uu  w1, w2, w4
        mul.uu  w0, w3, w6
        add     w4, w6, w4
        addc    w5, w7, w5
        mul.uu  w0, w2, w6
        mul.uu  w1, w3, w2
        add     w4, w7, w0
        addc    w5, w2, w1
        cp0     w6
        bra     z, is_exact
        bset    w0, #0
is_exact:
        mov     w8, w6
        mov     #BIAS - 1, w7
        sub     w9, w7, w4
        btsc    w1, #15
        bra     leads
        sl      w0, w0
        rlc     w1, w1
        dec     w4, w4
leads:  cp0     w4
        bra     gt, __float_round
other_product:
        leave_to ___any_mulsf3

; --- quotient: two digits of 16 bits, each by one division of the chip, corrected by what the divisor's lower word takes

; digit = w1:w0 * 65536 / w3:w2, remainder to w1:w0, which is less than the divisor
        .macro  next_digit digit
        cp      w1, w3
        bra     geu, most\@
        repeat  #17
        div.ud  w0, w3
        mov     w0, \digit
        mul.uu  w0, w2, w8
        subr    w8, #0, w0
        subb    w1, w9, w1
        bra     c, done\@
less\@: dec     \digit, \digit
        add     w0, w2, w0
        addc    w1, w3, w1
        bra     nc, less\@
        bra     done\@
most\@: setm    \digit
        mul.uu  \digit, w2, w8
        add     w0, w3, w1
        bra     c, wide\@
        subr    w8, #0, w0
        subb    w1, w9, w1
        bra     nc, less\@
        bra     done\@
wide\@: subr    w8, #0, w0
        subb    w1, w9, w1
done\@:
        .endm

        .section .text.___divsf3, "ax"
        .global ___divsf3
___divsf3:
        open    other_quotient
        sub     w4, w5, w4
        mov     #BIAS, w7
        add     w4, w7, w4
        xor     w1, w3, w6
        widen   w1, w0
        widen   w3, w2
        lsr     w1, w1                  ; less than the divisor
        rrc     w0, w0
        next_digit w5
        next_digit w7
        ior     w0, w1, w2
        mov     w7, w0
        mov     w5, w1
        btsc    w1, #15
        bra     stands
        sl      w0, w0
        rlc     w1, w1
        dec     w4, w4
stands: cp0     w2
        bra     z, no_rest
        bset    w0, #0
no_rest:
        cp0     w4
        bra     gt, __float_round
other_quotient:
        leave_to ___any_divsf3
