// SPDX-License-Identifier: MIT
#include "sim_core/record/canvas.h"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <cmath>

#include "sim_core/base/output_file.h"
#include "sim_core/base/utf8.h"

namespace sim {
namespace {

void font(cairo_t* cr, double size_px, bool bold) {
  cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size_px);
}

void ink(cairo_t* cr, std::uint32_t rgb, double alpha) {
  cairo_set_source_rgba(cr, (rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, alpha);
}

/// cairo takes nothing but UTF-8.
std::string valid_utf8(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = utf8_length(text, i);
    if (n) {
      out.append(text, i, n);
    } else {
      out += "\xEF\xBF\xBD";
    }
    i += n ? n : 1;
  }
  return out;
}

}  // namespace

Canvas::Canvas(int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px)),
      cr_(cairo_create(surface_)) {
  cairo_set_source_rgb(cr_, 1, 1, 1);
  cairo_paint(cr_);
}

Canvas::~Canvas() {
  cairo_destroy(cr_);
  cairo_surface_destroy(surface_);
}

const std::uint32_t* Canvas::pixels() const {
  cairo_surface_flush(surface_);
  return reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface_));
}

int Canvas::stride_px() const { return cairo_image_surface_get_stride(surface_) / 4; }

std::string Canvas::error() const {
  const cairo_status_t status = cairo_status(cr_);
  return status == CAIRO_STATUS_SUCCESS ? std::string() : cairo_status_to_string(status);
}

bool ends_with(const std::string& path, const char* ending) {
  const std::string e = ending;
  return path.size() > e.size() && path.compare(path.size() - e.size(), e.size(), e) == 0;
}

cairo_status_t append_bytes(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

// cairo itself says no more of a full disk than that an error happened
std::string write_drawn(const std::string& path, cairo_status_t status, const std::string& bytes) {
  if (status != CAIRO_STATUS_SUCCESS)
    return fmt::format("{}: cannot be written: {}", path, cairo_status_to_string(status));
  OutputFile file(path);
  file.append(bytes);
  file.close();
  return file.error();
}

std::string write_drawing(const std::string& path, double width_px, double height_px,
                          const std::function<void(cairo_t*)>& draw) {
  const bool svg = ends_with(path, ".svg");
  std::string bytes;
  cairo_surface_t* surface =
      svg ? cairo_svg_surface_create_for_stream(append_bytes, &bytes, width_px, height_px)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width_px)),
                                       static_cast<int>(std::ceil(height_px)));
  cairo_t* cr = cairo_create(surface);
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
  draw(cr);
  cairo_status_t status = cairo_status(cr);
  cairo_destroy(cr);
  if (status == CAIRO_STATUS_SUCCESS && !svg)
    status = cairo_surface_write_to_png_stream(surface, append_bytes, &bytes);
  cairo_surface_finish(surface);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  return write_drawn(path, status, bytes);
}

void draw_text(cairo_t* cr, const std::string& text, double x, double y, double size_px, bool bold) {
  font(cr, size_px, bold);
  cairo_move_to(cr, x, y);
  cairo_show_text(cr, valid_utf8(text).c_str());
  cairo_new_path(cr);  // text leaves its end as the current point
}

double text_width_px(cairo_t* cr, const std::string& text, double size_px, bool bold) {
  font(cr, size_px, bold);
  cairo_text_extents_t e;
  cairo_text_extents(cr, valid_utf8(text).c_str(), &e);
  return e.x_advance;
}

void draw_outlined_text(cairo_t* cr, const std::string& text, double x, double y, double size_px,
                        std::uint32_t rgb, std::uint32_t outline_rgb, double alpha) {
  font(cr, size_px, true);
  cairo_move_to(cr, x, y);
  cairo_text_path(cr, valid_utf8(text).c_str());
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(cr, std::fmax(2, 0.16 * size_px));
  ink(cr, outline_rgb, 0.85 * alpha);
  cairo_stroke_preserve(cr);
  ink(cr, rgb, alpha);
  cairo_fill(cr);
}

}  // namespace sim
