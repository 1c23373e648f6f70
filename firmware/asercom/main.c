/* SPDX-License-Identifier: MIT
 * The robot's usual serial command program: a PC on the Bluetooth link commands motors and LEDs and reads
 * every sensor, by lines of text or by short binary sequences. A remote control drives the robot as well.
 *
 *   selector 10   commands come from the turret connector (UART 2, 230,400 baud); camera, I2C, sound are the
 *                 turret's
 *   selector 2    over Bluetooth, in the dialect that Webots expects of a real robot
 *   otherwise     commands come over Bluetooth (UART 1, 115,200 baud)
 *
 * docs/connecting.md describes protocol and connection.
 */
#include <I2C/e_I2C_protocol.h>
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/advance_one_timer/e_remote_control.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <stdio.h>
#include <uart/e_uart_char.h>
#include <utility/utility.h>

#include "commands.h"
#include "link.h"
#include "robot.h"

#define TURRET_POSITION 10
#define WEBOTS_POSITION 2
#define REMOTE_SPEED 600 /* steps/s */

static char last_key; /* of the remote control; 0 does nothing until another key was pressed */

/* a key that was not the last one, from a television's remote control or a hi-fi's */
static int has_new_key(void) {
  unsigned char address = e_get_address();
  return (address == 0 || address == 8) && e_get_data() != last_key;
}

/* the keys lie as the directions do; 5 in the middle stops */
static void obey_key(void) {
  static const signed char halves[10][2] = {{0, 0},  {1, 2},   {2, 2},   {2, 1},  {-2, 2},
                                            {0, 0},  {2, -2}, {-1, -2}, {-2, -2}, {-2, -1}};
  last_key = e_get_data();
  if (last_key == 0) {
    play(5);
    set_speeds(speed_left, speed_right);
  } else if (last_key < 10) {
    set_speeds(halves[(int)last_key][0] * (REMOTE_SPEED / 2), halves[(int)last_key][1] * (REMOTE_SPEED / 2));
  } else {
    set_speeds(0, 0);
  }
}

static void start(void) {
  int position;
  e_init_port();
  if (RCONbits.POR) { /* some robots start badly when power comes: once more */
    RCONbits.POR = 0;
    RESET();
  }
  e_start_agendas_processing();
  e_init_uart1();
  e_init_ad_scan(ALL_ADC);
  position = getselector();
  sprintf(buffer, "Selector pos %d\r\n", position);
  link_text(buffer);

  link_open(position == TURRET_POSITION);
  is_webots = position == WEBOTS_POSITION;
  e_init_motors();
  e_init_remote_control();
  if (!link_is_turret()) {
    e_i2cp_init();
    camera_default();
  }
  if (!(link_is_turret() && isEpuckVersion1_3())) e_acc_calibr();
  link_text(
      "\f\aWELCOME to the SerCom protocol on e-Puck\r\n"
      "the EPFL education robot type \"H\" for help\r\n");
}

int main(void) {
  char c;
  start();
  while (1) {
    c = 0;
    while (!link_poll(&c) && !has_new_key());
    if (c > 0) {
      text_command(c);
    } else if (c < 0) {
      binary_commands(c);
    } else if (has_new_key()) {
      obey_key();
    }
  }
}
