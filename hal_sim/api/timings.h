/* SPDX-License-Identifier: MIT
 * What the library's calls and handlers take, in processor cycles. Of a call: what the native way charges
 * beside what the compiler estimates for the function's own code [measured: hal_dspic's drivers on the chip's
 * peripherals]. Read by the run, and through takes.h by `twinpuck cycles`.
 */
#ifndef TWINPUCK_API_TIMINGS_H
#define TWINPUCK_API_TIMINGS_H

#define T_INIT_UART 29              /* e_init_uart1(), e_init_uart2() */
#define T_GETSELECTOR 18            /* getselector() */
#define T_WAIT 7                    /* wait() */
#define T_WAIT_ROUND 6              /* each of its rounds */
#define T_PAUSE 5                   /* pause inside the library */
#define T_PAUSE_ROUND 4             /* each of its rounds */
#define T_RING_OFF 19               /* a ring LED, off */
#define T_RING_ON 18                /* on */
#define T_RING_TOGGLE 17            /* toggled */
#define T_RINGS_OFF 17              /* all eight, off */
#define T_RINGS_ON 18               /* on */
#define T_RINGS_TOGGLE 71           /* toggled */
#define T_LED_OFF 5                 /* front or body LED, off */
#define T_LED_ON 6                  /* on */
#define T_LED_TOGGLE 5              /* toggled */
#define T_AGENDA_ACTIVATE 93        /* e_activate_agenda(), empty list */
#define T_AGENDA_FOUND 11           /* pause, restart, reset: the newest of the list */
#define T_AGENDA_CYCLE 7            /* e_set_agenda_cycle(), the newest */
#define T_AGENDA_KNOWN 13           /* e_activate_agenda(), the newest again */
#define T_AGENDA_ACTIVATE_PASSED 12 /* each agenda that it finds */
#define T_AGENDA_PASSED 10          /* each newer agenda that a search passes */
#define T_AGENDA_DESTROY 36         /* e_destroy_agenda(), empty list */
#define T_AGENDA_DESTROY_PASSED 8   /* each newer agenda that it passes */
#define T_AGENDA_FREE 35            /* an agenda that it finds */
#define T_AGENDAS_START 10          /* e_start_agendas_processing() */
#define T_TICK 30                   /* Timer 2's handler, entry and RETFIE included: empty list */
#define T_TICK_FIRST 11             /* an agenda */
#define T_TICK_NODE 13              /* each further one */
#define T_TICK_COUNT 5              /* each that counts */
#define T_AGENDAS_STOP 4            /* e_end_agendas_processing() */
#define T_INIT_MOTORS 5             /* e_init_motors() */
#define T_SPEED 37                  /* e_set_speed_left(), _right(): 0, the newest agenda */
#define T_SPEED_DIVISION 21         /* another speed */
#define T_GET_STEPS 4               /* e_get_steps_left(), _right() */
#define T_SET_STEPS 4               /* e_set_steps_left(), _right() */
#define T_SCAN_INIT 61              /* e_init_ad_scan(), no wait */
#define T_SCAN_OFF 2                /* e_ad_scan_off() */
#define T_SCAN_ON 3                 /* e_ad_scan_on() */
#define T_I2C_ENABLE 6              /* e_i2c_enable(), e_i2c_disable() */
#define T_I2C_START 20              /* e_i2c_start(), beside the time on the wires, as the following */
#define T_I2C_WRITE 15              /* e_i2c_write() */
#define T_I2C_RESTART 12            /* e_i2c_restart() */
#define T_I2C_READ 36               /* e_i2c_read() */
#define T_I2C_ACKNOWLEDGE 44        /* e_i2c_ack(), e_i2c_nack() */
#define T_I2C_STOP 7                /* e_i2c_stop() */
#define T_SCAN_ROUND 8524           /* converter: 65 frames, one round */
#define T_SCAN_ACC 161              /* of these, the frame with the accelerometer */
#define T_SCAN_MICRO 82             /* converter: a frame of MICRO_ONLY */
#define T_MOTOR_HALF 96             /* motor below 601: coils on */
#define T_MOTOR_OFF 96              /* coils off */
#define T_MOTOR_STEP 83             /* motor above 600: coils on */
#define T_UART_END 27               /* UART's transmit handler: nothing left */
#define T_UART_BURST 85             /* four bytes */
#define T_CAMERA_LAUNCH 19          /* e_poxxxx_launch_capture() */
#define T_CAMERA_FRAME 21           /* fast camera: a frame begins */
#define T_CAMERA_LINE 29            /* a line, beside 8 cycles a byte */
#define T_DCI_INIT 24               /* e_init_dci_master() */
#define T_CODEC_INIT 12512          /* e_init_codec_slave() */
#define T_DCI_IDLE 39               /* codec: four samples of silence */
#define T_SOUND_KICKOFF 128         /* e_sub_dci_kickoff() */
#define T_DCI_BUSY 156              /* codec: four samples */
#define T_INIT_AD 13                /* e_init_ad() */
#define T_BASIC_STEP 76             /* basic motors: a step of one wheel */
#define T_BASIC_PROX 773            /* basic proximity sensors: a pair */
#define T_FAST_TIMER 21             /* fast agenda: a timer's handler, beside its tasks */
#define T_SLOW_LAUNCH 22            /* e_po3030k_launch_capture(), slow camera */
#define T_SLOW_FRAME 21             /* a frame begins */
#define T_SLOW_LINE 23              /* a line begins */
#define T_SLOW_BYTE 44              /* a byte that is taken */
#define T_SLOW_SKIPPED 39           /* one that is skipped */

#endif
