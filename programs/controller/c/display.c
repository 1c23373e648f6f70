/* SPDX-License-Identifier: MIT
 * Displays: pictures of the program's own, which nobody sees during the run and image_save() writes.
 */
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/drawing.h"

#define MOST_SIDE 4096 /* pixels */
#define SIZE_OF_ONE 8  /* of a font whose pixels are one of the display's */

/* numbers of DEVICE */
enum { DISPLAY_COLUMNS, DISPLAY_ROWS };

struct display {
  struct canvas canvas;
  int scale; /* of the font */
};

struct WbImageStructPrivate {
  struct image picture;
};

static struct display* display(WbDeviceTag tag, const char* function) {
  struct device* d = device_of(tag, WB_NODE_DISPLAY, function);
  struct display* state = d ? d->own : 0;
  int width, height;
  if (!d || state) return state;
  width = (int)device_info(d, DISPLAY_COLUMNS, 64);
  height = (int)device_info(d, DISPLAY_ROWS, 64);
  if (width < 1 || width > MOST_SIDE || height < 1 || height > MOST_SIDE) width = height = 1;
  d->own = state = grow(0, sizeof *state);
  canvas_make(&state->canvas, width, height);
  state->scale = 1;
  return state;
}

int wb_display_get_width(WbDeviceTag tag) {
  const struct display* d = display(tag, "wb_display_get_width");
  return d ? d->canvas.picture.width : -1;
}
int wb_display_get_height(WbDeviceTag tag) {
  const struct display* d = display(tag, "wb_display_get_height");
  return d ? d->canvas.picture.height : -1;
}

/* --- how */

void wb_display_set_color(WbDeviceTag tag, long color) {
  struct display* d = display(tag, "wb_display_set_color");
  if (d) d->canvas.colour = (int)(color & 0xFFFFFF);
}
static void set_part(WbDeviceTag tag, double value, bool is_alpha, const char* function) {
  struct display* d = display(tag, function);
  if (!d) return;
  if (!(value >= 0 && value <= 1))
    WARN("%s(): got %g, expected 0 to 1", function, value);
  else if (is_alpha)
    d->canvas.alpha = value;
  else
    d->canvas.opacity = value;
}
void wb_display_set_alpha(WbDeviceTag tag, double alpha) { set_part(tag, alpha, true, "wb_display_set_alpha"); }
void wb_display_set_opacity(WbDeviceTag tag, double opacity) { set_part(tag, opacity, false, "wb_display_set_opacity"); }
void wb_display_set_antialiasing(WbDeviceTag tag, bool on) { (void)on, (void)display(tag, "wb_display_set_antialiasing"); }
void wb_display_set_font(WbDeviceTag tag, const char* font, int size, bool antialiasing) {
  struct display* d = display(tag, "wb_display_set_font");
  (void)font, (void)antialiasing;
  if (d) d->scale = size < 2 * SIZE_OF_ONE ? 1 : size > MOST_SIDE ? MOST_SIDE / SIZE_OF_ONE : size / SIZE_OF_ONE;
}

/* --- shapes */

#define SHAPE(name, draw, ...)                          \
  void wb_display_##name(WbDeviceTag tag, __VA_ARGS__) { \
    struct display* d = display(tag, "wb_display_" #name); \
    if (d) draw;                                        \
  }
SHAPE(draw_pixel, draw_pixel(&d->canvas, x, y), int x, int y)
SHAPE(draw_line, draw_line(&d->canvas, x1, y1, x2, y2), int x1, int y1, int x2, int y2)
SHAPE(draw_rectangle, draw_rectangle(&d->canvas, x, y, width, height, false), int x, int y, int width, int height)
SHAPE(fill_rectangle, draw_rectangle(&d->canvas, x, y, width, height, true), int x, int y, int width, int height)
SHAPE(draw_oval, draw_oval(&d->canvas, cx, cy, a, b, false), int cx, int cy, int a, int b)
SHAPE(fill_oval, draw_oval(&d->canvas, cx, cy, a, b, true), int cx, int cy, int a, int b)
SHAPE(draw_polygon, draw_polygon(&d->canvas, x, y, size, false), const int* x, const int* y, int size)
SHAPE(fill_polygon, draw_polygon(&d->canvas, x, y, size, true), const int* x, const int* y, int size)

void wb_display_draw_text(WbDeviceTag tag, const char* text, int x, int y) {
  struct display* d = display(tag, "wb_display_draw_text");
  if (d && text) draw_text(&d->canvas, text, x, y, d->scale);
}

/* --- pictures */

/* black and transparent; null, after a warning: no such size */
static WbImageRef make(int width, int height, const char* function) {
  WbImageRef image;
  size_t bytes = 4 * (size_t)width * (size_t)height;
  if (width < 1 || width > MOST_SIDE || height < 1 || height > MOST_SIDE) {
    WARN("%s(): got %d x %d pixels, expected 1 to %d of each", function, width, height, MOST_SIDE);
    return 0;
  }
  image = grow(0, sizeof *image);
  image->picture.width = width;
  image->picture.height = height;
  image->picture.bgra = memset(grow(0, bytes), 0, bytes);
  return image;
}

WbImageRef wb_display_image_new(WbDeviceTag tag, int width, int height, const void* data, int format) {
  /* where blue, green, red and alpha are in a pixel; -1: it has none */
  static const int kOrder[][4] = {{2, 1, 0, -1}, {2, 1, 0, 3}, {3, 2, 1, 0}, {0, 1, 2, 3}, {1, 2, 3, 0}};
  const unsigned char* from = data;
  const int* order;
  WbImageRef image;
  size_t i, pixels = (size_t)width * (size_t)height, step;
  int k;
  if (!display(tag, "wb_display_image_new")) return 0;
  if (!data || format < WB_IMAGE_RGB || format > WB_IMAGE_ABGR) {
    WARN("wb_display_image_new(): got %s and format %d, expected pixels and a format of %d to %d", data ? "pixels" : "NULL",
         format, WB_IMAGE_RGB, WB_IMAGE_ABGR);
    return 0;
  }
  image = make(width, height, "wb_display_image_new");
  if (!image) return 0;
  order = kOrder[format - WB_IMAGE_RGB];
  step = order[3] < 0 ? 3 : 4;
  for (i = 0; i < pixels; i++)
    for (k = 0; k < 4; k++) image->picture.bgra[4 * i + (size_t)k] = order[k] < 0 ? 255 : from[step * i + (size_t)order[k]];
  return image;
}

/* The pixels of `from` on those of `to`; blended by their alpha, or in their place. */
static void lay(const struct image* from, const struct image* to, int x, int y, bool blend) {
  int row, column, k;
  for (row = 0; row < from->height; row++)
    for (column = 0; column < from->width; column++) {
      long to_x = (long)x + column, to_y = (long)y + row;
      const unsigned char* above = from->bgra + 4 * ((size_t)row * (size_t)from->width + (size_t)column);
      unsigned char* below;
      int alpha = above[3];
      if (to_x < 0 || to_x >= to->width || to_y < 0 || to_y >= to->height) continue;
      below = to->bgra + 4 * ((size_t)to_y * (size_t)to->width + (size_t)to_x);
      if (!blend) {
        memcpy(below, above, 4);
        continue;
      }
      for (k = 0; k < 3; k++) below[k] = (unsigned char)((above[k] * alpha + below[k] * (255 - alpha) + 127) / 255);
      if (alpha > below[3]) below[3] = (unsigned char)alpha;
    }
}

WbImageRef wb_display_image_copy(WbDeviceTag tag, int x, int y, int width, int height) {
  struct display* d = display(tag, "wb_display_image_copy");
  WbImageRef image = d ? make(width, height, "wb_display_image_copy") : 0;
  if (image && x > -MOST_SIDE && y > -MOST_SIDE && x < MOST_SIDE && y < MOST_SIDE)
    lay(&d->canvas.picture, &image->picture, -x, -y, false);
  return image;
}

WbImageRef wb_display_image_load(WbDeviceTag tag, const char* filename) {
  struct image picture;
  WbImageRef image;
  if (!display(tag, "wb_display_image_load") || !image_read(&picture, filename, "wb_display_image_load")) return 0;
  image = grow(0, sizeof *image);
  image->picture = picture;
  return image;
}

void wb_display_image_paste(WbDeviceTag tag, WbImageRef image, int x, int y, bool blend) {
  struct display* d = display(tag, "wb_display_image_paste");
  if (d && !image) WARN("wb_display_image_paste(): got NULL, expected an image");
  if (d && image) lay(&image->picture, &d->canvas.picture, x, y, blend);
}

void wb_display_image_save(WbDeviceTag tag, WbImageRef image, const char* filename) {
  struct display* d = display(tag, "wb_display_image_save");
  if (d) image_write(image ? &image->picture : &d->canvas.picture, filename, 90, true, "wb_display_image_save");
}

void wb_display_image_delete(WbDeviceTag tag, WbImageRef image) {
  if (!display(tag, "wb_display_image_delete") || !image) return;
  free(image->picture.bgra);
  free(image);
}

void wb_display_attach_camera(WbDeviceTag tag, WbDeviceTag camera) {
  if (display(tag, "wb_display_attach_camera") && device_of(camera, WB_NODE_CAMERA, "wb_display_attach_camera"))
    WARN("wb_display_attach_camera(): cameras do not appear on displays; paste wb_camera_get_image()");
}
void wb_display_detach_camera(WbDeviceTag tag) { (void)display(tag, "wb_display_detach_camera"); }
