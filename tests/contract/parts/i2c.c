/* SPDX-License-Identifier: MIT
 * I2C primitives: they end, and bytes last nine bits at 90 kHz. */
#include "say.h"
#include <I2C/e_I2C_master_module.h>


int main(void) {
  unsigned int ticks;
  begin();
  e_i2c_init();
  e_i2c_enable();
  say("start", e_i2c_start());
  say("write", e_i2c_write(0x10));
  e_i2c_ack();
  say("ack", I2CCONbits.ACKDT);
  e_i2c_nack();
  say("nack", I2CCONbits.ACKDT);
  say("stop", e_i2c_stop());
  start_clock();
  e_i2c_start();
  e_i2c_write(0x10);
  e_i2c_write(0x10);
  e_i2c_write(0x10);
  e_i2c_stop();
  ticks = TMR1;
  say("ticks", ticks);
  end();
}
