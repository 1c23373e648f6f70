// SPDX-License-Identifier: MIT
// What everything is drawn on, by cairo: pixels in memory, a PNG or an SVG file; and text on it. Lengths in
// pixels (SVG units) from the upper left corner.
#pragma once
#include <cairo.h>

#include <cstdint>
#include <functional>
#include <string>

namespace sim {

/// Pixels in memory.
class Canvas {
 public:
  /// White. Sides 1 to 32767 px.
  Canvas(int width_px, int height_px);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  cairo_t* cr() const { return cr_; }
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  /// 0x00RRGGBB, rows from the top; valid until the next stroke.
  const std::uint32_t* pixels() const;
  /// Pixels from one row to the next.
  int stride_px() const;
  /// Empty, or what went wrong with the drawing.
  std::string error() const;

 private:
  int width_px_, height_px_;
  cairo_surface_t* surface_;
  cairo_t* cr_;
};

/// For cairo's streams: adds to the std::string at `text`.
cairo_status_t append_bytes(void* text, const unsigned char* data, unsigned length);
/// Writes what cairo has drawn with that success. Empty, or "PATH: cannot be written: reason".
std::string write_drawn(const std::string& path, cairo_status_t status, const std::string& bytes);

/// Draws into a file: PNG or SVG by its ending. Returns an empty string, or "FILE: what is wrong".
std::string write_drawing(const std::string& path, double width_px, double height_px,
                          const std::function<void(cairo_t*)>& draw);
/// Whether `path` ends in `ending`, with something before it.
bool ends_with(const std::string& path, const char* ending);

/// Text with its baseline at y. Bytes that are no UTF-8 become U+FFFD.
void draw_text(cairo_t* cr, const std::string& text, double x, double y, double size_px, bool bold = false);
double text_width_px(cairo_t* cr, const std::string& text, double size_px, bool bold = false);
/// The same with an outline in another colour, readable on any ground. Colours 0xRRGGBB.
void draw_outlined_text(cairo_t* cr, const std::string& text, double x, double y, double size_px,
                        std::uint32_t rgb, std::uint32_t outline_rgb, double alpha);

}  // namespace sim
