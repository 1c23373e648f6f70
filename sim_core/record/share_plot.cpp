// SPDX-License-Identifier: MIT
// The interval is Wilson's at 95 %, which holds at shares of 0 and 1 too.
#include "sim_core/record/share_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_core/geometry/pose.h"
#include "sim_core/record/canvas.h"

namespace sim {

namespace {

constexpr double kWidth = 720, kHeight = 440, kLeft = 80, kRight = 30, kTop = 40, kBottom = 70;  // pixels

struct Interval {
  double low, high;
};

Interval wilson(double share, double n) {
  const double z = 1.96, zz = z * z;
  const double middle = (share + zz / (2 * n)) / (1 + zz / n);
  const double half = z / (1 + zz / n) * std::sqrt(share * (1 - share) / n + zz / (4 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

/// `align`: 0 begins at x, 0.5 has its middle there, 1 ends there.
void text(cairo_t* c, double x, double y, const std::string& words, double align) {
  constexpr double kSize = 14;
  draw_text(c, words, x - align * text_width_px(c, words, kSize), y, kSize);
}

}  // namespace

std::string write_share_plot(const std::string& path, const SharePlot& plot) {
  if (plot.points.empty()) return path + ": plot: got no point, expected one or more";
  // The axes: from 0 to the largest value, and from 0 to 1.
  double right = 0;
  for (const SharePoint& p : plot.points) right = std::max(right, p.x);
  if (right <= 0) right = 1;
  const auto x_of = [&](double x) { return kLeft + (kWidth - kLeft - kRight) * x / right; };
  const auto y_of = [&](double share) { return kHeight - kBottom - (kHeight - kTop - kBottom) * share; };
  const auto draw = [&](cairo_t* c) {
    // Grid and texts.
    for (int k = 0; k <= 4; ++k) {
      cairo_set_source_rgb(c, 0.85, 0.85, 0.85);
      cairo_set_line_width(c, 1);
      cairo_move_to(c, kLeft, y_of(0.25 * k));
      cairo_line_to(c, kWidth - kRight, y_of(0.25 * k));
      cairo_stroke(c);
      cairo_set_source_rgb(c, 0.2, 0.2, 0.2);
      text(c, kLeft - 10, y_of(0.25 * k) + 5, fmt::format("{} %", 25 * k), 1);
    }
    const double every = std::max(1.0, std::ceil(right / 8));
    for (double x = 0; x <= right; x += every)
      text(c, x_of(x), kHeight - kBottom + 22, fmt::format("{:g}", x), 0.5);
    text(c, (kLeft + kWidth - kRight) / 2, kHeight - 20, plot.across, 0.5);
    text(c, kLeft, kTop - 15, plot.title, 0);
    // The curve, each point with its 95 % interval.
    cairo_set_source_rgb(c, 0.1, 0.35, 0.7);
    cairo_set_line_width(c, 2);
    for (const SharePoint& p : plot.points) cairo_line_to(c, x_of(p.x), y_of(p.share));
    cairo_stroke(c);
    for (const SharePoint& p : plot.points) {
      const Interval i = wilson(p.share, p.runs);
      cairo_move_to(c, x_of(p.x), y_of(i.low));
      cairo_line_to(c, x_of(p.x), y_of(i.high));
      cairo_stroke(c);
      cairo_arc(c, x_of(p.x), y_of(p.share), 5, 0, 2 * kPi);
      cairo_fill(c);
    }
  };
  return write_drawing(path, kWidth, kHeight, draw);
}

}  // namespace sim
