// SPDX-License-Identifier: MIT
#include "sim_core/load/floor_image.h"

#include <cairo.h>
#include <fmt/format.h>

namespace sim {

std::string read_floor_image(const std::string& path, FloorDesc& floor) {
  constexpr int kMostPixels = 64'000'000;
  cairo_surface_t* image = cairo_image_surface_create_from_png(path.c_str());
  const cairo_status_t status = cairo_surface_status(image);
  if (status != CAIRO_STATUS_SUCCESS) {
    cairo_surface_destroy(image);
    return fmt::format("got {} ({}), expected a PNG file", path, cairo_status_to_string(status));
  }
  const int width = cairo_image_surface_get_width(image);
  const int height = cairo_image_surface_get_height(image);
  std::string wrong;
  if (width < 1 || height < 1 || static_cast<long>(width) * height > kMostPixels) {
    wrong = fmt::format("got {} by {} pixels, expected at most {} in all", width, height, kMostPixels);
  } else {
    // paint onto white, so that transparent parts show the paper
    cairo_surface_t* flat = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t* cr = cairo_create(flat);
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    cairo_set_source_surface(cr, image, 0, 0);
    cairo_paint(cr);
    cairo_destroy(cr);
    cairo_surface_flush(flat);
    floor.image_width = width;
    floor.image_height = height;
    floor.image_rgb.clear();
    for (int y = 0; y < height; ++y) {
      const auto* row = reinterpret_cast<const std::uint32_t*>(
          cairo_image_surface_get_data(flat) + static_cast<long>(y) * cairo_image_surface_get_stride(flat));
      for (int x = 0; x < width; ++x) {
        for (int shift : {16, 8, 0}) floor.image_rgb.push_back(static_cast<std::uint8_t>(row[x] >> shift));
      }
    }
    cairo_surface_destroy(flat);
  }
  cairo_surface_destroy(image);
  return wrong;
}

}  // namespace sim
