/* SPDX-License-Identifier: MIT
 * Ring LEDs by number, and the coils of the motors.
 * Source: [lib: motor_led/e_epuck_ports.h], facts restated.
 */
#include "hal.h"

void hal_set_ring(unsigned int led, unsigned int value) {
  switch (led) {
    case 0: HAL_SET_PIN(LED0, value); break;
    case 1: HAL_SET_PIN(LED1, value); break;
    case 2: HAL_SET_PIN(LED2, value); break;
    case 3: HAL_SET_PIN(LED3, value); break;
    case 4: HAL_SET_PIN(LED4, value); break;
    case 5: HAL_SET_PIN(LED5, value); break;
    case 6: HAL_SET_PIN(LED6, value); break;
    case 7: HAL_SET_PIN(LED7, value); break;
    default: break;
  }
}

/* one branch for all, and an instruction a pin */
void hal_set_rings(unsigned int value) {
  if (value > 1) {
    LED0 ^= 1;
    LED1 ^= 1;
    LED2 ^= 1;
    LED3 ^= 1;
    LED4 ^= 1;
    LED5 ^= 1;
    LED6 ^= 1;
    LED7 ^= 1;
  } else if (value) {
    LED0 = 1;
    LED1 = 1;
    LED2 = 1;
    LED3 = 1;
    LED4 = 1;
    LED5 = 1;
    LED6 = 1;
    LED7 = 1;
  } else {
    LED0 = 0;
    LED1 = 0;
    LED2 = 0;
    LED3 = 0;
    LED4 = 0;
    LED5 = 0;
    LED6 = 0;
    LED7 = 0;
  }
}

/* phases 0 to 3: B D, B C, A C, A D */
const unsigned char hal_phase_coils[4] = {0xA, 0x6, 0x5, 0x9};

#define COIL(pin, bit) \
  if (bits & (bit))    \
    pin = 1;           \
  else                 \
    pin = 0

void hal_coils(int wheel, unsigned char bits) {
  if (wheel == 0) {
    COIL(MOTOR1_PHA, 1);
    COIL(MOTOR1_PHB, 2);
    COIL(MOTOR1_PHC, 4);
    COIL(MOTOR1_PHD, 8);
  } else {
    COIL(MOTOR2_PHA, 1);
    COIL(MOTOR2_PHB, 2);
    COIL(MOTOR2_PHC, 4);
    COIL(MOTOR2_PHD, 8);
  }
}
