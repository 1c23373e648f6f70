/* SPDX-License-Identifier: MIT
 * I2C bus: primitives and transactions.
 */
#include "I2C/e_I2C_protocol.h"
#include "unsimulated.h"
#define DEVICE "I2C bus"

/* variables of the driver that programs may name */
__attribute__((weak)) char e_i2c_mode;
__attribute__((weak)) int e_interrupts[3];

UNSIMULATED(char, e_i2c_init, (void))
UNSIMULATED(char, e_i2c_deinit, (void))
UNSIMULATED(char, e_i2c_start, (void))
UNSIMULATED(char, e_i2c_restart, (void))
UNSIMULATED(char, e_i2c_ack, (void))
UNSIMULATED(char, e_i2c_nack, (void))
UNSIMULATED(char, e_i2c_read, (char *buf))
UNSIMULATED(char, e_i2c_stop, (void))
UNSIMULATED(char, e_i2c_write, (char byte))
UNSIMULATED(char, e_i2c_enable, (void))
UNSIMULATED(char, e_i2c_disable, (void))
UNSIMULATED(char, e_i2c_reset, (void))

UNSIMULATED_VOID(e_i2cp_init, (void))
UNSIMULATED_VOID(e_i2cp_deinit, (void))
UNSIMULATED(char, e_i2cp_write, (char device_add, char reg, char value))
UNSIMULATED(char, e_i2cp_read, (char device_add, char reg))
UNSIMULATED(char, e_i2cp_read_string, (char device_add, unsigned char read_buffer[], char start_address,
                                       char string_length))
UNSIMULATED(char, e_i2cp_write_string, (char device_add, unsigned char write_buffer[], char start_address,
                                        char string_length))
UNSIMULATED_VOID(e_i2cp_enable, (void))
UNSIMULATED_VOID(e_i2cp_disable, (void))
