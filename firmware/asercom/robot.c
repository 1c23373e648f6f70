/* SPDX-License-Identifier: MIT
 * See robot.h.
 */
#include "robot.h"

#include <I2C/e_I2C_protocol.h>
#include <camera/fast_2_timer/e_poxxxx.h>
#include <codec/e_sound.h>
#include <motor_led/advance_one_timer/e_motors.h>

#define GROUND_BOARD 0xC0
#define GROUND_WORDS 3  /* registers 0 to 5, high byte first */
#define CLIFF_REGISTER 13
#define CLIFF_WORDS 2   /* registers 13 to 16, high byte first */

char buffer[BUFFER_BYTES + IMAGE_HEADER];
char is_webots;
int speed_left, speed_right;
struct camera camera;

static char is_capturing;
static char has_sound;

void set_speeds(int left, int right) {
  speed_left = left;
  speed_right = right;
  e_set_speed_left(left);
  e_set_speed_right(right);
}

void play(int sound) {
  static const int offset[5] = {0, 2116, 3878, 7294, 11028};
  static const int length[5] = {2112, 1760, 3412, 3732, 8016};
  if (!has_sound) e_init_sound();
  has_sound = sound >= 1 && sound <= 5;
  if (has_sound) {
    e_play_sound(offset[sound - 1], length[sound - 1]);
  } else {
    e_close_sound();
  }
}

static int start_camera(int x1, int y1) {
  int width = camera.width * camera.zoom, height = camera.height * camera.zoom;
  e_poxxxx_init_cam();
  if (x1 == -1) x1 = (ARRAY_WIDTH - width) / 2;
  if (y1 == -1) y1 = (ARRAY_HEIGHT - height) / 2;
  if (e_poxxxx_config_cam(x1, y1, width, height, camera.zoom, camera.zoom, camera.mode) != 0) return 0;
  e_poxxxx_write_cam_registers();
  return 1;
}

static void small_colour_picture(void) {
  camera.mode = RGB_565_MODE;
  camera.width = camera.height = 40;
}

void camera_default(void) {
  small_colour_picture();
  camera.zoom = 8;
  camera.size = 2 * camera.width * camera.height;
  start_camera(-1, -1);
}

/* 1 when 0 < value <= most: also keeps the products below inside 16 bits */
static int in_range(int value, int most) { return value > 0 && value <= most; }

void camera_set(int x1, int y1) {
  long size = (long)camera.width * camera.height;
  camera_finish();
  if (camera.mode != GREY_SCALE_MODE) size *= 2;
  if (!in_range(camera.width, ARRAY_WIDTH) || !in_range(camera.height, ARRAY_HEIGHT) ||
      size > (is_webots ? WEBOTS_IMAGE_BYTES : IMAGE_BYTES)) {
    small_colour_picture();
    size = 2 * camera.width * camera.height;
  }
  camera.size = (int)size;
  /* windows that the sensor does not have would also leave 16 bits */
  if (camera.mode < GREY_SCALE_MODE || camera.mode > YUV_MODE ||
      !in_range(camera.zoom, ARRAY_WIDTH / camera.width) ||
      !in_range(camera.zoom, ARRAY_HEIGHT / camera.height) ||
      !start_camera(x1, y1))
    camera_default();
}

void camera_capture(char *to) {
  camera_finish();
  e_poxxxx_launch_capture(to);
  is_capturing = 1;
}

void camera_finish(void) {
  if (!is_capturing) return;
  is_capturing = 0;
  while (!e_poxxxx_is_img_ready());
}

int i2c_read(int device, int reg) {
  int value;
  e_i2cp_enable();
  value = e_i2cp_read((char)device, (char)reg); /* a signed char */
  e_i2cp_disable();
  return value;
}

void i2c_write(int device, int reg, int value) {
  e_i2cp_enable();
  e_i2cp_write((char)device, (char)reg, (char)value);
  e_i2cp_disable();
}

static void read_words(int reg, int *words, int count) {
  int i;
  for (i = 0; i < count; i++) {
    unsigned int high = e_i2cp_read((char)GROUND_BOARD, (char)(reg + 2 * i)) & 0xFF;
    words[i] = (int)(high << 8 | (e_i2cp_read((char)GROUND_BOARD, (char)(reg + 2 * i + 1)) & 0xFF));
  }
}

int read_ground(int values[5]) {
  e_i2cp_enable();
  read_words(0, values, GROUND_WORDS);
  if (!is_webots) read_words(CLIFF_REGISTER, values + GROUND_WORDS, CLIFF_WORDS);
  e_i2cp_disable();
  return is_webots ? GROUND_WORDS : GROUND_WORDS + CLIFF_WORDS;
}
