/* SPDX-License-Identifier: MIT
 * Ultrasonic range finders of Devantech (SRF08, SRF10, SRF235) on the I2C connector, address 0xE0 as
 * delivered.
 */
#ifndef _devantech
#define _devantech

#include "./../../I2C/e_I2C_master_module.h"
#include "./../../motor_led/e_epuck_ports.h"

/** I2C on, off. */
void e_init_devantech(void);
void e_disable_devantech(void);

/** Distance in cm. Blocks for a measurement, up to 65 ms. */
unsigned int e_get_dist_devantech(char device_add);

/** Echo time in us. Its loop has an assignment for a condition and never ends, as in the original. */
unsigned int e_get_delay_devantech(char device_add);

/** Software revision of the sensor. */
char e_get_sr_devantech(char device_add);

/** Light, 0 to 255 (SRF08). */
unsigned int e_get_light_devantech(char device_add);

/** Receiver gain, and greatest range in units of 43 mm. */
void e_set_gain_devantech(char device_add, char gain);
void e_set_range_devantech(char device_add, char range);

/** Register access: one byte out, one byte in, two bytes in (high first). Each blocks for about 0.5 ms. */
void e_i2cd_write(char device_add, char reg, char value);
char e_i2cd_readb(char device_add, char reg);
unsigned int e_i2cd_readw(char device_add, char reg);

#endif
