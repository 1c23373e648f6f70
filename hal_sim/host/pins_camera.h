/* SPDX-License-Identifier: MIT
 * What the API may ask of the camera's data pins and its two sync lines. Registers go over the bus
 * (pins_i2c.h), the reset pin is a latch bit (pins.h). Cycles and conventions as in pins.h. Nothing here
 * blocks.
 */
#ifndef TWINPUCK_HOST_PINS_CAMERA_H
#define TWINPUCK_HOST_PINS_CAMERA_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** A driver wants `rows` lines of `columns` pixels of `bytes_per_pixel`, leaving out `skipped_pixels` between
 * pixels and `skipped_lines` between lines. in_step 0: it takes a byte every 8 cycles (fast driver); 1: one
 * per pixel clock. Answers the cycle of the next VSYNC, or -1 when there is no camera. A request before it is
 * forgotten. Write. */
tp_i64 tp_camera_launch(tp_i64 rows, tp_i64 columns, tp_i64 bytes_per_pixel, tp_i64 skipped_pixels,
                        tp_i64 skipped_lines, tp_i64 in_step);
/** VSYNC has come. Answers the cycle of the first line's HREF. Write. */
tp_i64 tp_camera_begin_frame(void);
/** The line whose HREF has come: puts at most `room` bytes to `to`; answers how many there are. Write. */
tp_i64 tp_camera_take_line(void* to, tp_i64 room);
/** HREF of the next line that is wanted. */
tp_i64 tp_camera_next_line(void);

#ifdef __cplusplus
}
#endif
#endif
