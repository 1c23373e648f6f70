/* SPDX-License-Identifier: MIT
 * The sensor turret of LIS: an I2C port expander, a range finder, a compass and a Sharp distance sensor.
 */
#ifndef _SENSEXT
#define _SENSEXT

#define I2C_ADDR_SENSEXT 0b10100010
#define I2C_ADDR_SRF08 0xE0
#define I2C_ADDR_SRF10 0xE0
#define I2C_ADDR_CMPS03 0xC0
#define I2C_ADDR_SRF235 0xE0

/** Looks for the turret and initialises what it finds. */
void e_init_sensext(void);

/** One request. sensext_param[0] -1: range in cm and light; -2: compass in 0.1 degrees and as a byte; 0 to
 *  31: sets the five LEDs and reads the Sharp sensor (35 ms when the LEDs changed). Results in sensext_value.
 *  Returns 1, or 0 for another parameter. */
int e_sensext_process(int *sensext_param, unsigned int *sensext_value);

/** The waiting flag of the Sharp sensor: clear, set, read. The first is an agenda callback. */
void e_stop_sensext_wait(void);
void e_start_sensext_wait(void);
int e_get_sensext_wait(void);

#endif
