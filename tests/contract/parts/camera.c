/* SPDX-License-Identifier: MIT
 * Camera: what it is, and pictures in two seconds: 40 x 40 pixels of 16 bits come 4.3 times a second, an exposure of one
 * frame waits for the next. */
#include "say.h"
#include <camera/fast_2_timer/e_poxxxx.h>

static char picture[2 * 40 * 40];

int main(void) {
  int pictures = 0, half;
  begin();
  say("camera", e_poxxxx_init_cam());
  say("fits", e_poxxxx_config_cam((ARRAY_WIDTH - 320) / 2, (ARRAY_HEIGHT - 320) / 2, 320, 320, 8, 8, RGB_565_MODE));
  say("not", e_poxxxx_config_cam(ARRAY_WIDTH, 0, 320, 320, 8, 8, RGB_565_MODE));
  e_poxxxx_config_cam((ARRAY_WIDTH - 320) / 2, (ARRAY_HEIGHT - 320) / 2, 320, 320, 8, 8, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  e_poxxxx_launch_capture(picture);
  for (half = 0; half < 4; half++) {
    start_clock();
    while (TMR1 < TICKS_PER_S / 2)
      if (e_poxxxx_is_img_ready()) {
        pictures++;
        e_poxxxx_launch_capture(picture);
      }
  }
  say("pictures", pictures);
  end();
}
