; SPDX-License-Identifier: MIT
.equ pause, 5898

    config __FOSC, 0xFFE6
    config __FWDT, 0x7FFF
__reset: mov #__SP_init, w15
    mov #__SPLIM_init, w0
    mov w0, SPLIM
    nop
    mov #0xFF00, w0
    mov w0, TRISD
    bclr TRISA, #6
    mov #psvpage(left), w0
    mov w0, PSVPAG
    bset CORCON, #PSV
    clr w1
    clr w4
step: and w1, #3, w2
    mov #psvoffset(left), w3
    mov.b [w3+w2], w5
    mov #psvoffset(right), w3
    mov.b [w3+w2], w6
    ze w5, w5
    ze w6, w6
    sl w6, #4, w6
    ior w5, w6, w5
    mov w5, LATD
    inc w1, w1
    inc steps
    btst.c w1, #9
    bra nc, 1f
    bset LATA, #6
    bra 2f
1:  bclr LATA, #6
2:  mov #pause, w0
3:  dec w0, w0
    nop
    nop
    bra nz, 3b
    bra step
    .section .const, psv
left: .byte 0xA, 0x9, 0x5, 0x6
right: .byte 0xA, 0x6, 0x5, 0x9
    .bss
steps: .space 2
