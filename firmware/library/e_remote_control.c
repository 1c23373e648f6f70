/* SPDX-License-Identifier: MIT
 * RC5 remote control: external interrupt 0 on the receiver's falling edge starts an agenda that samples the
 * bits. What it decodes is what the pin carries, noise and half frames included.
 *
 *   edge in the middle of the first bit     t = 0
 *   second start bit, must be low           2.1 ms
 *   toggle bit                              3.0 ms
 *   5 address bits, 6 key bits              every 1.8 ms (a bit lasts 1.778 ms)
 *   done, armed again                      24.6 ms
 *
 * Agenda ticks are 0.1 ms and do not wait for the edge, so all of this is up to one tick early.
 * Source: [lib: motor_led/advance_one_timer/e_remote_control.c], facts restated.
 */
#include "motor_led/advance_one_timer/e_remote_control.h"

#include "hal.h"
#include "motor_led/advance_one_timer/e_agenda.h"

#define TO_START_BIT 21      /* ticks of 0.1 ms */
#define TO_TOGGLE 9
#define TO_NEXT_BIT 18
#define RECEIVING_LED 1
#define ADDRESS_BITS 5
#define KEY_BITS 6

/* what is being received: -1 nothing yet, 0 the toggle bit, 1 to 11 address and key, 12 the end */
static signed char bit = -1;
static unsigned char toggle_so_far, address_so_far, data_so_far;
static unsigned char check = 2, address, data;

void hal_remote_edge(void) {
  hal_remote_disarm();
  address_so_far = data_so_far = 0;
  bit = -1;
  e_activate_agenda(e_read_remote_control, TO_START_BIT);
}

void e_init_remote_control(void) {
  hal_remote_arm();
}

static void arm_again(void) {
  bit = -1;
  e_destroy_agenda(e_read_remote_control);
  e_init_remote_control();
}

void e_read_remote_control(void) {
  unsigned char level = hal_remote_level();
  if (bit < 0) {
    if (level) {
      arm_again(); /* not a start bit: noise */
      return;
    }
    e_set_agenda_cycle(e_read_remote_control, TO_TOGGLE);
  } else if (bit == 0) {
    hal_set_ring(RECEIVING_LED, 1);
    toggle_so_far = level;
    e_set_agenda_cycle(e_read_remote_control, TO_NEXT_BIT);
  } else if (bit <= ADDRESS_BITS) {
    address_so_far = (unsigned char)(address_so_far << 1 | level);
  } else if (bit <= ADDRESS_BITS + KEY_BITS) {
    data_so_far = (unsigned char)(data_so_far << 1 | level);
  } else {
    check = toggle_so_far;
    address = address_so_far;
    data = data_so_far;
    hal_set_ring(RECEIVING_LED, 0);
    arm_again();
    return;
  }
  bit++;
}

unsigned char e_get_check(void) { return check; }

unsigned char e_get_address(void) { return address; }

unsigned char e_get_data(void) { return data; }
