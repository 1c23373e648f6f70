/* SPDX-License-Identifier: MIT
 * Port initialisation, and the question whether this robot is of revision 1.3.
 *
 * Modelled: latches and directions; the time the library spends on starting the I2C bus and asking, as a sum;
 * the answer of whatever hangs on the bus. On revision 1.3 the sensors are started over the bus, byte by byte.
 * Source: [lib: motor_led/e_init_port.c], facts restated.
 */
#include "motor_led/e_init_port.h"

#include "acc_gyro/e_lsm330.h"
#include "hal_sim/api/timings.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_acc.h"

/* bus start: four waiting loops of 10,000 rounds; then ports, and a read of four bytes at 90 kHz */
#define I2C_START_CYCLES (4 * 10000L * T_PAUSE_ROUND)
#define I2C_READ_CYCLES 7201 /* [measured: hal_dspic] */

/* exported under this name by the library's object */
unsigned char isPresentFlag;

void e_init_port(void) {
  tp_init_ports();
  tp_spend(I2C_START_CYCLES + I2C_READ_CYCLES);
  isPresentFlag = (unsigned char)tp_lsm330_answers();
  if (isPresentFlag) initAccAndGyro();
}

unsigned char isEpuckVersion1_3(void) { return isPresentFlag; }
unsigned char isEpuckVersion1_1(void) { return isPresentFlag; }
