// SPDX-License-Identifier: MIT
// Plot of the share of runs that keep an exercise's bounds against the noise scale, with the 95 % interval of
// Wilson, which holds at shares of 0 and 1 too.
#include <cairo/cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/lab_report.h"

namespace tools {

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

void text(cairo_t* c, double x, double y, const std::string& words, double align) {
  cairo_text_extents_t size;
  cairo_text_extents(c, words.c_str(), &size);
  cairo_move_to(c, x - align * size.x_advance, y);
  cairo_show_text(c, words.c_str());
}

}  // namespace

std::string plot_shares(const std::string& file, const StepResult& result) {
  const LabStep& step = *result.step;
  const double top_scale = *std::max_element(step.noise_scales.begin(), step.noise_scales.end());
  const double runs =
      static_cast<double>(result.trials.size()) / static_cast<double>(step.noise_scales.size());
  const auto x_of = [&](double scale) { return kLeft + (kWidth - kLeft - kRight) * scale / top_scale; };
  const auto y_of = [&](double share) { return kHeight - kBottom - (kHeight - kTop - kBottom) * share; };
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(kWidth), static_cast<int>(kHeight));
  cairo_t* c = cairo_create(surface);
  cairo_set_source_rgb(c, 1, 1, 1);
  cairo_paint(c);
  cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, 14);
  for (int k = 0; k <= 4; ++k) {
    cairo_set_source_rgb(c, 0.85, 0.85, 0.85);
    cairo_set_line_width(c, 1);
    cairo_move_to(c, kLeft, y_of(0.25 * k));
    cairo_line_to(c, kWidth - kRight, y_of(0.25 * k));
    cairo_stroke(c);
    cairo_set_source_rgb(c, 0.2, 0.2, 0.2);
    text(c, kLeft - 10, y_of(0.25 * k) + 5, fmt::format("{} %", 25 * k), 1);
  }
  const double every = std::max(1.0, std::ceil(top_scale / 8));
  for (double scale = 0; scale <= top_scale; scale += every)
    text(c, x_of(scale), kHeight - kBottom + 22, fmt::format("{:g}", scale), 0.5);
  text(c, (kLeft + kWidth - kRight) / 2, kHeight - 20, "noise scale of the proximity sensors", 0.5);
  text(c, kLeft, kTop - 15,
       fmt::format("{} in {}: runs that {} within {:g} s, of {:g} each", step.firmware, step.worlds[0],
                   step.says, result.trials[0].trial.seconds, runs),
       0);
  cairo_set_source_rgb(c, 0.1, 0.35, 0.7);
  cairo_set_line_width(c, 2);
  cairo_new_path(c);  // text has left a point behind
  for (double scale : step.noise_scales) cairo_line_to(c, x_of(scale), y_of(share_of(result, scale)));
  cairo_stroke(c);
  for (double scale : step.noise_scales) {
    const double share = share_of(result, scale);
    const Interval i = wilson(share, runs);
    cairo_move_to(c, x_of(scale), y_of(i.low));
    cairo_line_to(c, x_of(scale), y_of(i.high));
    cairo_stroke(c);
    cairo_arc(c, x_of(scale), y_of(share), 5, 0, 2 * 3.14159265358979323846);
    cairo_fill(c);
  }
  const cairo_status_t status = cairo_surface_write_to_png(surface, file.c_str());
  cairo_destroy(c);
  cairo_surface_destroy(surface);
  if (status == CAIRO_STATUS_SUCCESS) return "";
  return file + ": --plot: cannot be written: " + cairo_status_to_string(status);
}

}  // namespace tools
