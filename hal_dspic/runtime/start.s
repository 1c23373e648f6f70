; SPDX-License-Identifier: MIT
; What runs from reset to main(): stack, window to the constants, start values, main(), and if that returns, a reset.
; __SP_init, __SPLIM_init, __const_psvpage and the table at __dinit come from the linker.

        .equ    SPLIM, 0x0020
        .equ    TBLPAG, 0x0032
        .equ    PSVPAG, 0x0034
        .equ    CORCON, 0x0044          ; PSV is bit 2

        .section .text.__reset, "ax"
        .global __reset
__reset:
        mov     #__SP_init, w15
        mov     #__SPLIM_init, w0
        mov     w0, SPLIM
        nop                             ; the limit counts from the second instruction on
        mov     #__const_psvpage, w0
        mov     w0, PSVPAG
        bset    CORCON, #2
        call    set_start_values
        call    _main
        reset

; The table: destination, bytes, format (0 clear, 1 copy), for format 1 the data, two bytes a word; destination 0 ends it.
; w0 where in the table, w1 destination, w2 bytes, w3 format and data. Its page may change in the middle.
set_start_values:
        mov     #__dinit_page, w4
        mov     w4, TBLPAG
        mov     #__dinit_offset, w0
next_entry:
        rcall   read_word
        mov     w3, w1
        cp0     w1
        bra     z, done
        rcall   read_word
        mov     w3, w2
        rcall   read_word
        cp0     w3
        bra     nz, copy
clear:
        clr.b   [w1++]
        dec     w2, w2
        bra     nz, clear
        bra     next_entry
copy:
        rcall   read_word
        mov.b   w3, [w1++]
        dec     w2, w2
        bra     z, next_entry
        lsr     w3, #8, w3
        mov.b   w3, [w1++]
        dec     w2, w2
        bra     nz, copy
        bra     next_entry
done:
        return

read_word:
        tblrdl  [w0], w3
        inc2    w0, w0
        bra     nz, read
        inc     TBLPAG
read:   return

; an interrupt that has no handler: what XC16's programs do
        .section .text.__DefaultInterrupt, "ax"
        .weak   __DefaultInterrupt
__DefaultInterrupt:
        reset
