// SPDX-License-Identifier: MIT
// cairo, with the twenty libraries behind it, is loaded when something is drawn.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(cairo, cairo_arc) X(cairo, cairo_clip) X(cairo, cairo_close_path) X(cairo, cairo_create) \
  X(cairo, cairo_destroy) X(cairo, cairo_fill) X(cairo, cairo_fill_preserve) \
  X(cairo, cairo_image_surface_create) X(cairo, cairo_image_surface_create_from_png_stream) \
  X(cairo, cairo_image_surface_get_data) X(cairo, cairo_image_surface_get_height) \
  X(cairo, cairo_image_surface_get_stride) X(cairo, cairo_image_surface_get_width) \
  X(cairo, cairo_line_to) X(cairo, cairo_move_to) X(cairo, cairo_new_path) X(cairo, cairo_paint) \
  X(cairo, cairo_pattern_add_color_stop_rgb) X(cairo, cairo_pattern_create_linear) \
  X(cairo, cairo_pattern_destroy) X(cairo, cairo_rectangle) X(cairo, cairo_rel_line_to) \
  X(cairo, cairo_restore) X(cairo, cairo_save) X(cairo, cairo_scale) \
  X(cairo, cairo_select_font_face) X(cairo, cairo_set_antialias) X(cairo, cairo_set_dash) \
  X(cairo, cairo_set_font_size) X(cairo, cairo_set_line_cap) X(cairo, cairo_set_line_join) \
  X(cairo, cairo_set_line_width) X(cairo, cairo_set_source) X(cairo, cairo_set_source_rgb) \
  X(cairo, cairo_set_source_rgba) X(cairo, cairo_set_source_surface) X(cairo, cairo_show_text) \
  X(cairo, cairo_status) X(cairo, cairo_status_to_string) X(cairo, cairo_stroke) \
  X(cairo, cairo_stroke_preserve) X(cairo, cairo_surface_destroy) X(cairo, cairo_surface_finish) \
  X(cairo, cairo_surface_flush) X(cairo, cairo_surface_mark_dirty) X(cairo, cairo_surface_status) \
  X(cairo, cairo_surface_write_to_png_stream) X(cairo, cairo_svg_surface_create_for_stream) \
  X(cairo, cairo_text_extents) X(cairo, cairo_text_path) X(cairo, cairo_translate)
// clang-format on

LAZY_LIBRARY(cairo, "libcairo.so.2", CALLS)
