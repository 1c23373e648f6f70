/* SPDX-License-Identifier: MIT
 * Text commands: a letter, numbers behind commas, CR or LF. Every reply line ends with CR LF. A number that
 * is missing keeps the value it had in the command before.
 */
#include <DataEEPROM.h>
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <acc_gyro/e_lsm330.h>
#include <ctype.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/advance_one_timer/e_remote_control.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <stdio.h>
#include <string.h>
#include <utility/utility.h>

#include "commands.h"
#include "link.h"
#include "robot.h"

#define RING_SENSORS 8
#define TURRET_SENSORS 10 /* two more on the turret */

/* one line of the help: the command, its meaning, who has it */
struct help {
  const char *form, *meaning;
  char where;
};
enum { EVERYWHERE, ON_BLUETOOTH, WITH_GYROSCOPE };
static const struct help helps[] = {
    {"A", "acceleration x,y,z", EVERYWHERE},
    {"B,v", "body LED: 0 off, 1 on, 2 toggle", ON_BLUETOOTH},
    {"b", "battery", EVERYWHERE},
    {"C", "selector position", EVERYWHERE},
    {"D,l,r", "set speeds, steps/s", EVERYWHERE},
    {"E", "get speeds", EVERYWHERE},
    {"F,v", "front LED: 0 off, 1 on, 2 toggle", ON_BLUETOOTH},
    {"G", "IR remote control", ON_BLUETOOTH},
    {"g", "rotation x,y,z", WITH_GYROSCOPE},
    {"H", "this help", EVERYWHERE},
    {"I", "get camera mode,width,height,zoom,size", ON_BLUETOOTH},
    {"J,m,w,h,z,x,y", "set camera: mode,width,height,zoom and corner", ON_BLUETOOTH},
    {"K", "calibrate proximity sensors", EVERYWHERE},
    {"L,n,v", "LED n, 8 for all: 0 off, 1 on, 2 toggle", EVERYWHERE},
    {"M", "ground sensors", ON_BLUETOOTH},
    {"N", "proximity", EVERYWHERE},
    {"O", "ambient light", EVERYWHERE},
    {"P,l,r", "set step counters", EVERYWHERE},
    {"Q", "get step counters", EVERYWHERE},
    {"R", "reset", EVERYWHERE},
    {"S", "stop, LEDs off", EVERYWHERE},
    {"T,n", "sound 1 to 5, other: codec off", ON_BLUETOOTH},
    {"t", "temperature", WITH_GYROSCOPE},
    {"U", "loudness at the microphones", EVERYWHERE},
    {"V", "version", EVERYWHERE},
    {"W,d,r,v", "write v to register r of I2C device d", ON_BLUETOOTH},
    {"Y,d,r", "read register r of I2C device d", ON_BLUETOOTH},
};

static void send_help(void) {
  unsigned int i;
  link_text("\n");
  for (i = 0; i < sizeof helps / sizeof helps[0]; i++) {
    if (helps[i].where == WITH_GYROSCOPE && !isEpuckVersion1_3()) continue;
    if (helps[i].where != EVERYWHERE && link_is_turret()) continue;
    sprintf(buffer, "\"%s\"%*s%s\r\n", helps[i].form, 16 - (int)strlen(helps[i].form), "", helps[i].meaning);
    link_text(buffer);
  }
}

static void send_acceleration(void) {
  int i, values[3] = {0, 0, 0};
  /* with the turret the bus of the newer sensor is the turret's */
  if (!(link_is_turret() && isEpuckVersion1_3()))
    for (i = 0; i < 3; i++) values[i] = e_get_acc_filtered(i, 1);
  sprintf(buffer, "a,%d,%d,%d\r\n", values[0], values[1], values[2]);
  link_text(buffer);
}

static void send_battery(void) {
  if (isEpuckVersion1_3()) {
    sprintf(buffer, "b,%d (%d%%)\r\n", getBatteryValueRaw(), getBatteryValuePercentage());
  } else {
    sprintf(buffer, "b,%d\r\n", BATT_LOW);
  }
  link_text(buffer);
}

static void send_rotation(void) {
  int x = 0, y = 0, z = 0;
  if (!link_is_turret() && isEpuckVersion1_3()) {
    x = getXAxisGyro();
    y = getYAxisGyro();
    z = getZAxisGyro();
  }
  sprintf(buffer, "g,%d,%d,%d\r\n", x, y, z);
  link_text(buffer);
}

static void send_remote(void) {
  sprintf(buffer, "g IR check : 0x%x, address : 0x%x, data : 0x%x\r\n", e_get_check(), e_get_address(),
          e_get_data());
  link_text(buffer);
}

/* a letter and a line of numbers */
static void send_numbers(char letter, const int *values, int count) {
  char *end = buffer;
  int i;
  *end++ = letter;
  for (i = 0; i < count; i++) end += sprintf(end, ",%d", values[i]);
  strcpy(end, "\r\n");
  link_text(buffer);
}

static void send_ground(void) {
  int values[5], count = read_ground(values);
  send_numbers('m', values, count);
}

/* letter and a value per sensor */
static void send_sensors(char letter, int (*read)(unsigned int)) {
  int i, values[TURRET_SENSORS], sensors = link_is_turret() ? TURRET_SENSORS : RING_SENSORS;
  for (i = 0; i < sensors; i++) values[i] = read(i);
  send_numbers(letter, values, sensors);
}

static int proximity(unsigned int sensor) { return e_get_calibrated_prox(sensor); }
static int light(unsigned int sensor) { return e_get_ambient_light(sensor); }

static void set_camera(void) {
  int x1 = -1, y1 = -1;
  sscanf(buffer, "J,%d,%d,%d,%d,%d,%d", &camera.mode, &camera.width, &camera.height, &camera.zoom, &x1, &y1);
  camera_set(x1, y1);
  link_text("j\r\n");
}

static void calibrate(void) {
  link_text("k, Starting calibration - Remove any object in sensors range\r\n");
  e_set_led(8, 1);
  wait(1000000L);
  e_led_clear();
  wait(10000L);
  e_calibrate_ir();
  link_text("k, Calibration finished\r\n");
}

static void send_version(void) {
  static int hardware;
  hardware = 0xFFFF;
  ReadEE(0x7F, 0xFFFE, &hardware, WORD);
  /* programs look at the eleventh character, or at all of it */
  link_text(is_webots ? "v,Version 1.5.3 November 2016 (Webots)\r\n"
                      : "v,Version 1.2.2 August 2008 GCtronic\r\n");
  sprintf(buffer, "HW version: %X\r\n", hardware);
  link_text(buffer);
}

static void scan_bus(void) {
  int device, value;
  for (device = 2; device < 255; device += 2) {
    value = i2c_read(device, 0);
    if (value < 0) continue; /* absent, or a value of 128 and more */
    sprintf(buffer, "%d: %d\r\n", device, value);
    link_text(buffer);
  }
}

/* as many ones as asked for: how fast is the link? */
static void send_ones(void) {
  static int count;
  int i;
  sscanf(buffer, "X,%d", &count);
  if (count < 0) count = 0;
  if (count > BUFFER_BYTES - 5) count = BUFFER_BYTES - 5;
  strcpy(buffer, "x,");
  for (i = 0; i < count; i++) buffer[2 + i] = '1';
  strcpy(buffer + 2 + count, "\r\n");
  link_text(buffer);
}

/* what the turret's computer has for itself; 1 when the letter was one of these */
static int bluetooth_only(char letter) {
  static int device, reg, value, sound;
  switch (letter) {
    case 'G': send_remote(); return 1;
    case 'I':
      sprintf(buffer, "i,%d,%d,%d,%d,%d\r\n", camera.mode, camera.width, camera.height, camera.zoom,
              camera.size);
      link_text(buffer);
      return 1;
    case 'J': set_camera(); return 1;
    case 'M': send_ground(); return 1;
    case 'T':
      sscanf(buffer, "T,%d", &sound);
      play(sound);
      link_text("t\r\n");
      return 1;
    case 'W':
      sscanf(buffer, "W,%d,%d,%d", &device, &reg, &value);
      i2c_write(device, reg, value);
      link_text("w\r\n");
      return 1;
    case 'Y':
      sscanf(buffer, "Y,%d,%d", &device, &reg);
      sprintf(buffer, "y,%d,%d\r\n", device, reg);
      link_text(buffer);
      value = i2c_read(device, reg);
      sprintf(buffer, "y,%d\r\n", value);
      link_text(buffer);
      return 1;
    case 'Z': scan_bus(); return 1;
  }
  return 0;
}

static void obey(void) {
  static int led, action, left_steps, right_steps;
  if (!link_is_turret() && bluetooth_only(buffer[0])) return;
  switch (buffer[0]) {
    case 'A': send_acceleration(); break;
    case 'b': send_battery(); break;
    case 'B':
      sscanf(buffer, "B,%d", &action);
      if (!link_is_turret()) e_set_body_led(action);
      link_text("b\r\n");
      break;
    case 'C':
      sprintf(buffer, "c,%d\r\n", getselector());
      link_text(buffer);
      break;
    case 'D': {
      int left = speed_left, right = speed_right;
      sscanf(buffer, "D,%d,%d", &left, &right);
      set_speeds(left, right);
      link_text("d\r\n");
      break;
    }
    case 'E':
      sprintf(buffer, "e,%d,%d\r\n", speed_left, speed_right);
      link_text(buffer);
      break;
    case 'F':
      sscanf(buffer, "F,%d", &action);
      if (!link_is_turret()) e_set_front_led(action);
      link_text("f\r\n");
      break;
    case 'g': send_rotation(); break;
    case 'H': send_help(); break;
    case 'K': calibrate(); break;
    case 'L':
      sscanf(buffer, "L,%d,%d", &led, &action);
      e_set_led(led, action);
      link_text("l\r\n");
      break;
    case 'N': send_sensors('n', proximity); break;
    case 'O': send_sensors('o', light); break;
    case 'P':
      sscanf(buffer, "P,%d,%d", &left_steps, &right_steps);
      e_set_steps_left(left_steps);
      e_set_steps_right(right_steps);
      link_text("p\r\n");
      break;
    case 'Q':
      sprintf(buffer, "q,%d,%d\r\n", e_get_steps_left(), e_get_steps_right());
      link_text(buffer);
      break;
    case 'R':
      link_text("r\r\n");
      RESET();
      break;
    case 'S':
      e_set_speed_left(0); /* E goes on reporting the speeds of before */
      e_set_speed_right(0);
      e_set_led(8, 0);
      link_text("s\r\n");
      break;
    case 'T': link_text("t\r\n"); break;
    case 'U':
      sprintf(buffer, "u,%d,%d,%d\r\n", e_get_micro_volume(0), e_get_micro_volume(1), e_get_micro_volume(2));
      link_text(buffer);
      break;
    case 'V': send_version(); break;
    case 'G': case 'I': case 'J': case 'M': case 'W': case 'Y': case 'Z': break; /* the turret's: no reply */
    case 'X':
      if (is_webots) {
        send_ones();
        break;
      } /* else unknown */
    default: link_text("z,Command not found\r\n");
  }
}

void text_command(char first) {
  int length = 0;
  char c = first;
  while (c == '\r' || c == '\n') c = link_get(); /* an empty line, or the LF of CR LF */
  while (c != '\r' && c != '\n') {
    if (length < BUFFER_BYTES - 1) buffer[length++] = c; /* the rest of a longer line is dropped */
    c = link_get();
  }
  buffer[length] = '\0';
  if (buffer[0] != 'b' && buffer[0] != 'g') buffer[0] = (char)toupper((unsigned char)buffer[0]);
  obey();
}
