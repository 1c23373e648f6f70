/* SPDX-License-Identifier: MIT
 * The functions that both variants of the LEDs have; the including file brings its agendas.
 * "All" takes bit 0 of the value, so 2 switches all off and 3 all on.
 */
void e_set_led(unsigned int led_number, unsigned int value) {
  if (led_number < RING_LEDS) {
    set_ring(led_number, value);
    return;
  }
  hal_note_led(led_number);
  /* the value passes through eight one-bit fields */
  hal_set_rings(value & 1);
}

void e_led_clear(void) { hal_set_rings(0); }

void e_set_body_led(unsigned int value) { set_body(value); }

void e_set_front_led(unsigned int value) { set_front(value); }

#define TOGGLE 2

void e_blink_led(void) { hal_set_rings(TOGGLE); }

void e_blink_led0(void) { set_ring(0, TOGGLE); }
void e_blink_led1(void) { set_ring(1, TOGGLE); }
void e_blink_led2(void) { set_ring(2, TOGGLE); }
void e_blink_led3(void) { set_ring(3, TOGGLE); }
void e_blink_led4(void) { set_ring(4, TOGGLE); }
void e_blink_led5(void) { set_ring(5, TOGGLE); }
void e_blink_led6(void) { set_ring(6, TOGGLE); }
void e_blink_led7(void) { set_ring(7, TOGGLE); }

void e_start_led_blinking(int cycle) { e_activate_agenda(e_blink_led, cycle); }

void e_stop_led_blinking(void) { e_destroy_agenda(e_blink_led); }
