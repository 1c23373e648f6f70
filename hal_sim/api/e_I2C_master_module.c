/* SPDX-License-Identifier: MIT
 * I2C master, primitive by primitive: start the module's operation, wait for its interrupt, give up in the end.
 *
 * Modelled: results, order of tests, time of the bits, the time-outs, the interrupt at priority 5 (a caller at
 * that priority or above waits in vain, as on the robot).
 * Not modelled: a time-out is a time, so that interrupts meanwhile do not make it longer, as they do the robot's
 * counted rounds.
 * Source: [lib: I2C/e_I2C_master_module.c], facts restated.
 */
#include "I2C/e_I2C_master_module.h"

#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_i2c.h"

#define PRIORITY 5
#define ENTRY_CYCLES 12 /* of the interrupt, which comes within the waiting loop [estimated: entry, mode, RETFIE] */
#define BRG 150          /* 164 cycles a bit, 90 kHz */
#define DELAY_ROUNDS 10000
#define PATIENCE 10000       /* rounds until a primitive gives up */
#define READ_PATIENCE 100000 /* the same for a byte to arrive */
#define DELAY_ROUND_CYCLES T_PAUSE_ROUND /* a long counted down and tested */
#define WAIT_ROUND_CYCLES 13  /* [estimated: the same and a byte tested] */

/* operation under way; the interrupt clears it. In the library's object, not in its header. */
volatile char e_i2c_mode;
/* once the interrupt enables during a transaction; the library writes it no more */
int e_interrupts[3];

static void finished(void) { e_i2c_mode = OPERATION_OK; }

/** The library's waiting loop: `rounds` looks at the mode. 1 as soon as it is cleared. */
TAKES(0) static char wait(long rounds) {
  tp_i64 give_up = tp_now() + (tp_i64)rounds * WAIT_ROUND_CYCLES;
  while (e_i2c_mode) {
    tp_i64 now = tp_now(), over = tp_i2c_busy_until();
    if (now >= give_up) return 0;
    /* the interrupt comes when the operation is over, and a round later the loop sees it */
    tp_wait_until(over > now && over < give_up ? over : now + WAIT_ROUND_CYCLES);
  }
  return 1;
}

TAKES(0) static char carry_out(int operation, unsigned char byte, long rounds) {
  if (tp_i2c_begin(operation, byte) < 0) {
    /* no operation, no interrupt: all rounds are counted down */
    tp_wait_until(tp_now() + (tp_i64)rounds * WAIT_ROUND_CYCLES);
    return 0;
  }
  return wait(rounds);
}

TAKES(0) static int is_busy(void) { return tp_i2c_busy_until() > tp_now(); }

void idle_i2c(void);

void idle_i2c(void) {
  while (is_busy()) tp_wait_until(tp_i2c_busy_until());
}

char e_i2c_init(void) {
  tp_i2c_switch(BRG);
  tp_spend((tp_i64)DELAY_ROUNDS * DELAY_ROUND_CYCLES);
  return 1;
}

char e_i2c_deinit(void) {
  tp_i2c_switch(-1);
  tp_irq_install(TP_V_MI2C, 0, PRIORITY, ENTRY_CYCLES);
  return 1;
}

char e_i2c_reset(void) {
  tp_i2c_switch(-1);
  tp_spend((tp_i64)DELAY_ROUNDS * DELAY_ROUND_CYCLES);
  e_i2c_init();
  e_i2c_enable();
  tp_spend((tp_i64)DELAY_ROUNDS * DELAY_ROUND_CYCLES);
  return 1;
}

TAKES(T_I2C_ENABLE) char e_i2c_enable(void) {
  tp_irq_at(TP_V_MI2C, -1);
  tp_irq_install(TP_V_MI2C, finished, PRIORITY, ENTRY_CYCLES);
  return 1;
}

TAKES(T_I2C_ENABLE) char e_i2c_disable(void) {
  tp_irq_at(TP_V_MI2C, -1);
  tp_irq_install(TP_V_MI2C, 0, PRIORITY, ENTRY_CYCLES);
  return 1;
}

TAKES(T_I2C_START) char e_i2c_start(void) {
  e_i2c_mode = START;
  return tp_i2c_stopped() ? carry_out(TP_I2C_START, 0, PATIENCE) : 0;
}

TAKES(T_I2C_RESTART) char e_i2c_restart(void) {
  e_i2c_mode = RESTART;
  return tp_i2c_started() ? carry_out(TP_I2C_RESTART, 0, PATIENCE) : 0;
}

TAKES(T_I2C_STOP) char e_i2c_stop(void) {
  e_i2c_mode = STOP;
  return carry_out(TP_I2C_STOP, 0, PATIENCE);
}

TAKES(T_I2C_ACKNOWLEDGE) char e_i2c_ack(void) {
  e_i2c_mode = ACKNOWLEDGE;
  return is_busy() ? 0 : carry_out(TP_I2C_ACKNOWLEDGE, 0, PATIENCE);
}

TAKES(T_I2C_ACKNOWLEDGE) char e_i2c_nack(void) {
  e_i2c_mode = ACKNOWLEDGE;
  return is_busy() ? 0 : carry_out(TP_I2C_REFUSE, 0, PATIENCE);
}

TAKES(T_I2C_READ) char e_i2c_read(char *buf) {
  tp_i64 give_up = tp_now() + (tp_i64)PATIENCE * WAIT_ROUND_CYCLES;
  e_i2c_mode = READ;
  if (tp_i2c_busy_until() > give_up) {
    tp_wait_until(give_up);
    return 0;
  }
  tp_wait_until(tp_i2c_busy_until());
  if (!carry_out(TP_I2C_READ, 0, READ_PATIENCE)) return 0;
  *buf = (char)tp_i2c_received();
  return 1;
}

TAKES(T_I2C_WRITE) char e_i2c_write(char byte) {
  e_i2c_mode = WRITE;
  return carry_out(TP_I2C_WRITE, (unsigned char)byte, PATIENCE);
}
