/* SPDX-License-Identifier: MIT
 * Camera, slow variant: what it has beyond the settings that it shares with the fast one.
 */
#include "camera/slow_3_timer/e_po3030k.h"
#include "unsimulated.h"
#define DEVICE "camera"

UNSIMULATED_VOID(e_po3030k_launch_capture, (char *buf))
UNSIMULATED_VOID(e_po3030k_apply_timer_config, (int pixel_row, int pixel_col, int bpp, int pbp, int bbl))
UNSIMULATED(int, e_po3030k_is_img_ready, (void))
