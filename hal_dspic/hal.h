/* SPDX-License-Identifier: MIT
 * What firmware/library asks of the chip: LEDs, coils, samples, delays, each on registers.
 *
 * A pin is set by an instruction on its one bit, never by reading, changing and writing the port: an interrupt between
 * would lose what it wrote. So values that are not constants go through a branch.
 */
#ifndef HAL_DSPIC_HAL_H
#define HAL_DSPIC_HAL_H

#include "firmware/library/adc_arrays.h"
#include "motor_led/e_epuck_ports.h"

/* --- LEDs */

#define RING_LEDS 8
/** 0 off, 1 on, above toggles; of other values bit 0 counts. */
#define HAL_SET_PIN(pin, value)     \
  do {                              \
    if ((value) > 1) {              \
      if (pin) pin = 0; else pin = 1; \
    } else if (value) {             \
      pin = 1;                      \
    } else {                        \
      pin = 0;                      \
    }                               \
  } while (0)
/** Ring LED 0 to 7, clockwise from the front. */
void hal_set_ring(unsigned int led, unsigned int value);
/** All eight at once. */
void hal_set_rings(unsigned int value);
#define hal_set_front(value) HAL_SET_PIN(FRONT_LED, value)
#define hal_set_body(value) HAL_SET_PIN(BODY_LED, value)

/* --- motors */

/** Coils of wheel 0 (left) or 1 (right); bit 0 is phase A. */
void hal_coils(int wheel, unsigned char bits);
/** Coils of the driver's phase 0 to 3: two of four energised, neighbours differ in one pair. */
extern const unsigned char hal_phase_coils[4];

/* --- time */

/** Rounds of an empty loop over a long; what one takes is the compiler's (4 cycles at -O1). */
void hal_pause(unsigned int rounds);

/* --- converter */

/** Newest accelerometer sample of an axis; times the scan was started. */
#define hal_acc_newest(axis) (e_acc_scan[axis][e_last_acc_scan_id])
#define hal_scan_starts() (hal_starts)
extern unsigned int hal_starts;
/** The counter of interrupts begins anew. */
#define hal_restart_ticks() (tickAdcIsr = 0)

/* --- remote control */

/** In firmware/library: what a falling edge of the receiver does. */
void hal_remote_edge(void);
#define hal_remote_level() ((unsigned char)REMOTE)
void hal_remote_arm(void);
void hal_remote_disarm(void);

/* --- camera */

/** A low pulse at the camera's reset pin. */
void hal_camera_reset(void);
/** Word of the data EEPROM, offset 0xF000 to 0xFFFE. */
int hal_eeprom_word(unsigned int offset);

/* --- Bluetooth */

/** Holds UART 1's line low for about 100 ms. */
void hal_uart1_break(void);

/* --- memory */

/** Ends the program, as a full heap does on the robot. */
#define hal_out_of_memory(text) exit(1)

#endif
