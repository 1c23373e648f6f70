/* SPDX-License-Identifier: MIT
 * I2C master, primitive by primitive. Most programs use e_I2C_protocol.h instead.
 *
 * Bus clock about 90 kHz: 0.1 ms a byte. Each primitive starts the hardware and blocks until the interrupt
 * (priority 5) reports the end, or until a counting loop gives up after some tens of milliseconds; the
 * interrupt must therefore be enabled (e_i2c_enable()).
 * All return 1 for success, 0 for a time-out or a bus in the wrong state.
 * The acknowledge bit is never looked at: writing to a device that is not there succeeds, reading gives 0xFF.
 */
#ifndef _I2C_MASTER_MODULE
#define _I2C_MASTER_MODULE

#include "../p30F6014A.h"

/* operations of the driver's state machine */
#define START 1
#define WRITE 2
#define ACKNOWLEDGE 3
#define READ 4
#define STOP 5
#define RESTART 6
#define ERROR 10
#define OPERATION_OK 0

/** Pins, clock and module on; interrupt priority 5. Blocks for a counting loop of some milliseconds. */
char e_i2c_init(void);

/** Module off. */
char e_i2c_deinit(void);

/** Start condition; the bus must be stopped. */
char e_i2c_start(void);

/** Repeated start; the bus must be started. */
char e_i2c_restart(void);

/** Acknowledges the byte read: go on. */
char e_i2c_ack(void);

/** Refuses further bytes: the last one has been read. */
char e_i2c_nack(void);

/** Receives one byte into *buf. */
char e_i2c_read(char *buf);

/** Stop condition. */
char e_i2c_stop(void);

/** Sends one byte, an address (8 bits, write form; +1 to read) or data. */
char e_i2c_write(char byte);

/** Interrupt of the master module on, off. Other interrupts stay as they are. */
char e_i2c_enable(void);
char e_i2c_disable(void);

/** Module off and on again, interrupt enabled. Blocks for tens of milliseconds. */
char e_i2c_reset(void);

#endif
