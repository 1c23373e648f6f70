/* SPDX-License-Identifier: MIT
 * One entrance to the LIS turret's sensors: ranger, compass, or LEDs with the Sharp sensor.
 *
 * Modelled: the waits by an agenda (5 ms without supply, 30 ms with it) when the LEDs change, which never end unless
 * e_init_sensext() was called and agendas run; an absent ranger is asked for ever.
 * Source: [lib: contrib/LIS_sensors_turret/e_sensext.c], facts restated.
 */
#include "contrib/LIS_sensors_turret/e_sensext.h"

#include "I2C/e_I2C_protocol.h"
#include "a_d/advance_ad_scan/e_acc.h"
#include "contrib/LIS_sensors_turret/e_sharp.h"
#include "motor_led/advance_one_timer/e_agenda.h"
#include "motor_led/e_epuck_ports.h"

#define RANGER_AND_LIGHT -1
#define COMPASS -2
#define LAST_PATTERN 31
#define RANGE_IN_CM 81
#define BUSY 255
#define OFF_TICKS 50 /* agenda ticks of 0.1 ms */
#define ON_TICKS 300

static volatile int is_waiting;

void e_stop_sensext_wait(void) { is_waiting = 0; }

void e_start_sensext_wait(void) { is_waiting = 1; }

int e_get_sensext_wait(void) { return is_waiting; }

void e_init_sensext(void) { e_activate_agenda(e_stop_sensext_wait, 0); }

static unsigned int byte_of(char device_add, char reg) { return (unsigned char)e_i2cp_read(device_add, reg); }

static void pause_ticks(int ticks) {
  e_start_sensext_wait();
  e_set_agenda_cycle(e_stop_sensext_wait, ticks);
  while (e_get_sensext_wait()) continue;
  e_set_agenda_cycle(e_stop_sensext_wait, 0);
}

static void read_ranger(unsigned int *value) {
  e_i2cp_enable();
  e_i2cp_write((char)I2C_ADDR_SRF10, 0, RANGE_IN_CM);
  while (byte_of((char)I2C_ADDR_SRF10, 0) == BUSY) continue;
  value[0] = byte_of((char)I2C_ADDR_SRF10, 2) << 8;
  value[0] += byte_of((char)I2C_ADDR_SRF10, 3);
  value[1] = byte_of((char)I2C_ADDR_SRF10, 1);
  e_i2cp_disable();
}

static void read_compass(unsigned int *value) {
  unsigned int low;
  e_i2cp_enable();
  low = byte_of((char)I2C_ADDR_CMPS03, 3); /* before the high byte, as the library does */
  value[0] = (byte_of((char)I2C_ADDR_CMPS03, 2) << 8) + low;
  value[1] = byte_of((char)I2C_ADDR_CMPS03, 1);
  e_i2cp_disable();
}

static void read_sharp(int *param, unsigned int *value) {
  SHARP_LED1 = !(param[0] & 1);
  SHARP_LED2 = !(param[0] & 2);
  SHARP_LED3 = !(param[0] & 4);
  SHARP_LED4 = !(param[0] & 8);
  SHARP_LED5 = !(param[0] & 16);
  if (param[1] != param[0]) {
    e_sharp_off();
    pause_ticks(OFF_TICKS);
    e_sharp_on();
    pause_ticks(ON_TICKS);
  }
  value[0] = e_get_acc(0);
  param[1] = param[0];
}

int e_sensext_process(int *sensext_param, unsigned int *sensext_value) {
  if (sensext_param[0] == RANGER_AND_LIGHT)
    read_ranger(sensext_value);
  else if (sensext_param[0] >= 0 && sensext_param[0] <= LAST_PATTERN)
    read_sharp(sensext_param, sensext_value);
  else if (sensext_param[0] == COMPASS)
    read_compass(sensext_value);
  else
    return 0;
  return 1;
}
