/* SPDX-License-Identifier: MIT
 * Pictures of the fast camera driver under the names that older versions of the library have for them.
 * Source: [lib: camera/fast_2_timer/e_po3030k.h, versions without e_poxxxx.h], facts restated.
 */
#include "camera/fast_2_timer/e_po3030k.h"

void e_po3030k_launch_capture(char *buf) { e_poxxxx_launch_capture(buf); }

int e_po3030k_is_img_ready(void) { return e_poxxxx_is_img_ready(); }

int e_po3030k_apply_timer_config(int pixel_row, int pixel_col, int bpp, int pbp, int bbl) {
  return e_poxxxx_apply_timer_config(pixel_row, pixel_col, bpp, pbp, bbl);
}
