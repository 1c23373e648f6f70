; SPDX-License-Identifier: MIT
    .macro store value, to=w1
    mov #\value, w0
    mov w0, [\to++]
    .endm
    .equ N, 3
__reset: mov #0x900, w1
    .rept N
    store 0x12
    .endr
    .if N > 2 && tbloffset(text) != 0
    store (1 << N) | 'a'
    .else
    .error
    .endif
    do #N-1, 1f
    mac w4*w5, A, [w8]+=2, w4, [w10]-=2, w5, [w13]+=2
1:  nop
    bra 1b
    .section .const, psv
text: .asciz "a\n"
    .word 1, 2, N
    .comm buffer, 8
