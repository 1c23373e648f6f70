/* SPDX-License-Identifier: MIT
 * Sharp distance sensor and LEDs of the LIS turret, by their pins. An inverter lies between: a low latch is on.
 * The pins are also those of the selector (RG6 to RG9) and of the accelerometer (RB6, RB7).
 * Source: [lib: contrib/LIS_sensors_turret/e_sharp.c], facts restated.
 */
#include "contrib/LIS_sensors_turret/e_sharp.h"

#include "a_d/advance_ad_scan/e_acc.h"
#include "motor_led/e_epuck_ports.h"

void e_init_sharp(void) {
  SHARP_LED1_DIR = OUTPUT_PIN;
  SHARP_LED2_DIR = OUTPUT_PIN;
  SHARP_LED3_DIR = OUTPUT_PIN;
  SHARP_LED4_DIR = OUTPUT_PIN;
  SHARP_LED5_DIR = OUTPUT_PIN;
  SHARP_VIN_DIR = OUTPUT_PIN;
  e_sharp_led_clear();
  e_sharp_off();
}

int e_get_dist_sharp(void) { return e_get_acc(0); }

static unsigned int level(unsigned int now, unsigned int value) { return value > 1 ? !now : !value; }

void e_set_sharp_led(unsigned int sharp_led_number, unsigned int value) {
  switch (sharp_led_number) {
    case 1: SHARP_LED1 = level(SHARP_LED1, value); break;
    case 2: SHARP_LED2 = level(SHARP_LED2, value); break;
    case 3: SHARP_LED3 = level(SHARP_LED3, value); break;
    case 4: SHARP_LED4 = level(SHARP_LED4, value); break;
    case 5: SHARP_LED5 = level(SHARP_LED5, value); break;
    default: /* all of them; a toggle switches them on */
      SHARP_LED1 = SHARP_LED2 = SHARP_LED3 = SHARP_LED4 = SHARP_LED5 = !value;
  }
}

void e_sharp_led_clear(void) { e_set_sharp_led(0, 0); }

void e_sharp_on(void) { SHARP_VIN = 0; }

void e_sharp_off(void) { SHARP_VIN = 1; }
