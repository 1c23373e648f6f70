; SPDX-License-Identifier: MIT
; Runtime of the chip: setjmp() and longjmp(). The buffer: W8 to W14, W15 as it is when setjmp() has returned, and the return
; address.
        .section .text._setjmp, "ax"
        .global _setjmp
_setjmp:
        mov     w0, w2
        mov     w8, [w2++]
        mov     w9, [w2++]
        mov     w10, [w2++]
        mov     w11, [w2++]
        mov     w12, [w2++]
        mov     w13, [w2++]
        mov     w14, [w2++]
        sub     w15, #4, w1             ; CALL has pushed four bytes
        mov     w1, [w2++]
        mov     [w15-4], w1
        mov     w1, [w2++]
        mov     [w15-2], w1
        mov     w1, [w2]
        clr     w0
        return

        .section .text._longjmp, "ax"
        .global _longjmp
_longjmp:
        mov     w0, w2
        mov     w1, w0
        cp0     w0
        bra     nz, told
        mov     #1, w0                  ; setjmp() has returned 0 already
told:   mov     [w2++], w8
        mov     [w2++], w9
        mov     [w2++], w10
        mov     [w2++], w11
        mov     [w2++], w12
        mov     [w2++], w13
        mov     [w2++], w14
        mov     [w2++], w15
        mov     [w2++], w1              ; the return address back on the stack
        push    w1
        mov     [w2], w1
        push    w1
        return
