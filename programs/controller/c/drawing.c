/* SPDX-License-Identifier: MIT
 */
#include "programs/controller/c/drawing.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/font.h"

#define FAR 8192 /* pixels beyond the picture, from where lines are cut */

/* --- marks */

/* columns of a row, which are in the picture */
static void mark_seen(struct canvas* c, int y, int from, int to) {
  memset(c->marks + (size_t)y * (size_t)c->picture.width + from, 1, (size_t)(to - from + 1));
  if (from < c->left) c->left = from;
  if (to > c->right) c->right = to;
  if (y < c->top) c->top = y;
  if (y > c->bottom) c->bottom = y;
}

static void mark(struct canvas* c, int x, int y) {
  if (x >= 0 && y >= 0 && x < c->picture.width && y < c->picture.height) mark_seen(c, y, x, x);
}

/* columns of a row, both ends included */
static void mark_row(struct canvas* c, int y, double left, double right) {
  int from, to;
  if (y < 0 || y >= c->picture.height || !(right >= 0) || !(left < c->picture.width)) return;
  from = left < 0 ? 0 : (int)left;
  to = right >= c->picture.width ? c->picture.width - 1 : (int)right;
  if (to >= from) mark_seen(c, y, from, to);
}

static void no_marks(struct canvas* c) {
  c->left = c->top = INT_MAX;
  c->right = c->bottom = -1;
}

void canvas_make(struct canvas* canvas, int width, int height) {
  size_t pixels = (size_t)width * (size_t)height, i;
  canvas->picture.width = width;
  canvas->picture.height = height;
  canvas->picture.bgra = memset(grow(0, 4 * pixels), 0, 4 * pixels);
  for (i = 0; i < pixels; i++) canvas->picture.bgra[4 * i + 3] = 255;
  canvas->marks = memset(grow(0, pixels), 0, pixels);
  no_marks(canvas);
  canvas->colour = 0xFFFFFF;
  canvas->alpha = canvas->opacity = 1;
}

/* marked pixels take the colour; the marks are gone then */
static void paint(struct canvas* c) {
  double wanted[4] = {c->colour & 0xFF, c->colour >> 8 & 0xFF, c->colour >> 16 & 0xFF, 255 * c->alpha};
  int x, y, k;
  for (y = c->top; y <= c->bottom; y++)
    for (x = c->left; x <= c->right; x++) {
      size_t i = (size_t)y * (size_t)c->picture.width + (size_t)x;
      unsigned char* pixel = c->picture.bgra + 4 * i;
      if (!c->marks[i]) continue;
      for (k = 0; k < 4; k++) pixel[k] = (unsigned char)(pixel[k] + (wanted[k] - pixel[k]) * c->opacity + 0.5);
      c->marks[i] = 0;
    }
  no_marks(c);
}

/* Of a line that leaves the picture far, the part between t0 and t1 (0 to 1) that may be seen; false: none. */
static bool cut(double from, double to, double most, double* t0, double* t1) {
  double d = to - from, a, b;
  if (d == 0) return from >= -FAR && from <= most + FAR;
  a = (-FAR - from) / d;
  b = (most + FAR - from) / d;
  if (a > b) {
    double swap = a;
    a = b;
    b = swap;
  }
  if (a > *t0) *t0 = a;
  if (b < *t1) *t1 = b;
  return *t0 <= *t1;
}

/* Bresenham's line */
static void mark_line(struct canvas* c, double fx, double fy, double tx, double ty) {
  double t0 = 0, t1 = 1;
  long x, y, x1, y1, dx, dy, sx, sy, error;
  if (!cut(fx, tx, c->picture.width, &t0, &t1) || !cut(fy, ty, c->picture.height, &t0, &t1)) return;
  x = lround(fx + t0 * (tx - fx)), y = lround(fy + t0 * (ty - fy));
  x1 = lround(fx + t1 * (tx - fx)), y1 = lround(fy + t1 * (ty - fy));
  dx = labs(x1 - x), dy = -labs(y1 - y);
  sx = x < x1 ? 1 : -1, sy = y < y1 ? 1 : -1;
  error = dx + dy;
  for (;;) {
    long twice = 2 * error;
    mark(c, (int)x, (int)y);
    if (x == x1 && y == y1) return;
    if (twice >= dy) error += dy, x += sx;
    if (twice <= dx) error += dx, y += sy;
  }
}

/* --- shapes */

void draw_pixel(struct canvas* c, int x, int y) {
  mark(c, x, y);
  paint(c);
}

void draw_line(struct canvas* c, int x1, int y1, int x2, int y2) {
  mark_line(c, x1, y1, x2, y2);
  paint(c);
}

void draw_rectangle(struct canvas* c, int x, int y, int width, int height, bool filled) {
  double right = (double)x + width - 1, bottom = (double)y + height - 1;
  int row;
  if (width < 1 || height < 1) return;
  for (row = 0; row < c->picture.height; row++) {
    if (row < y || row > bottom) continue;
    if (filled || row == y || row == bottom) {
      mark_row(c, row, x, right);
    } else {
      mark_row(c, row, x, x);
      mark_row(c, row, right, right);
    }
  }
  paint(c);
}

/* half the width of an oval at a distance from its middle; below 0: it is beyond */
static double half_width(double at, double a, double b) {
  double rest = 1 - (at / b) * (at / b);
  return rest < 0 ? -1 : floor(a * sqrt(rest) + 0.5);
}

void draw_oval(struct canvas* c, int cx, int cy, int a, int b, bool filled) {
  int x, y;
  if (a < 0 || b < 0) return;
  for (y = 0; y < c->picture.height; y++) {
    double half = b == 0 ? (y == cy ? a : -1) : half_width((double)y - cy, a, b);
    if (half < 0) continue;
    if (filled) {
      mark_row(c, y, cx - half, cx + half);
    } else {
      mark_row(c, y, cx - half, cx - half);
      mark_row(c, y, cx + half, cx + half);
    }
  }
  /* flat parts have more than one pixel a row */
  for (x = 0; !filled && x < c->picture.width; x++) {
    double half = a == 0 ? (x == cx ? b : -1) : half_width((double)x - cx, b, a);
    if (half < 0) continue;
    mark_row(c, (int)fmin(fmax(cy - half, -1), c->picture.height), x, x);
    mark_row(c, (int)fmin(fmax(cy + half, -1), c->picture.height), x, x);
  }
  paint(c);
}

static int by_size(const void* left, const void* right) {
  double a = *(const double*)left, b = *(const double*)right;
  return (a > b) - (a < b);
}

/* between each two crossings of a row with the edges */
static void mark_inside(struct canvas* c, const int* x, const int* y, int size) {
  double* crossings = grow(0, (size_t)size * sizeof *crossings);
  int row, i, count;
  for (row = 0; row < c->picture.height; row++) {
    count = 0;
    for (i = 0; i < size; i++) {
      int j = (i + 1) % size;
      if ((y[i] <= row) == (y[j] <= row)) continue;
      crossings[count++] = x[i] + ((double)row - y[i]) * ((double)x[j] - x[i]) / ((double)y[j] - y[i]);
    }
    qsort(crossings, (size_t)count, sizeof *crossings, by_size);
    for (i = 0; i + 1 < count; i += 2) mark_row(c, row, ceil(crossings[i] - 0.5), floor(crossings[i + 1] + 0.5));
  }
  free(crossings);
}

void draw_polygon(struct canvas* c, const int* x, const int* y, int size, bool filled) {
  int i;
  if (!x || !y || size < 1) return;
  if (filled) mark_inside(c, x, y, size);
  for (i = 0; i < size; i++) mark_line(c, x[i], y[i], x[(i + 1) % size], y[(i + 1) % size]);
  paint(c);
}

static void mark_character(struct canvas* c, unsigned char character, long x, long y, int scale) {
  static const unsigned char kBox[FONT_ROWS] = {0x1F, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1F};
  const unsigned char* rows = character < FONT_FIRST || character > FONT_LAST ? kBox : kFont[character - FONT_FIRST];
  int row, column, i;
  for (row = 0; row < FONT_ROWS; row++)
    for (column = 0; column < FONT_COLUMNS; column++)
      for (i = 0; (rows[row] >> (FONT_COLUMNS - 1 - column) & 1) && i < scale; i++)
        mark_row(c, (int)(y + row * scale + i), (double)x + column * scale, (double)x + column * scale + scale - 1);
}

void draw_text(struct canvas* c, const char* text, int x, int y, int scale) {
  long at_x = x, at_y = y;
  for (; *text && at_y < c->picture.height; text++) {
    unsigned char character = (unsigned char)*text;
    if (character == '\n') {
      at_x = x;
      at_y += (FONT_ROWS + 1) * scale;
      continue;
    }
    if ((character & 0xC0) == 0x80) continue; /* the rest of a character of UTF-8, which is one box */
    if (at_x < c->picture.width && at_y > -FAR) mark_character(c, character, at_x, at_y, scale);
    at_x += (FONT_COLUMNS + 1) * scale;
  }
  paint(c);
}
