/* SPDX-License-Identifier: MIT
 * A small screen that no e-puck has: a picture of the program's own, which it may draw and write to a file. Nobody
 * sees it while the program runs. The device is a [[robot.device]] of kind "display" (docs/webots.md). Programs of
 * the PC only.
 */
#ifndef WB_DISPLAY_H
#define WB_DISPLAY_H

#include "types.h"

TP_C_BEGIN

#define WB_IMAGE_RGB 3
#define WB_IMAGE_RGBA 4
#define WB_IMAGE_ARGB 5
#define WB_IMAGE_BGRA 6
#define WB_IMAGE_ABGR 7
#define WB_DISPLAY_RGB 3
#define WB_DISPLAY_RGBA 4
#define WB_DISPLAY_ARGB 5
#define WB_DISPLAY_BGRA 6
#define WB_DISPLAY_ABGR 7

int wb_display_get_width(WbDeviceTag tag);
int wb_display_get_height(WbDeviceTag tag);

/** Of what is drawn from now on: 0xRRGGBB, white at the start; 0 transparent to 1; 0 leaves what is there. */
void wb_display_set_color(WbDeviceTag tag, long color);
void wb_display_set_alpha(WbDeviceTag tag, double alpha);
void wb_display_set_opacity(WbDeviceTag tag, double opacity);
/** Pixels are always hard-edged; text has one font, of 5 x 7 pixels, and `size` / 8 (whole, at least 1) times that. */
void wb_display_set_antialiasing(WbDeviceTag tag, bool on);
void wb_display_set_font(WbDeviceTag tag, const char* font, int size, bool antialiasing);

/** From the upper left corner, in pixels. What lies outside is not drawn. */
void wb_display_draw_pixel(WbDeviceTag tag, int x, int y);
void wb_display_draw_line(WbDeviceTag tag, int x1, int y1, int x2, int y2);
void wb_display_draw_rectangle(WbDeviceTag tag, int x, int y, int width, int height);
void wb_display_draw_oval(WbDeviceTag tag, int cx, int cy, int a, int b);
void wb_display_draw_polygon(WbDeviceTag tag, const int* x, const int* y, int size);
void wb_display_draw_text(WbDeviceTag tag, const char* text, int x, int y);
void wb_display_fill_rectangle(WbDeviceTag tag, int x, int y, int width, int height);
void wb_display_fill_oval(WbDeviceTag tag, int cx, int cy, int a, int b);
void wb_display_fill_polygon(WbDeviceTag tag, const int* x, const int* y, int size);

/** Pictures: pixels given, cut out of the display, put back, written to a file, PNG or, by its ending, JPEG. NULL is
 *  the display itself. Relative names begin in the program's folder. */
WbImageRef wb_display_image_new(WbDeviceTag tag, int width, int height, const void* data, int format);
WbImageRef wb_display_image_copy(WbDeviceTag tag, int x, int y, int width, int height);
void wb_display_image_paste(WbDeviceTag tag, WbImageRef image, int x, int y, bool blend);
void wb_display_image_save(WbDeviceTag tag, WbImageRef image, const char* filename);
void wb_display_image_delete(WbDeviceTag tag, WbImageRef image);
/** From a PNG or JPEG, at most 4096 pixels a side; NULL and a warning: it cannot be read. */
WbImageRef wb_display_image_load(WbDeviceTag tag, const char* filename);
/** The camera's pictures do not appear on displays: a warning. */
void wb_display_attach_camera(WbDeviceTag tag, WbDeviceTag camera);
void wb_display_detach_camera(WbDeviceTag tag);

TP_C_END

#endif
