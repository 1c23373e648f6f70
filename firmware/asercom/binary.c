/* SPDX-License-Identifier: MIT
 * Binary commands: each byte is minus a letter; 0 ends the sequence. Replies are collected in order and sent
 * when the 0 has come. Numbers are 16 bits, low byte first. Unknown bytes are skipped.
 *
 * More than the original: replies that do not fit the buffer together are sent in pieces, and a second
 * picture in a sequence waits for the first. Command 'w' has a buffer of its own and leaves earlier replies
 * alone.
 */
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <acc_gyro/e_lsm330.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <string.h>
#include <utility/utility.h>

#include "commands.h"
#include "link.h"
#include "robot.h"

#define RGB_PANEL 0xB0 /* turret with nine LEDs: I2C address */
#define PANEL_SHOW 145 /* register that puts the others into effect */

extern int e_mic_scan[3][MIC_SAMP_NB];
extern unsigned int e_last_mic_scan_id;

static int queued; /* bytes in the buffer */

static void flush(void) {
  camera_finish();
  link_send(buffer, queued);
  queued = 0;
}

/* room for `bytes` more */
static void make_room(int bytes) {
  if (queued + bytes > (int)sizeof buffer) flush();
}

static void put(int byte) {
  make_room(1);
  buffer[queued++] = (char)byte;
}

static void put_word(int value) {
  put(value & 0xFF);
  put(value >> 8 & 0xFF);
}

static int get_word(void) {
  unsigned int low = (unsigned char)link_get();
  return (int)((unsigned int)(unsigned char)link_get() << 8 | low);
}

static void put_acceleration(void) {
  int i;
  for (i = 0; i < 3; i++) put_word(link_is_turret() && isEpuckVersion1_3() ? 0 : e_get_acc_filtered(i, 1));
}

/* three single-precision numbers as they lie in memory: low byte first */
static void put_spherical(void) {
  TypeAccSpheric a = {0, 0, 0};
  if (!(link_is_turret() && isEpuckVersion1_3())) a = e_read_acc_spheric();
  make_room(3 * sizeof(float));
  memcpy(buffer + queued, &a.acceleration, sizeof(float));
  memcpy(buffer + queued + sizeof(float), &a.orientation, sizeof(float));
  memcpy(buffer + queued + 2 * sizeof(float), &a.inclination, sizeof(float));
  queued += 3 * sizeof(float);
}

static void put_rotation(void) {
  int x = 0, y = 0, z = 0;
  if (!link_is_turret() && isEpuckVersion1_3()) getAllAxesGyro(&x, &y, &z);
  put_word(x);
  put_word(y);
  put_word(z);
}

static void put_picture(void) {
  make_room(IMAGE_HEADER + camera.size);
  camera_capture(buffer + queued + IMAGE_HEADER);
  buffer[queued] = (char)camera.mode;
  buffer[queued + 1] = (char)camera.width;
  buffer[queued + 2] = (char)camera.height;
  queued += IMAGE_HEADER + camera.size;
}

static void put_ground(void) {
  int i, values[5], count = read_ground(values);
  for (i = 0; i < count; i++) put_word(values[i]);
}

static void put_sensors(int (*read)(unsigned int)) {
  int i, sensors = link_is_turret() ? 10 : 8;
  for (i = 0; i < sensors; i++) put_word(read(i));
}

static int proximity(unsigned int sensor) { return e_get_calibrated_prox(sensor); }
static int light(unsigned int sensor) { return e_get_ambient_light(sensor); }

static void set_led(int number, int value) {
  if (number == 8 || number == 9) {
    if (link_is_turret()) return; /* these pins flash the turret's sensors */
    if (number == 8) {
      e_set_body_led(value);
    } else {
      e_set_front_led(value);
    }
  } else {
    e_set_led(number, value);
  }
}

/* 35 bytes: registers 0 to 23, 146 to 148 and 164 to 171 of the panel */
static void write_panel(void) {
  static const unsigned char first[3] = {0, 146, 164}, count[3] = {24, 3, 8};
  char bytes[35];
  int group, i, n = 0;
  for (i = 0; i < (int)sizeof bytes; i++) bytes[i] = link_get();
  for (group = 0; group < 3; group++)
    for (i = 0; i < count[group]; i++) i2c_write(RGB_PANEL, first[group] + i, bytes[n++]);
  i2c_write(RGB_PANEL, PANEL_SHOW, 1);
}

/* what the turret's computer has for itself; 1 when the letter was one of these */
static int bluetooth_only(int letter) {
  int device, reg;
  switch (letter) {
    case 'I': put_picture(); return 1;
    case 'M': put_ground(); return 1;
    case 'W':
      device = (unsigned char)link_get();
      reg = (unsigned char)link_get();
      i2c_write(device, reg, link_get());
      return 1;
    case 'w': write_panel(); return 1;
  }
  return 0;
}

static void obey(int letter) {
  int left, right;
  if (!link_is_turret() && bluetooth_only(letter)) return;
  switch (letter) {
    case 'a': put_acceleration(); break;
    case 'A': put_spherical(); break;
    case 'b':
      put_word(isEpuckVersion1_3() ? (int)getBatteryValueRaw() : BATT_LOW);
      break;
    case 'D':
      left = get_word();
      right = get_word();
      set_speeds(left, right);
      break;
    case 'E':
      put_word(speed_left);
      put_word(speed_right);
      break;
    case 'g': put_rotation(); break;
    case 'L':
      left = (unsigned char)link_get();
      set_led(left, (unsigned char)link_get());
      break;
    case 'N': put_sensors(proximity); break;
    case 'O': put_sensors(light); break;
    case 'P':
      left = get_word();
      right = get_word();
      e_set_steps_left(left);
      e_set_steps_right(right);
      break;
    case 'Q':
      put_word(e_get_steps_left());
      put_word(e_get_steps_right());
      break;
    case 't': put(!link_is_turret() && isEpuckVersion1_3() ? getTemperature() : 0); break;
    case 'u':
      put_word(e_get_micro_volume(0));
      put_word(e_get_micro_volume(1));
      put_word(e_get_micro_volume(2));
      break;
    case 'U': /* at once, ahead of the other replies; the index follows among them */
      e_get_micro_volume(0);
      link_send((const char *)e_mic_scan, sizeof e_mic_scan);
      put(e_last_mic_scan_id & 0xFF);
      break;
  }
}

void binary_commands(char first) {
  char c = first;
  queued = 0;
  do {
    obey(-c);
    c = link_get();
  } while (c != 0);
  flush();
}
