/* SPDX-License-Identifier: MIT
 * Camera follow: looks for something red, faces it, and keeps its distance.
 *
 * A picture has 39 x 24 pixels, every 16th column and line of the sensor. Two numbers come out of it: the
 * middle column of the red pixels says where the object is, the widest red line how near it is. A new picture
 * is taken while the robot moves, about four times a second.
 *
 * The window begins at the sensor's first line: the PO8030D knows no other.
 */
#include <camera/fast_2_timer/e_poxxxx.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>

#define ZOOM 16
#define COLUMNS 39
#define ROWS 24
#define MIDDLE (COLUMNS / 2)

#define WANTED_WIDTH 14   /* columns: 19 cm from the lens to the middle of a ball of 6 cm */
#define FEWEST 4          /* red pixels that count as an object */
#define SEARCH_SPEED 150  /* steps/s, turning on the spot */
#define TURN_PER_COLUMN 9 /* steps/s; a column is 1.3 degrees, 4.6 steps of each wheel */
#define SPEED_PER_COLUMN 80
#define MOST_SPEED 300

char picture[COLUMNS * ROWS * 2];
int red_pixels, column, width; /* of the last picture; global, so that a debugger or a test can look */

/* Red enough: in 565, green has one bit more. */
static int is_red(const unsigned char* pixel) {
  int red = pixel[0] >> 3;
  int green = (pixel[0] & 7) << 3 | pixel[1] >> 5;
  int blue = pixel[1] & 31;
  return red > 5 && 4 * red > 3 * green && 2 * red > 3 * blue;
}

static void look(void) {
  int row, x;
  long sum = 0;
  red_pixels = 0;
  width = 0;
  for (row = 0; row < ROWS; row++) {
    int here = 0;
    for (x = 0; x < COLUMNS; x++) {
      if (!is_red((unsigned char*)picture + 2 * (row * COLUMNS + x))) continue;
      here++;
      sum += x;
    }
    red_pixels += here;
    if (here > width) width = here;
  }
  if (red_pixels > 0) column = (int)(sum / red_pixels);
}

static int limited(int speed) {
  return speed > MOST_SPEED ? MOST_SPEED : speed < -MOST_SPEED ? -MOST_SPEED : speed;
}

int main(void) {
  e_poxxxx_init_cam(); /* initialises the ports as well */
  e_poxxxx_config_cam(8, 0, COLUMNS * ZOOM, ROWS * ZOOM, ZOOM, ZOOM, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  e_start_agendas_processing();
  e_init_motors();

  for (;;) {
    int turn, forward = 0;
    e_poxxxx_launch_capture(picture);
    while (!e_poxxxx_is_img_ready())
      ;
    look();
    if (red_pixels < FEWEST) {
      /* where it was seen last */
      turn = column < MIDDLE ? SEARCH_SPEED : -SEARCH_SPEED;
    } else {
      turn = (MIDDLE - column) * TURN_PER_COLUMN;
      /* drive only when it is nearly ahead */
      if (column > MIDDLE - 9 && column < MIDDLE + 9)
        forward = limited((WANTED_WIDTH - width) * SPEED_PER_COLUMN);
    }
    e_set_body_led(red_pixels >= FEWEST);
    e_set_speed_left(forward - turn);
    e_set_speed_right(forward + turn);
  }
}
