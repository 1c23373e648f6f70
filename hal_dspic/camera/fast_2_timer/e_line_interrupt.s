; SPDX-License-Identifier: MIT
; The line's interrupt of the fast camera driver: takes one byte of the camera every 8 cycles, exactly, as the table
; _poxxxx_line_conf says (1 take, 0 skip, 2 end of line). Numbers at the right are cycles from the first instruction.
; Shadow registers hold W0 to W3, so no other handler may use them (priority 7 and _ISRFAST). No REPEAT, which would
; need RCOUNT saved: the interrupted code may be in the middle of a division.
; Instants: camera_line.h.

        .equ    CAMERA_BYTE, 0x02D5     ; high byte of PORTD
        .equ    TIMER4, 0x0114          ; TMR4
        .equ    FLAGS1, 0x0086          ; IFS1, T4IF is bit 5
        .equ    CONTROL4_HIGH, 0x011F   ; high byte of T4CON, TON is bit 7

        .section .text
        .global __T4Interrupt, _twinpuck_line_handler
_twinpuck_line_handler:
__T4Interrupt:
        push.s                          ; 0
        bclr.b  FLAGS1, #5              ; 1
        clr     TIMER4                  ; 2
        mov     #__poxxxx_line_conf, w0 ; 3
        mov     __poxxxx_buffer, w1     ; 4
        mov     #CAMERA_BYTE, w2        ; 5
next_byte:
        mov.b   [w0++], w3              ; 6
        btsc    w3, #1                  ; 7, and 8 for the skip
        bra     line_end
        btsc    w3, #0                  ; 9, and 10 for the skip
        mov.b   [w2], [w1++]            ; 10
        nop                             ; 11
        bra     next_byte               ; 12, 13; the next byte begins at 14
line_end:
        mov     w1, __poxxxx_buffer
        mov     __poxxxx_current_row, w0
        inc     w0, w0
        mov     w0, __poxxxx_current_row
        mov     __poxxxx_row, w1
        cp      w0, w1
        bra     nz, out
        bclr.b  CONTROL4_HIGH, #7
        mov     #1, w0
        mov     w0, __poxxxx_img_ready
out:
        pop.s
        retfie

        .end
