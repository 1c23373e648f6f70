; SPDX-License-Identifier: MIT
; The robot's bootloader: takes a program over UART 1 (Bluetooth) and writes it into flash. 115,200 baud.
; twinpuck asm hal_dspic/bootloader/bootloader.s -o bootloader.hex makes it; a programmer puts it into the chip once.
;
; Protocol and place are those of the bootloader that e-pucks have (tinybootloader), so its uploaders work:
;
;   PC     0xC1                                  after a reset, within a second
;   robot  'q' 'K'
;   PC     address (3 bytes) 0x60 row (96) sum   32 words of 3 bytes, low byte first; all bytes add up to 0
;   robot  'K' written, 'N' sum or place is wrong: once more, please
;   PC     blinks, 0, 0, 0xFF                    the end: LED 6, then the program starts
;
; One frame more, for what was written to be verified. A bootloader without it sees a wrong sum and says 'N':
;
;   PC     address (3) 0xFE row (96) sum         all bytes add up to 1
;   robot  'R' row (96) sum                      as it stands in flash; these 97 add up to 0
;
; After a second of silence the program starts: at `user`, where an uploader puts a goto to it. Without one the
; bootloader begins again, so a robot whose upload was cut off waits for the next.

    .equ FRAME, 0x850            ; address, kind, row, sum
    .equ SILENCE, 35             ; times 65,536 turns of 7 cycles at 14.7 MHz: 1.1 seconds
    config __FOSC, 0xFFE6        ; crystal, PLL times 8
    config __FWDT, 0x7FFF        ; no watchdog
    config __FBORPOR, 0xFF7F     ; no brown-out reset, MCLR on

; --- row 0x17EC0: what does not fit behind the entry. An uploader cannot write it

    .section .extension, code, address(0x17EC0)
; W12: the row that is asked for or to be written, its page in TBLPAG. To `bad` if it holds the bootloader.
check_place:
    mov #0xFFC0, w0
    and w12, w0, w12             ; rows begin at multiples of 64
    mov TBLPAG, w0
    dec w0, w0
    bra n, write                 ; page 0
    bra nz, bad                  ; no flash there
    mov #0x7EC0, w0
    cp w12, w0
    bra z, bad
    mov #0x7F40, w0
    cp w12, w0
    bra geu, bad
    bra write

read_row:
    dec.b w13, w13
    bra nz, bad
    mov.b #'R', w2   ; R
    rcall send
    clr w13
    mov #32, w6
1:  tblrdl.b [w12++], w2
    rcall send_added
    tblrdl.b [w12--], w2
    rcall send_added
    tblrdh.b [w12++], w2
    rcall send_added
    inc w12, w12
    dec w6, w6
    bra nz, 1b
    neg.b w13, w2
    rcall send
    bra next_frame

; --- row 0x17F00: its last four words are the uploader's

    .section .user, code, address(0x17F38)
user:
    nop
    nop
    nop
    nop

; --- rows 0x17F40 to 0x17FFF

    .section .boot, code, address(0x17F40)
__reset:
    mov #0x800, w15
    mov #7, w0                   ; 14.7456 MHz / 16 / (7 + 1) = 115,200
    mov w0, U1BRG
    bset U1MODE, #15
    bset U1STA, #10
    mov #FRAME, w4
    rcall receive
    sub.b #0xC1, w1
    bra nz, start_user
    mov.b #'q', w2
    rcall send
written:
    mov.b #'K', w2
answer:
    rcall send
next_frame:
    clr w13
    mov #FRAME, w4
    mov #4, w6
    rcall receive_many
    mov FRAME, w12
    mov FRAME + 2, w3
    mov w3, TBLPAG
    lsr w3, #8, w3
    sub.b #0xFF, w3
    bra z, blink
    mov #97, w6
    rcall receive_many
    inc.b w3, w3
    bra z, read_row
    cp0.b w13
    bra z, check_place
bad:
    mov.b #'N', w2
    bra answer

write:
    tblwtl w0, [w12]             ; the row to be erased
    mov #0x4041, w0
    rcall unlock
    mov #FRAME + 4, w4
    do #31, 1f
    tblwtl.b [w4++], [w12++]
    tblwtl.b [w4++], [w12--]
    tblwth.b [w4++], [w12]
1:  inc2 w12, w12
    mov #0x4001, w0
    rcall unlock
    bra written

unlock:
    mov w0, NVMCON
    mov #0x55, w0
    mov w0, NVMKEY
    mov #0xAA, w0
    mov w0, NVMKEY
    bset NVMCON, #15
    nop
    nop
    return

receive_many:
    rcall receive
    dec w6, w6
    bra nz, receive_many
    return

; W1: the next byte, also at [W4++] and added to W13
receive:
    mov #SILENCE, w10
1:  clr w11
2:  btss U1STA, #0
    bra 3f
    mov U1RXREG, w1
    mov.b w1, [w4++]
    add.b w1, w13, w13
    return
3:  clrwdt
    dec w11, w11
    bra nz, 2b
    dec w10, w10
    bra nz, 1b
start_user:
    clr U1MODE
    bra user

send_added:
    add.b w2, w13, w13
send:
    btsc U1STA, #9
    bra send
    mov w2, U1TXREG
    return

blink:
    ze w12, w12                  ; at most 3 s, should the frame be a spoiled one
    bclr TRISA, #14
    bset LATA, #14
1:  setm w0
2:  dec w0, w0
    bra nz, 2b
    dec w12, w12
    bra nz, 1b
    bclr LATA, #14
    bra start_user
