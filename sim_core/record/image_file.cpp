// SPDX-License-Identifier: MIT
#include "sim_core/record/image_file.h"

#include <cairo.h>

#include "sim_core/base/check.h"
#include "sim_core/record/canvas.h"

namespace sim {

std::string write_png(const std::string& path, int width, int height, const std::vector<std::uint8_t>& rgb) {
  CHECK(rgb.size() == 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
        "three bytes a pixel");
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  std::string bytes;
  cairo_status_t status = cairo_surface_status(image);
  if (status == CAIRO_STATUS_SUCCESS) {
    unsigned char* pixels = cairo_image_surface_get_data(image);
    const long stride = cairo_image_surface_get_stride(image);
    const std::uint8_t* from = rgb.data();
    for (int y = 0; y < height; ++y) {
      auto* row = reinterpret_cast<std::uint32_t*>(pixels + y * stride);
      for (int x = 0; x < width; ++x, from += 3)
        row[x] =
            static_cast<std::uint32_t>(from[0]) << 16 | static_cast<std::uint32_t>(from[1]) << 8 | from[2];
    }
    cairo_surface_mark_dirty(image);
    status = cairo_surface_write_to_png_stream(image, append_bytes, &bytes);
  }
  cairo_surface_destroy(image);
  return write_drawn(path, status, bytes);
}

}  // namespace sim
