/* SPDX-License-Identifier: MIT
 * Registers of the sensors that keep them in banks, PO6030K and PO8030D: register 3 chooses the bank.
 * Source: [lib: camera/fast_2_timer/e_po6030k_registers.c, e_po8030d_registers.c], facts restated.
 */
#include "I2C/e_I2C_protocol.h"
#include "camera.h"

void hal_camera_set_bank(unsigned char bank) {
  e_i2cp_enable();
  e_i2cp_write((char)CAMERA_ADDRESS, CAMERA_BANK_REGISTER, (char)bank);
  e_i2cp_disable();
}

void hal_camera_write(unsigned char bank, unsigned char reg, unsigned char value) {
  hal_camera_set_bank(bank);
  e_i2cp_enable();
  e_i2cp_write((char)CAMERA_ADDRESS, (char)reg, (char)value);
  e_i2cp_disable();
}

unsigned char hal_camera_read(unsigned char bank, unsigned char reg) {
  unsigned char value;
  hal_camera_set_bank(bank);
  e_i2cp_enable();
  value = (unsigned char)e_i2cp_read((char)CAMERA_ADDRESS, (char)reg);
  e_i2cp_disable();
  return value;
}
