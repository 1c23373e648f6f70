/* SPDX-License-Identifier: MIT
 * Ultrasonic rangers over I2C.
 *
 * Modelled, quirks included: e_get_dist_devantech() asks until register 0 is not 255, for ever when nobody answers;
 * e_get_delay_devantech() assigns in its loop's condition and never ends; light is returned through a signed char, so
 * 128 and more come back as 0xFF80 and more; the e_i2cd_ functions reset the bus after each access, which takes about
 * 20 ms, and do not look whether it worked.
 * e_i2cd_readw() is a comment in the original, whose users do not link; here it does what its prototype says.
 * Source: [lib: contrib/LIS_sensors_turret/e_devantech.c], facts restated.
 */
#include "contrib/LIS_sensors_turret/e_devantech.h"

#include "I2C/e_I2C_protocol.h"

#define COMMAND 0
#define LIGHT_OR_GAIN 1
#define ECHO_OR_RANGE 2
#define RANGE_IN_CM 81
#define RANGE_IN_US 82
#define BUSY 255

void e_init_devantech(void) {
  e_i2c_init();
  e_i2c_enable();
}

void e_disable_devantech(void) { e_i2c_disable(); }

unsigned int e_get_dist_devantech(char device_add) {
  unsigned int high;
  e_i2cp_write(device_add, COMMAND, RANGE_IN_CM);
  while ((unsigned char)e_i2cp_read(device_add, COMMAND) == BUSY) continue;
  high = (unsigned char)e_i2cp_read(device_add, ECHO_OR_RANGE);
  return (high << 8) + (unsigned char)e_i2cp_read(device_add, ECHO_OR_RANGE + 1);
}

unsigned int e_get_delay_devantech(char device_add) {
  e_i2cd_write(device_add, COMMAND, RANGE_IN_US);
  for (;;) e_i2cd_readb(device_add, COMMAND);
}

char e_get_sr_devantech(char device_add) { return e_i2cd_readb(device_add, COMMAND); }

unsigned int e_get_light_devantech(char device_add) {
  return (unsigned int)(int)e_i2cp_read(device_add, LIGHT_OR_GAIN);
}

void e_set_gain_devantech(char device_add, char gain) { e_i2cd_write(device_add, LIGHT_OR_GAIN, gain); }

void e_set_range_devantech(char device_add, char range) { e_i2cd_write(device_add, ECHO_OR_RANGE, range); }

static void name_register(char device_add, char reg) {
  e_i2c_start();
  e_i2c_write(device_add);
  e_i2c_write(reg);
}

void e_i2cd_write(char device_add, char reg, char value) {
  name_register(device_add, reg);
  e_i2c_write(value);
  e_i2c_stop();
  e_i2c_reset();
}

char e_i2cd_readb(char device_add, char reg) {
  char value = 0;
  name_register(device_add, reg);
  e_i2c_restart();
  e_i2c_write(device_add + 1);
  e_i2c_read(&value);
  e_i2c_nack();
  e_i2c_stop();
  e_i2c_reset();
  return value;
}

unsigned int e_i2cd_readw(char device_add, char reg) {
  char high = 0, low = 0;
  name_register(device_add, reg);
  e_i2c_restart();
  e_i2c_write(device_add + 1);
  e_i2c_read(&high);
  e_i2c_ack();
  e_i2c_read(&low);
  e_i2c_nack();
  e_i2c_stop();
  e_i2c_reset();
  return ((unsigned int)(unsigned char)high << 8) + (unsigned char)low;
}
