/* SPDX-License-Identifier: MIT
 * The functions that both variants of the LEDs have; the including file brings its agendas.
 * "All" takes bit 0 of the value, so 2 switches all off and 3 all on.
 */
void e_set_led(unsigned int led_number, unsigned int value) {
  if (led_number < RING_LEDS) {
    hal_set_ring(led_number, value);
    return;
  }
  /* the value passes through eight one-bit fields */
  hal_set_rings(value & 1);
}

void e_led_clear(void) { hal_set_rings(0); }

void e_set_body_led(unsigned int value) { hal_set_body(value); }

void e_set_front_led(unsigned int value) { hal_set_front(value); }

#define TOGGLE 2

void e_blink_led(void) { hal_set_rings(TOGGLE); }

void e_blink_led0(void) { hal_set_ring(0, TOGGLE); }
void e_blink_led1(void) { hal_set_ring(1, TOGGLE); }
void e_blink_led2(void) { hal_set_ring(2, TOGGLE); }
void e_blink_led3(void) { hal_set_ring(3, TOGGLE); }
void e_blink_led4(void) { hal_set_ring(4, TOGGLE); }
void e_blink_led5(void) { hal_set_ring(5, TOGGLE); }
void e_blink_led6(void) { hal_set_ring(6, TOGGLE); }
void e_blink_led7(void) { hal_set_ring(7, TOGGLE); }

void e_start_led_blinking(int cycle) { e_activate_agenda(e_blink_led, cycle); }

void e_stop_led_blinking(void) { e_destroy_agenda(e_blink_led); }
