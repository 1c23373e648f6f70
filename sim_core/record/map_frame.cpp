// SPDX-License-Identifier: MIT
#include "sim_core/record/map_frame.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim_core/record/canvas.h"

namespace sim {
namespace {

constexpr double kTextPx = 13;
constexpr double kSignPx = 26;          // an entry's sign and the gap after it
constexpr double kGapPx = 22;           // between entries
constexpr std::size_t kMostNames = 40;  // robots: more names would cover each other

}  // namespace

void Legend::add(std::string text, std::function<void(cairo_t*, double, double)> draw) {
  entries_.push_back({std::move(text), std::move(draw)});
}

void Legend::add_line(std::string text, const Colour& colour, double width_px) {
  add(std::move(text), [colour, width_px](cairo_t* cr, double x, double y) {
    cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
    cairo_set_line_width(cr, width_px);
    cairo_move_to(cr, x, y);
    cairo_rel_line_to(cr, 20, 0);
    cairo_stroke(cr);
  });
}

int Legend::arrange(double width_px) {
  Canvas ruler(1, 1);
  double x = 0;
  int row = 0;
  for (Entry& e : entries_) {
    const double room = kSignPx + text_width_px(ruler.cr(), e.text, kTextPx);
    if (x > 0 && x + room > width_px) x = 0, ++row;
    e.x = x;
    e.row = row;
    x += room + kGapPx;
  }
  return entries_.empty() ? 0 : row + 1;
}

void Legend::draw(cairo_t* cr, double x, double y) const {
  for (const Entry& e : entries_) {
    cairo_new_path(cr);
    e.draw(cr, x + e.x, y + e.row * kRowPx);
    cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
    draw_text(cr, e.text, x + e.x + kSignPx, y + e.row * kRowPx + 4.5, kTextPx);
  }
}

void add_ray_legend(Legend& legend) {
  legend.add_line("ray to what it met", kRayHit, 2);
  legend.add_line("longer by a dark colour", kRayLonger, 2);
  legend.add_line("free", kRayFree, 2);
}

MapPlace place_map(const Scene& scene, double longer_side_px) {
  const Layout& layout = scene.layout();
  const Vec2 span = layout.high_m - layout.low_m;
  MapPlace place{layout.low_m, layout.high_m};
  place.px_per_m = longer_side_px / std::max({span.x, span.y, 1e-3});
  return place;
}

void draw_scale_bar(cairo_t* cr, const MapPlace& place, double x, double y) {
  double bar_m = 0.001;
  for (double m : {0.002, 0.005, 0.01, 0.02, 0.05, 0.1,  0.2,  0.5,   1.,    2.,
                   5.,    10.,   20.,  50.,  100., 200., 500., 1000., 2000., 5000.}) {
    if (m * place.px_per_m <= 100) bar_m = m;
  }
  const double w = bar_m * place.px_per_m;
  cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
  cairo_set_line_width(cr, 2);
  cairo_move_to(cr, x, y - 6);
  cairo_rel_line_to(cr, 0, 6);
  cairo_rel_line_to(cr, w, 0);
  cairo_rel_line_to(cr, 0, -6);
  cairo_stroke(cr);
  draw_text(cr, bar_m < 1 ? fmt::format("{:g} cm", bar_m * 100) : fmt::format("{:g} m", bar_m), x, y + 16,
            kTextPx);
}

void draw_title(cairo_t* cr, const Scene& scene, const std::string& caption, double x) {
  cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
  const std::string& own = scene.world().title;
  draw_text(cr, own.empty() ? "world" : own, x, 30, 20, true);
  cairo_set_source_rgb(cr, 0.35, 0.35, 0.35);
  draw_text(cr, caption, x, 50, kTextPx);
}

void draw_names(cairo_t* cr, const MapPlace& place, const Scene& scene, Clicks at, double size_px,
                double width_px) {
  if (static_cast<std::size_t>(scene.robots()) > kMostNames) return;
  for (int r = 0; r < scene.robots(); ++r) {
    const RobotDesc& robot = scene.world().robots[static_cast<std::size_t>(r)];
    const RobotModel* model = scene.world().model_of(robot);
    const Pose2 pose = scene.pose(r, at);
    const Vec2 middle = place.to_px({pose.x_m, pose.y_m});
    const double off = model->body_radius_m * place.px_per_m + 6;
    const double w = text_width_px(cr, robot.name, size_px, true);
    // on the side where there is room
    const double x = middle.x + off + w < width_px - 8 ? middle.x + off : middle.x - off - w;
    draw_outlined_text(cr, robot.name, x, middle.y + 0.3 * size_px, size_px, 0x1a1a1a, 0xffffff, 1);
  }
}

void draw_labels(cairo_t* cr, const std::vector<PictureLabel>& labels, double width_px, double height_px) {
  for (const PictureLabel& label : labels) {
    const double line_px = label.size * height_px, alpha = 1 - label.transparency;
    // not a number fails both
    if (!(line_px >= 1 && line_px <= height_px) || !(alpha > 0)) continue;
    const double luma =
        0.299 * (label.rgb >> 16 & 255) + 0.587 * (label.rgb >> 8 & 255) + 0.114 * (label.rgb & 255);
    const std::uint32_t outline = luma > 128 ? 0x202020 : 0xffffff;
    double y = label.y * height_px + 0.78 * line_px;  // the baseline of a line of that height
    for (std::size_t from = 0; from <= label.text.size();) {
      const std::size_t end = std::min(label.text.find('\n', from), label.text.size());
      draw_outlined_text(cr, label.text.substr(from, end - from), label.x * width_px, y, 0.8 * line_px,
                         label.rgb, outline, std::min(alpha, 1.0));
      y += line_px;
      from = end + 1;
    }
  }
}

}  // namespace sim
