// SPDX-License-Identifier: MIT
// What a map lies on: floor with its picture and grid, ramps.
#include <algorithm>
#include <cmath>

#include "sim_core/record/map_painter.h"

namespace sim {

void MapPainter::floor() {
  const WorldDesc& world = scene_.world();
  Vec2 low = place_.low_m, high = place_.high_m;
  if (world.arena) {
    low = world.arena->centre_m - 0.5 * world.arena->size_m;
    high = world.arena->centre_m + 0.5 * world.arena->size_m;
  }
  cairo_rectangle(cr_, low.x, low.y, high.x - low.x, high.y - low.y);
  ink(world.floor.colour);
  cairo_fill(cr_);
  if (!world.floor.image_rgb.empty() && world.arena) floor_image(low, high);
  // a line every 0.1 m up to 3 m, every metre beyond
  const double span = std::max(high.x - low.x, high.y - low.y);
  const double step = span <= 3 ? 0.1 : 1;
  cairo_set_source_rgba(cr_, 0, 0, 0, 0.06);
  pen(1);
  for (double x = std::ceil(low.x / step) * step; x <= high.x; x += step) line({x, low.y}, {x, high.y});
  for (double y = std::ceil(low.y / step) * step; y <= high.y; y += step) line({low.x, y}, {high.x, y});
}

void MapPainter::ramps() {
  for (const RampDesc& r : scene_.world().ramps) {
    const Frame2 frame(r.pose);
    const double half_x = 0.5 * r.size_m.x, half_y = 0.5 * r.size_m.y;
    // The higher, the darker.
    cairo_pattern_t* shade =
        cairo_pattern_create_linear(frame.to_world({-half_x, 0}).x, frame.to_world({-half_x, 0}).y,
                                    frame.to_world({half_x, 0}).x, frame.to_world({half_x, 0}).y);
    const auto stop = [&](double where, double height_m) {
      const double dark = 1 - std::min(0.45, 0.08 + 3 * height_m);
      cairo_pattern_add_color_stop_rgb(shade, where, r.material.colour.r * dark, r.material.colour.g * dark,
                                       r.material.colour.b * dark);
    };
    stop(0, r.low_m);
    stop(1, r.high_m);
    cairo_new_path(cr_);
    for (const Vec2 corner :
         {Vec2{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}}) {
      cairo_line_to(cr_, frame.to_world(corner).x, frame.to_world(corner).y);
    }
    cairo_close_path(cr_);
    cairo_set_source(cr_, shade);
    cairo_fill(cr_);
    cairo_pattern_destroy(shade);
    // Lines of equal height, a centimetre or ten apart, and an arrow uphill.
    if (r.high_m <= r.low_m) continue;
    cairo_set_source_rgba(cr_, 0, 0, 0, 0.3);
    pen(1);
    const double rise = (r.high_m - r.low_m) / r.size_m.x;
    const double step_m = r.high_m - r.low_m > 0.3 ? 0.1 : 0.01;
    for (double z = std::ceil(r.low_m / step_m + 1e-6) * step_m; z < r.high_m; z += step_m) {
      const double x = (z - r.low_m) / rise - half_x;
      line(frame.to_world({x, -half_y}), frame.to_world({x, half_y}));
    }
    const double head = 0.25 * std::min(half_x, half_y);
    cairo_set_source_rgba(cr_, 0, 0, 0, 0.6);
    pen(2);
    line(frame.to_world({-0.5 * half_x, 0}), frame.to_world({0.5 * half_x, 0}));
    line(frame.to_world({0.5 * half_x - head, head}), frame.to_world({0.5 * half_x, 0}));
    line(frame.to_world({0.5 * half_x - head, -head}), frame.to_world({0.5 * half_x, 0}));
  }
}

void MapPainter::floor_image(Vec2 low, Vec2 high) {
  const FloorDesc& f = scene_.world().floor;
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, f.image_width, f.image_height);
  if (cairo_surface_status(image) == CAIRO_STATUS_SUCCESS) {
    unsigned char* data = cairo_image_surface_get_data(image);
    const int stride = cairo_image_surface_get_stride(image);
    for (int y = 0; y < f.image_height; ++y) {
      auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<long>(y) * stride);
      const std::uint8_t* from = f.image_rgb.data() + 3 * static_cast<std::size_t>(y) * f.image_width;
      for (int x = 0; x < f.image_width; ++x) {
        row[x] = static_cast<std::uint32_t>(from[3 * x] << 16 | from[3 * x + 1] << 8 | from[3 * x + 2]);
      }
    }
    cairo_surface_mark_dirty(image);
    cairo_save(cr_);
    cairo_translate(cr_, low.x, high.y);
    cairo_scale(cr_, (high.x - low.x) / f.image_width, -(high.y - low.y) / f.image_height);
    cairo_set_source_surface(cr_, image, 0, 0);
    cairo_paint(cr_);
    cairo_restore(cr_);
  }
  cairo_surface_destroy(image);
}

}  // namespace sim
