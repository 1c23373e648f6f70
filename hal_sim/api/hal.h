/* SPDX-License-Identifier: MIT
 * What firmware/library asks of the native way: pins, converter, time, each through the seam
 * (hal_sim/host/pins*.h). The chip's answers to the same questions are in hal_dspic/hal.h.
 *
 *   ring LED   0    1    2    3    4    5    6    7        front  body
 *   pin       RA6  RA7  RA9  RA12 RA10 RA13 RA14 RA15       RC1   RC2
 *
 * The driver's variables (adc_arrays.h): on the robot the interrupt writes them; here they are brought up to
 * date when a function of the driver is called (e_get_prox() its own two entries, e_ad_is_*() and the
 * stopwatch everything), and when a controller looks at them itself (adc_seen.c). Source of the pins: [lib:
 * motor_led/e_epuck_ports.h], facts restated.
 */
#ifndef TWINPUCK_API_HAL_H
#define TWINPUCK_API_HAL_H

#include "firmware/library/adc_arrays.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_acc.h"
#include "hal_sim/host/pins_bluetooth.h"
#include "hal_sim/host/pins_eeprom.h"
#include "hal_sim/host/pins_remote.h"

/* --- LEDs --------------------------------------------------------------------------------------------- */

#define RING_LEDS 8
/** A ring LED, the front LED, the body's: 0 or 1; above 1 toggles. */
void hal_set_ring(unsigned int led, unsigned int value);
/** All eight at once. */
void hal_set_rings(unsigned int value);
void hal_set_front(unsigned int value);
void hal_set_body(unsigned int value);
#define set_ring(led, value) hal_set_ring(led, value)
/** Number that a program gave for all LEDs. */
void hal_note_led(unsigned int led);
#define set_front(value) hal_set_front(value)
#define set_body(value) hal_set_body(value)

/* --- motors ------------------------------------------------------------------------------------------- */

/** Coils of wheel 0 (left) or 1 (right); bit 0 is phase A. */
#define hal_coils(wheel, bits) tp_coils_write(wheel, bits)

/* --- time --------------------------------------------------------------------------------------------- */

/** Rounds of an empty loop over a long. */
void hal_pause(unsigned int rounds);

/* --- converter ---------------------------------------------------------------------------------------- */

/** Interrupts that the counters know of. */
extern unsigned long twinpuck_interrupts_seen;

/** Counters and indices as the interrupt would have left them. */
void twinpuck_refresh_adc_counters(void);
/** e_mic_scan and its index. Only samples that are new are evaluated. */
void twinpuck_refresh_mic(void);
/** Samples of each microphone that e_mic_scan knows of. */
extern unsigned long twinpuck_mic_filed;
/** Accelerometer samples and the index of the newest. */
void twinpuck_refresh_acc(void);
/** One sensor's two entries. */
void twinpuck_refresh_ir(unsigned int sensor);
/** Newest accelerometer sample of an axis; times the scan was started. */
#define hal_acc_newest(axis) ((int)tp_scan_acc_newest(axis))
#define hal_scan_starts() ((unsigned int)tp_scan_starts())
/** The counter of interrupts begins anew; the handler takes longer while it counts. */
#define hal_restart_ticks() (tickAdcIsr = 0)

/* --- remote control ----------------------------------------------------------------------------------- */

#define INT0_PRIORITY 4      /* reset value of IPC0 [DS70143 5.2] */
#define INT0_ENTRY_CYCLES 30 /* [estimated: entry 4, context 20, RETFIE 3] */
/** In firmware/library: what a falling edge of the receiver does. */
void twinpuck_remote_edge(void);
#define hal_remote_level() ((unsigned char)tp_remote_level())
#define hal_remote_arm() tp_irq_install(TP_V_INT0, twinpuck_remote_edge, INT0_PRIORITY, INT0_ENTRY_CYCLES)
#define hal_remote_disarm() tp_irq_install(TP_V_INT0, 0, INT0_PRIORITY, INT0_ENTRY_CYCLES)

/* --- camera ------------------------------------------------------------------------------------------- */

#define CAMERA_RESET_PIN 13 /* of port C */
#define CAMERA_RESET_ROUNDS 50
/** A low pulse; first high, so that there is an edge however the pin stood. */
#define hal_camera_reset()                    \
  do {                                        \
    tp_latch_write('C', CAMERA_RESET_PIN, 1); \
    tp_latch_write('C', CAMERA_RESET_PIN, 0); \
    hal_pause(CAMERA_RESET_ROUNDS);           \
    tp_latch_write('C', CAMERA_RESET_PIN, 1); \
    hal_pause(CAMERA_RESET_ROUNDS);           \
  } while (0)
/** Word of the data EEPROM. */
#define hal_eeprom_word(offset) ((int)tp_eeprom_read(offset))

/* --- Bluetooth ---------------------------------------------------------------------------------------- */

/* 14,746 rounds, each a conversion and a comparison of floats [estimated: 60 and 35 cycles, 7 for the
 * counter] */
#define BREAK_CYCLES (14746LL * 102)
/** Holds UART 1's line low. */
#define hal_uart1_break()                   \
  do {                                      \
    tp_uart_break(1, BREAK_CYCLES);         \
    tp_wait_until(tp_now() + BREAK_CYCLES); \
  } while (0)

/* --- memory ------------------------------------------------------------------------------------------- */

#define hal_out_of_memory(text) tp_trap_message(TP_TRAP_ABORT, text)

#endif
