/* SPDX-License-Identifier: MIT
 * LEDs, usual variant: blinking by agendas, and animations.
 */
#include "motor_led/advance_one_timer/e_led.h"

#include "motor_led/advance_one_timer/e_agenda.h"
#include "hal.h"
#include "e_led_shared.h"

/* in the library's object, in none of its headers */
void e_set_blinking_cycle(int cycle);

void e_set_blinking_cycle(int cycle) {
  if (cycle >= 0) e_set_agenda_cycle(e_blink_led, cycle);
}

/* --- animations: one step a call */

/* one LED travels clockwise; the one behind it goes out */
void snake_led(void) {
  static unsigned char head;
  e_set_led(head == 0 ? 7 : head - 1, 0);
  e_set_led(head, 1);
  head = head == 7 ? 0 : head + 1;
}

/* toggles from the front to the back: 0, then the pairs, then 4 */
void flow_led(void) {
  static unsigned char row;
  e_set_led(row, TOGGLE);
  if (row > 0 && row < 4) e_set_led(8 - row, TOGGLE);
  row = row == 4 ? 0 : row + 1;
}

/* 0, 1, 0, 7, 0, 1, ... */
void k2000_led(void) {
  static unsigned char lit;
  static unsigned char to_the_right = 1;
  e_set_led(lit, 0);
  if (lit == 0) {
    lit = to_the_right ? 1 : 7;
    to_the_right = !to_the_right;
  } else {
    lit = 0;
  }
  e_set_led(lit, 1);
}

/* front and back, then the pair beside them, then the LED at the side; then all out */
static void point_to_side(unsigned char *step, unsigned char before, unsigned char behind,
                          unsigned char side) {
  switch (*step) {
    case 0: e_set_led(0, TOGGLE); e_set_led(4, TOGGLE); break;
    case 1: e_set_led(before, TOGGLE); e_set_led(behind, TOGGLE); break;
    case 2: e_set_led(side, TOGGLE); break;
    default: e_led_clear();
  }
  *step = *step == 3 ? 0 : *step + 1;
}

void right_led(void) {
  static unsigned char step;
  point_to_side(&step, 1, 3, 2);
}

void left_led(void) {
  static unsigned char step;
  point_to_side(&step, 7, 5, 6);
}
