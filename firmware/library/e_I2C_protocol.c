/* SPDX-License-Identifier: MIT
 * I2C transactions on registers of a device. A pass in which any primitive failed is followed by a reset of the
 * module, which also enables its interrupt, and by another pass, for ever.
 *
 * The two *_string functions are declared by the header and missing here: the library keeps them as a comment.
 * Programs that call them do not link, with the original library as with this one.
 * Source: [lib: I2C/e_I2C_protocol.c], facts restated.
 */
#include "I2C/e_I2C_protocol.h"

void e_i2cp_init(void) { e_i2c_init(); }

void e_i2cp_deinit(void) { e_i2c_deinit(); }

void e_i2cp_enable(void) { e_i2c_enable(); }

void e_i2cp_disable(void) { e_i2c_disable(); }

char e_i2cp_read(char device_add, char reg) {
  char value = 0;
  for (;;) {
    char fine = e_i2c_start();
    fine &= e_i2c_write(device_add);
    fine &= e_i2c_write(reg);
    fine &= e_i2c_restart();
    fine &= e_i2c_write(device_add + 1);
    fine &= e_i2c_read(&value);
    e_i2c_nack(); /* the results of the last two are not looked at */
    e_i2c_stop();
    if (fine) return value;
    e_i2c_reset();
  }
}

char e_i2cp_write(char device_add, char reg, char value) {
  for (;;) {
    char fine = e_i2c_start();
    fine &= e_i2c_write(device_add);
    fine &= e_i2c_write(reg);
    fine &= e_i2c_write(value);
    fine &= e_i2c_stop();
    if (fine) return fine;
    e_i2c_reset();
  }
}
