// SPDX-License-Identifier: MIT
// What stands around and over a map: title, robots' names, scale bar, legend, labels. Pixels from the upper
// left corner of the canvas.
#pragma once
#include <cairo.h>

#include <functional>
#include <string>
#include <vector>

#include "sim_core/record/map_painter.h"
#include "sim_core/record/picture.h"

namespace sim {

/// Entries side by side, in as many rows as they need.
class Legend {
 public:
  /// `draw(x, y)`: a sign 20 px wide whose middle line is y.
  void add(std::string text, std::function<void(cairo_t*, double x, double y)> draw);
  void add_line(std::string text, const Colour& colour, double width_px);
  bool is_empty() const { return entries_.empty(); }
  /// Breaks rows at `width_px`; the number of rows, 0 when there is no entry.
  int arrange(double width_px);
  /// The first row's middle line is y; the next ones kRowPx below each.
  void draw(cairo_t* cr, double x, double y) const;

  static constexpr double kRowPx = 20;

 private:
  struct Entry {
    std::string text;
    std::function<void(cairo_t*, double, double)> draw;
    double x = 0;
    int row = 0;
  };
  std::vector<Entry> entries_;
};

/// The meaning of the rays' colours.
void add_ray_legend(Legend& legend);

/// Shows low to high in a canvas whose map is at most `longer_side_px` on its longer side.
MapPlace place_map(const Scene& scene, double longer_side_px);

/// Around a map that is a picture of its own: its margins, the room for the title above, the least width, px.
inline constexpr double kMarginPx = 28, kTitlePx = 62, kNarrowestPx = 520;
/// Room for a scale bar and its text to the left of a legend, px.
inline constexpr double kScaleBarRoomPx = 130;
/// A bar of a round length, at most 100 px, its left end at x, y.
void draw_scale_bar(cairo_t* cr, const MapPlace& place, double x, double y);
/// Title of the world, and a caption under it.
void draw_title(cairo_t* cr, const Scene& scene, const std::string& caption, double x);
void draw_names(cairo_t* cr, const MapPlace& place, const Scene& scene, Clicks at, double size_px,
                double width_px);
/// The part of a picture that a label's fractions are of: the whole canvas.
void draw_labels(cairo_t* cr, const std::vector<PictureLabel>& labels, double width_px, double height_px);

}  // namespace sim
