/* SPDX-License-Identifier: MIT
 * Displays: shapes become lists of points, which the simulator draws. Empty on the robot.
 */
#ifdef __TWINPUCK_PC__
#include "webots/display.h"

#include <math.h>

#include "core.h"

#define OVAL_POINTS 49

static int alpha = 100, opacity = 100; /* percent */

/* number of the display, -1 for none */
static int display(WbDeviceTag tag, const char* function) {
  const struct webots_device* d = webots_device_of(tag, WB_NODE_DISPLAY, function);
  return d ? d->index : -1;
}

static void shape(WbDeviceTag tag, const char* function, int filled, const int* x, const int* y, int points) {
  int d = display(tag, function);
  if (d >= 0) twin_display_shape(d, filled, x, y, points);
}

static void rectangle(WbDeviceTag tag, const char* function, int filled, int x, int y, int width, int height) {
  int xs[5], ys[5];
  if (width <= 0 || height <= 0) return;
  xs[0] = xs[3] = xs[4] = x, xs[1] = xs[2] = x + width - 1;
  ys[0] = ys[1] = ys[4] = y, ys[2] = ys[3] = y + height - 1;
  shape(tag, function, filled, xs, ys, filled ? 4 : 5);
}

static void oval(WbDeviceTag tag, const char* function, int filled, int cx, int cy, int a, int b) {
  int xs[OVAL_POINTS], ys[OVAL_POINTS], i;
  for (i = 0; i < OVAL_POINTS; i++) {
    float angle = 2 * WEBOTS_PI * i / (OVAL_POINTS - 1);
    xs[i] = cx + (int)floorf(a * cosf(angle) + 0.5f);
    ys[i] = cy + (int)floorf(b * sinf(angle) + 0.5f);
  }
  shape(tag, function, filled, xs, ys, OVAL_POINTS);
}

int wb_display_get_width(WbDeviceTag tag) { return twin_display_width(display(tag, "wb_display_get_width")); }
int wb_display_get_height(WbDeviceTag tag) {
  return twin_display_height(display(tag, "wb_display_get_height"));
}
void wb_display_set_color(WbDeviceTag tag, long color) {
  twin_display_colour(display(tag, "wb_display_set_color"), color);
}
void wb_display_set_alpha(WbDeviceTag tag, double value) {
  alpha = (int)(value * 100);
  twin_display_solid(display(tag, "wb_display_set_alpha"), alpha, opacity);
}
void wb_display_set_opacity(WbDeviceTag tag, double value) {
  opacity = (int)(value * 100);
  twin_display_solid(display(tag, "wb_display_set_opacity"), alpha, opacity);
}
void wb_display_set_antialiasing(WbDeviceTag tag, bool on) { (void)tag, (void)on; }
void wb_display_set_font(WbDeviceTag tag, const char* font, int size, bool antialiasing) {
  (void)tag, (void)font, (void)size, (void)antialiasing;
}

void wb_display_draw_pixel(WbDeviceTag tag, int x, int y) { shape(tag, "wb_display_draw_pixel", 0, &x, &y, 1); }
void wb_display_draw_line(WbDeviceTag tag, int x1, int y1, int x2, int y2) {
  int xs[2], ys[2];
  xs[0] = x1, xs[1] = x2, ys[0] = y1, ys[1] = y2;
  shape(tag, "wb_display_draw_line", 0, xs, ys, 2);
}
void wb_display_draw_rectangle(WbDeviceTag tag, int x, int y, int width, int height) {
  rectangle(tag, "wb_display_draw_rectangle", 0, x, y, width, height);
}
void wb_display_fill_rectangle(WbDeviceTag tag, int x, int y, int width, int height) {
  rectangle(tag, "wb_display_fill_rectangle", 1, x, y, width, height);
}
void wb_display_draw_oval(WbDeviceTag tag, int cx, int cy, int a, int b) {
  oval(tag, "wb_display_draw_oval", 0, cx, cy, a, b);
}
void wb_display_fill_oval(WbDeviceTag tag, int cx, int cy, int a, int b) {
  oval(tag, "wb_display_fill_oval", 1, cx, cy, a, b);
}
void wb_display_draw_polygon(WbDeviceTag tag, const int* x, const int* y, int size) {
  if (size < 1) return;
  shape(tag, "wb_display_draw_polygon", 0, x, y, size);
  wb_display_draw_line(tag, x[size - 1], y[size - 1], x[0], y[0]);
}
void wb_display_fill_polygon(WbDeviceTag tag, const int* x, const int* y, int size) {
  shape(tag, "wb_display_fill_polygon", 1, x, y, size);
}
void wb_display_draw_text(WbDeviceTag tag, const char* text, int x, int y) {
  static unsigned char told;
  (void)tag, (void)text, (void)x, (void)y;
  if (!told++) webots_warn("wb_display_draw_text", "got a text, expected shapes and pixels; text is not drawn");
  if (!told) told = 1;
}

/* an image is its number, as an address that nobody follows */
static WbImageRef image_of(int number) { return (WbImageRef)(__INTPTR_TYPE__)number; }
static int number_of(WbImageRef image) { return (int)(__INTPTR_TYPE__)image; }

WbImageRef wb_display_image_new(WbDeviceTag tag, int width, int height, const void* data, int format) {
  return image_of(twin_display_make(display(tag, "wb_display_image_new"), width, height, data, format));
}
WbImageRef wb_display_image_copy(WbDeviceTag tag, int x, int y, int width, int height) {
  return image_of(twin_display_copy(display(tag, "wb_display_image_copy"), x, y, width, height));
}
void wb_display_image_paste(WbDeviceTag tag, WbImageRef image, int x, int y, bool blend) {
  twin_display_paste(display(tag, "wb_display_image_paste"), number_of(image), x, y, blend);
}
void wb_display_image_delete(WbDeviceTag tag, WbImageRef image) {
  twin_display_remove(display(tag, "wb_display_image_delete"), number_of(image));
}
void wb_display_image_save(WbDeviceTag tag, WbImageRef image, const char* filename) {
  if (!twin_display_save(display(tag, "wb_display_image_save"), number_of(image), filename))
    webots_warn("wb_display_image_save", "got a picture that cannot be written, expected a name in the robot's folder");
}
WbImageRef wb_display_image_load(WbDeviceTag tag, const char* filename) {
  (void)tag, (void)filename;
  webots_warn("wb_display_image_load", "got a file, expected a picture of the program's own; files are not read");
  return 0;
}
void wb_display_attach_camera(WbDeviceTag tag, WbDeviceTag camera) {
  (void)tag, (void)camera;
  webots_warn("wb_display_attach_camera", "got a camera, expected pixels; cameras do not appear on displays");
}
void wb_display_detach_camera(WbDeviceTag tag) { (void)tag; }
#endif
