/* SPDX-License-Identifier: MIT
 * Shapes on a picture: a shape marks the pixels that it covers, once each, and then they take its colour.
 * Edges are hard. Coordinates are pixels from the upper left corner; what lies outside is left out, however
 * far away it is.
 */
#ifndef PROGRAMS_CONTROLLER_C_DRAWING_H
#define PROGRAMS_CONTROLLER_C_DRAWING_H

#include "programs/controller/c/library.h"

/** A picture, and what is drawn on it from now on. */
struct canvas {
  struct image picture;
  unsigned char* marks;         /* a byte a pixel, all 0 between shapes */
  int left, top, right, bottom; /* where marks are, ends included */
  int colour;                   /* 0xRRGGBB */
  double alpha;                 /* 0 transparent to 1: what a pixel becomes */
  double opacity;               /* 0 leaves what is there, 1 covers it */
};

/** Black, drawn on in white. */
void canvas_make(struct canvas* canvas, int width, int height);
void draw_pixel(struct canvas* canvas, int x, int y);
void draw_line(struct canvas* canvas, int x1, int y1, int x2, int y2);
void draw_rectangle(struct canvas* canvas, int x, int y, int width, int height, bool filled);
void draw_oval(struct canvas* canvas, int cx, int cy, int a, int b, bool filled);
/** Filled by the even-odd rule, edge included. */
void draw_polygon(struct canvas* canvas, const int* x, const int* y, int size, bool filled);
/** Characters of 5 x 7 pixels times `scale`, in cells of 6 x 8; others than ASCII are boxes. */
void draw_text(struct canvas* canvas, const char* text, int x, int y, int scale);

#endif
