/* SPDX-License-Identifier: MIT
 * Receiver for television remote controls of the RC5 code, on INT0 and the agendas (which must be running).
 * A command takes 24.6 ms to receive; ring LED 1 is lit meanwhile. Nothing here blocks.
 */
#ifndef _IR_REMOTE_CONTROLE
#define _IR_REMOTE_CONTROLE

#include "../../twinpuck.h"

/* keys of the remote control that the robots were delivered with, values of e_get_data() */
#define BOTTOMR 10
#define BOTTOMl 11
#define STANDBY 12
#define MUTE 13
#define VOL_UP 16
#define VOL_DOWN 17
#define CHAN_UP 32
#define CHAN_DOWN 33
#define I_II 35
#define OUT_AUX_1 56

/** Arms the receiver: INT0 on the falling edge, priority 4. */
void e_init_remote_control(void);

/** Samples the next bit; the driver's own agenda, not for controllers. */
void e_read_remote_control(void);

/** Toggle bit of the last command: changes with each new key press, 0 or 1; 2 before the first command. */
unsigned char e_get_check(void);

/** Device address of the last command, 0 to 31; 0 before the first. */
unsigned char e_get_address(void);

/** Key of the last command, 0 to 63; 0 before the first. Stays until the next command. */
unsigned char e_get_data(void);

#endif
