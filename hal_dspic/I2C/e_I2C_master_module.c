/* SPDX-License-Identifier: MIT
 * I2C master, primitive by primitive: start the module's operation, wait for its interrupt, give up in the end.
 *
 * The original starts only when I2CSTAT.P says that a stop has been seen, and gets that stop when the module takes over
 * pins that e_init_port() holds low. Here the bus also counts as stopped when no start has been seen since then.
 * Source: [lib: I2C/e_I2C_master_module.c], facts restated; [DS70143 16].
 */
#include "I2C/e_I2C_master_module.h"

#include "hal.h"

#define PRIORITY 5
#define BRG 150 /* 90 kHz */
#define DELAY_ROUNDS 10000
#define PATIENCE 10000       /* rounds until a primitive gives up */
#define READ_PATIENCE 100000 /* the same for a byte to arrive */
#define OPERATION_BITS 0x001F /* ACKEN RCEN PEN RSEN SEN */

/* operation under way; the interrupt clears it. In the library's object, not in its header. */
volatile char e_i2c_mode;
/* the original keeps interrupt enables here and writes it no more */
int e_interrupts[3];

void idle_i2c(void);

void __attribute__((__interrupt__, __auto_psv__)) _MI2CInterrupt(void) {
  IFS0bits.MI2CIF = 0;
  e_i2c_mode = OPERATION_OK;
}

static char is_busy(void) { return (I2CCON & OPERATION_BITS) || I2CSTATbits.TRSTAT; }

static char wait_for_end(long rounds) {
  while (e_i2c_mode)
    if (--rounds <= 0) return 0;
  return 1;
}

void idle_i2c(void) {
  while (is_busy()) continue;
}

char e_i2c_init(void) {
  I2CCON = 0;
  I2CBRG = BRG;
  IPC3bits.MI2CIP = PRIORITY;
  IFS0bits.MI2CIF = 0;
  IFS0bits.SI2CIF = 0;
  IEC0bits.SI2CIE = 0;
  I2CCONbits.I2CEN = 1;
  hal_pause(DELAY_ROUNDS);
  return 1;
}

char e_i2c_deinit(void) {
  I2CCONbits.I2CEN = 0;
  IEC0bits.MI2CIE = 0;
  IFS0bits.MI2CIF = 0;
  return 1;
}

char e_i2c_reset(void) {
  I2CCONbits.I2CEN = 0;
  IFS0bits.MI2CIF = 0;
  IFS0bits.SI2CIF = 0;
  IEC0bits.SI2CIE = 0;
  I2CSTAT = 0;
  hal_pause(DELAY_ROUNDS);
  e_i2c_init();
  e_i2c_enable();
  hal_pause(DELAY_ROUNDS);
  return 1;
}

char e_i2c_enable(void) {
  IFS0bits.MI2CIF = 0;
  IEC0bits.MI2CIE = 1;
  return 1;
}

char e_i2c_disable(void) {
  IEC0bits.MI2CIE = 0;
  IFS0bits.MI2CIF = 0;
  return 1;
}

char e_i2c_start(void) {
  e_i2c_mode = START;
  if (I2CSTATbits.S && !I2CSTATbits.P) return 0;
  I2CCONbits.SEN = 1;
  return wait_for_end(PATIENCE);
}

char e_i2c_restart(void) {
  e_i2c_mode = RESTART;
  if (!I2CSTATbits.S) return 0;
  I2CCONbits.RSEN = 1;
  return wait_for_end(PATIENCE);
}

char e_i2c_stop(void) {
  e_i2c_mode = STOP;
  I2CCONbits.PEN = 1;
  return wait_for_end(PATIENCE);
}

static char answer(unsigned char refuse) {
  e_i2c_mode = ACKNOWLEDGE;
  if (is_busy()) return 0;
  if (refuse)
    I2CCONbits.ACKDT = 1;
  else
    I2CCONbits.ACKDT = 0;
  I2CCONbits.ACKEN = 1;
  return wait_for_end(PATIENCE);
}

char e_i2c_ack(void) { return answer(0); }

char e_i2c_nack(void) { return answer(1); }

char e_i2c_read(char *buf) {
  long rounds = PATIENCE;
  e_i2c_mode = READ;
  while (is_busy())
    if (--rounds <= 0) return 0;
  I2CCONbits.RCEN = 1;
  if (!wait_for_end(READ_PATIENCE)) return 0;
  *buf = (char)I2CRCV;
  return 1;
}

char e_i2c_write(char byte) {
  e_i2c_mode = WRITE;
  I2CTRN = (unsigned char)byte;
  return wait_for_end(PATIENCE);
}
