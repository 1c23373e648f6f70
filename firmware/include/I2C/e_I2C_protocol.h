/* SPDX-License-Identifier: MIT
 * I2C transactions on registers of a device; the usual variant.
 *
 * Addresses are 8 bits, write form: camera 0xDC, ground sensors 0xC0, accelerometer of revision 1.3 0x3C.
 * Use: e_i2cp_init() once, then e_i2cp_enable(), transactions, e_i2cp_disable().
 * A transaction blocks for about 0.5 ms. When the bus does not answer it is reset and tried again, for ever.
 */
#ifndef _I2C_PROTOCOL
#define _I2C_PROTOCOL

#include "e_I2C_master_module.h"
#include "../motor_led/e_epuck_ports.h"

/** Starts the module: e_i2c_init(), blocks for some milliseconds. */
void e_i2cp_init(void);

/** Module off. */
void e_i2cp_deinit(void);

/** Writes `value` to register `reg`. Returns 1. */
char e_i2cp_write(char device_add, char reg, char value);

/** Reads register `reg`, as a signed char; 0xFF (-1) when the device is absent. */
char e_i2cp_read(char device_add, char reg);

/** Several registers from `start_address` on. Declared by the original library's header and contained in none
 *  of its versions (there they are a comment): programs that call them do not link. */
char e_i2cp_read_string(char device_add, unsigned char read_buffer[], char start_address,
                        char string_length);
char e_i2cp_write_string(char device_add, unsigned char write_buffer[], char start_address,
                         char string_length);

/** Interrupt of the module on before, off after transactions. */
void e_i2cp_enable(void);
void e_i2cp_disable(void);

#endif
