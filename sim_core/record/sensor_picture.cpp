// SPDX-License-Identifier: MIT
// Everything is drawn in pixels; each panel maps its own quantities to its own rectangle.
#include "sim_core/record/sensor_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim_core/record/canvas.h"
#include "sim_core/world/scene.h"

namespace sim {
namespace {

constexpr double kLineColours[6][3] = {{.122, .467, .706}, {.839, .153, .157}, {.173, .627, .173},
                                       {.580, .404, .741}, {1.0, .498, .055},  {.35, .35, .35}};
constexpr double kSeen[3] = {0.85, 0.1, 0.1}, kLonger[3] = {1.0, 0.55, 0.0}, kFree[3] = {0.1, 0.6, 0.2};

std::string write(const std::string& path, int width_px, int height_px,
                  const std::function<void(cairo_t*)>& draw) {
  if (!ends_with(path, ".svg") && !ends_with(path, ".png"))
    return fmt::format("{}: picture: got the ending '{}', expected .png or .svg", path,
                       std::filesystem::path(path).extension().string());
  return write_drawing(path, width_px, height_px, draw);
}

/// 1, 2 or 5 times a power of ten, so that at most about `most` of them fit into `span`.
double round_step(double span, double most) {
  const double rough = std::max(span, 1e-12) / most;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (double m : {1.0, 2.0, 5.0})
    if (m * power >= rough) return m * power;
  return 10 * power;
}

/// A rectangle with a horizontal and a vertical scale.
struct Panel {
  double x, y, width, height;                       // px
  double left = 0, right = 1, bottom = 0, top = 1;  // quantities at the edges

  double px(double v) const { return x + (v - left) / (right - left) * width; }
  double py(double v) const { return y + height - (v - bottom) / (top - bottom) * height; }

  void grid(cairo_t* cr, const char* across, const char* up, double ticks_across, double ticks_up,
            double unit_across = 1, double unit_up = 1) const {
    cairo_set_line_width(cr, 1);
    const double step_x = round_step((right - left) * unit_across, ticks_across);
    for (double v = std::ceil(left * unit_across / step_x - 1e-9) * step_x; v <= right * unit_across + 1e-9;
         v += step_x) {
      rule(cr, px(v / unit_across), y, px(v / unit_across), y + height);
      const std::string label = fmt::format("{:g}", std::fabs(v) < 1e-9 ? 0 : v);
      draw_text(cr, label, px(v / unit_across) - text_width_px(cr, label, 12) / 2, y + height + 16, 12);
    }
    const double step_y = round_step((top - bottom) * unit_up, ticks_up);
    for (double v = std::ceil(bottom * unit_up / step_y - 1e-9) * step_y; v <= top * unit_up + 1e-9;
         v += step_y) {
      rule(cr, x, py(v / unit_up), x + width, py(v / unit_up));
      const std::string label = fmt::format("{:g}", std::fabs(v) < 1e-9 ? 0 : v);
      draw_text(cr, label, x - 6 - text_width_px(cr, label, 12), py(v / unit_up) + 4, 12);
    }
    cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
    draw_text(cr, across, x + width - text_width_px(cr, across, 13), y + height + 34, 13);
    draw_text(cr, up, x - 6, y - 8, 13);
    cairo_rectangle(cr, x, y, width, height);
    cairo_stroke(cr);
  }

 private:
  static void rule(cairo_t* cr, double x0, double y0, double x1, double y1) {
    cairo_set_source_rgba(cr, 0, 0, 0, 0.10);
    cairo_move_to(cr, x0, y0);
    cairo_line_to(cr, x1, y1);
    cairo_stroke(cr);
    cairo_set_source_rgb(cr, 0.25, 0.25, 0.25);
  }
};

void ink(cairo_t* cr, const double (&c)[3], double alpha = 1) {
  cairo_set_source_rgba(cr, c[0], c[1], c[2], alpha);
}

void draw_curve(cairo_t* cr, const Panel& panel, const CurveLine& line, const double (&colour)[3]) {
  cairo_save(cr);
  cairo_rectangle(cr, panel.x, panel.y, panel.width, panel.height);
  cairo_clip(cr);
  cairo_new_path(cr);
  for (const auto& p : line.points) cairo_line_to(cr, panel.px(p.distance_m), panel.py(p.high));
  for (auto p = line.points.rbegin(); p != line.points.rend(); ++p)
    cairo_line_to(cr, panel.px(p->distance_m), panel.py(p->low));
  cairo_close_path(cr);
  ink(cr, colour, 0.18);
  cairo_fill(cr);
  for (const auto& p : line.points) cairo_line_to(cr, panel.px(p.distance_m), panel.py(p.counts));
  ink(cr, colour);
  cairo_set_line_width(cr, 2);
  cairo_stroke(cr);
  for (const ResponseRow& row : line.table) {
    cairo_arc(cr, panel.px(row.distance_m), panel.py(row.value), 3.5, 0, 2 * kPi);
    cairo_fill(cr);
  }
  cairo_restore(cr);
}

/// Scales that hold all lines: from 0, a little above the highest band.
void fit(Panel& panel, const std::vector<CurveLine>& lines) {
  panel.left = panel.bottom = 0;
  panel.right = 0.01, panel.top = 1;
  for (const CurveLine& line : lines) {
    for (const auto& p : line.points) {
      panel.right = std::max(panel.right, p.distance_m);
      panel.top = std::max(panel.top, p.high);
      panel.bottom = std::min(panel.bottom, std::max(p.low, -1000.0));
    }
  }
  panel.top = std::min(panel.top, 6000.0) * 1.04;
}

/// Plan: the robot, what stands around, the rays.
class Plan {
 public:
  Plan(cairo_t* cr, const Scene& scene, int robot, Clicks at, const ProximityExplanation& reading,
       const Panel& box)
      : cr_(cr), scene_(scene), robot_(robot), at_(at), reading_(reading), box_(box) {
    const RobotModel* model = scene.world().model_of(scene.world().robots[static_cast<std::size_t>(robot)]);
    radius_m_ = model->body_radius_m;
    axle_m_ = model->axle_m;
    wheel_m_ = model->wheel_radius_m;
    const Frame2 frame(scene.pose(robot, at));
    Vec2 low = frame.at - Vec2{radius_m_, radius_m_}, high = frame.at + Vec2{radius_m_, radius_m_};
    const double range = reading.config.max_range_m();
    for (const RayExplanation& r : reading.rays) {
      const Vec2 end{reading.at_m.x + range * r.dir.x, reading.at_m.y + range * r.dir.y};
      low = {std::min(low.x, end.x), std::min(low.y, end.y)};
      high = {std::max(high.x, end.x), std::max(high.y, end.y)};
    }
    const Vec2 middle = 0.5 * (low + high);
    const double margin_m = 0.012;
    px_per_m_ =
        std::min(box.width / (high.x - low.x + 2 * margin_m), box.height / (high.y - low.y + 2 * margin_m));
    const double half_x = 0.5 * box.width / px_per_m_, half_y = 0.5 * box.height / px_per_m_;
    box_.left = middle.x - half_x, box_.right = middle.x + half_x;
    box_.bottom = middle.y - half_y, box_.top = middle.y + half_y;
  }

  void paint() {
    cairo_save(cr_);
    cairo_rectangle(cr_, box_.x, box_.y, box_.width, box_.height);
    cairo_clip(cr_);
    const Colour& floor = scene_.world().floor.colour;
    cairo_set_source_rgb(cr_, floor.r, floor.g, floor.b);
    cairo_paint(cr_);
    const Layout& layout = scene_.layout();
    for (std::size_t i = 0; i < layout.fixed.size(); ++i) solid(layout.fixed[i], layout.fixed_surface[i]);
    for (int b = 0; b < scene_.bodies(); ++b) {
      if (b != robot_) solid(scene_.placed(b, at_), layout.moving_surface[static_cast<std::size_t>(b)]);
    }
    robot();
    rays();
    cairo_restore(cr_);
    cairo_set_source_rgb(cr_, 0.1, 0.1, 0.1);
    cairo_set_line_width(cr_, 1);
    cairo_rectangle(cr_, box_.x, box_.y, box_.width, box_.height);
    cairo_stroke(cr_);
    scale_bar();
  }

 private:
  void to(Vec2 m) { cairo_line_to(cr_, box_.px(m.x), box_.py(m.y)); }

  void solid(const Placed& p, const Surface& s) {
    cairo_new_path(cr_);
    if (p.solid->kind == SolidKind::Prism) {
      for (const Vec2& corner : p.solid->outline) to(p.frame.to_world(corner));
      cairo_close_path(cr_);
    } else {
      cairo_arc(cr_, box_.px(p.frame.at.x), box_.py(p.frame.at.y), p.solid->radius_m * px_per_m_, 0, 2 * kPi);
    }
    cairo_set_source_rgb(cr_, s.colour.r, s.colour.g, s.colour.b);
    cairo_fill_preserve(cr_);
    cairo_set_source_rgb(cr_, 0.33 * s.colour.r, 0.33 * s.colour.g, 0.33 * s.colour.b);
    cairo_set_line_width(cr_, 1.5);
    cairo_stroke(cr_);
  }

  void robot() {
    const Frame2 frame(scene_.pose(robot_, at_));
    cairo_new_path(cr_);
    cairo_arc(cr_, box_.px(frame.at.x), box_.py(frame.at.y), radius_m_ * px_per_m_, 0, 2 * kPi);
    cairo_set_source_rgba(cr_, 0.75, 0.83, 0.92, 0.9);
    cairo_fill_preserve(cr_);
    cairo_set_source_rgb(cr_, 0.12, 0.3, 0.5);
    cairo_set_line_width(cr_, 2);
    cairo_stroke(cr_);
    cairo_set_source_rgb(cr_, 0.15, 0.15, 0.15);
    cairo_set_line_width(cr_, 5);
    for (double side : {-0.5, 0.5}) {
      to(frame.to_world({-0.6 * wheel_m_, side * axle_m_}));
      to(frame.to_world({0.6 * wheel_m_, side * axle_m_}));
      cairo_stroke(cr_);
    }
    to(frame.to_world({0.5 * radius_m_, 0}));
    to(frame.to_world({0.15 * radius_m_, 0.25 * radius_m_}));
    to(frame.to_world({0.15 * radius_m_, -0.25 * radius_m_}));
    cairo_close_path(cr_);
    cairo_set_source_rgb(cr_, 1, 1, 1);
    cairo_fill(cr_);
  }

  void part(const RayExplanation& r, double from_m, double to_m, const double (&colour)[3], double width) {
    if (to_m <= from_m) return;
    const Vec3& o = reading_.at_m;
    ink(cr_, colour, 0.95);
    cairo_set_line_width(cr_, width);
    cairo_new_path(cr_);  // text leaves a point behind
    to({o.x + from_m * r.dir.x, o.y + from_m * r.dir.y});
    to({o.x + to_m * r.dir.x, o.y + to_m * r.dir.y});
    cairo_stroke(cr_);
  }

  void rays() {
    const double range = reading_.config.max_range_m();
    for (std::size_t i = 0; i < reading_.rays.size(); ++i) {
      const RayExplanation& r = reading_.rays[i];
      const double hit = r.trace.hit ? r.trace.distance_m : 0;
      const double seems = r.trace.hit ? std::min(r.apparent_m, range) : 0;
      part(r, seems, range, kFree, 1.5);
      part(r, hit, seems, kLonger, 3);
      part(r, 0, hit, kSeen, 2.5);
      if (r.trace.hit) {
        ink(cr_, kSeen);
        cairo_arc(cr_, box_.px(r.trace.to_m.x), box_.py(r.trace.to_m.y), 4, 0, 2 * kPi);
        cairo_fill(cr_);
      }
      if (reading_.rays.size() > 12) continue;
      const double beyond = range + 0.004;
      cairo_set_source_rgb(cr_, 0.1, 0.1, 0.1);
      draw_text(cr_, fmt::format("{}", i), box_.px(reading_.at_m.x + beyond * r.dir.x) - 4,
                box_.py(reading_.at_m.y + beyond * r.dir.y) + 4, 12, true);
    }
  }

  void scale_bar() {
    const double x = box_.x + 12, y = box_.y + box_.height - 14;
    cairo_set_source_rgb(cr_, 0.1, 0.1, 0.1);
    cairo_set_line_width(cr_, 3);
    cairo_move_to(cr_, x, y);
    cairo_line_to(cr_, x + 0.01 * px_per_m_, y);
    cairo_stroke(cr_);
    draw_text(cr_, "10 mm", x, y - 7, 12);
  }

  cairo_t* cr_;
  const Scene& scene_;
  int robot_;
  Clicks at_;
  const ProximityExplanation& reading_;
  Panel box_;
  double radius_m_, axle_m_, wheel_m_, px_per_m_;
};

/// Heights: way over the floor across, height up.
void draw_side(cairo_t* cr, Panel panel, const ProximityExplanation& reading, const RobotModel& model) {
  const double range = reading.config.max_range_m();
  // The panel shows the whole range, and as high as the body or the steepest ray.
  panel.left = -0.012, panel.right = range * 1.05;
  panel.bottom = -0.004;
  panel.top = model.body_height_m + 0.004;
  for (const RayExplanation& r : reading.rays)
    panel.top = std::max(panel.top, reading.at_m.z + range * r.dir.z + 0.004);
  panel.grid(cr, "mm over the floor", "height, mm", 8, 5, 1000, 1000);
  cairo_save(cr);
  cairo_rectangle(cr, panel.x, panel.y, panel.width, panel.height);
  cairo_clip(cr);
  // Floor and body.
  cairo_set_source_rgb(cr, 0.55, 0.5, 0.4);
  cairo_rectangle(cr, panel.x, panel.py(0), panel.width, panel.height);
  cairo_fill(cr);
  cairo_set_source_rgba(cr, 0.75, 0.83, 0.92, 0.9);
  cairo_rectangle(cr, panel.x, panel.py(model.body_height_m), panel.px(0) - panel.x,
                  panel.py(model.body_z0_m) - panel.py(model.body_height_m));
  cairo_fill(cr);
  // What the rays met, at its distance and height.
  for (const RayExplanation& r : reading.rays) {
    if (!r.trace.hit || r.met.top_m <= r.met.bottom_m) continue;
    const double over = r.trace.distance_m * std::cos(r.rise_rad);
    const double top = std::min(r.met.top_m, panel.top * 2);
    const Colour& c = r.met.surface.colour;
    cairo_rectangle(cr, panel.px(over), panel.py(top), 7, panel.py(r.met.bottom_m) - panel.py(top));
    cairo_set_source_rgb(cr, c.r, c.g, c.b);
    cairo_fill_preserve(cr);
    cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
    cairo_set_line_width(cr, 1);
    cairo_stroke(cr);
  }
  // The rays: up to there, as far as it seems to be, and free beyond.
  for (const RayExplanation& r : reading.rays) {
    const auto part = [&](double from, double to, const double(&colour)[3]) {
      if (to <= from) return;
      ink(cr, colour);
      cairo_set_line_width(cr, 2);
      const double c = std::cos(r.rise_rad), s = std::sin(r.rise_rad), z = reading.at_m.z;
      cairo_move_to(cr, panel.px(from * c), panel.py(z + from * s));
      cairo_line_to(cr, panel.px(to * c), panel.py(z + to * s));
      cairo_stroke(cr);
    };
    const double hit = r.trace.hit ? r.trace.distance_m : 0;
    const double seems = r.trace.hit ? std::min(r.apparent_m, range) : 0;
    part(seems, range, kFree);
    part(hit, seems, kLonger);
    part(0, hit, kSeen);
  }
  cairo_restore(cr);
}

void legend(cairo_t* cr, double x, double y, const double (&colour)[3], const std::string& words) {
  ink(cr, colour);
  cairo_set_line_width(cr, 3);
  cairo_move_to(cr, x, y - 4);
  cairo_line_to(cr, x + 22, y - 4);
  cairo_stroke(cr);
  cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
  draw_text(cr, words, x + 28, y, 13);
}

void headline(cairo_t* cr, const std::string& title, const std::string& caption) {
  cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
  draw_text(cr, title, 24, 28, 18, true);
  draw_text(cr, caption, 24, 50, 13);
}

}  // namespace

std::string write_curve_plot(const std::string& path, const std::vector<CurveLine>& lines,
                             const CurvePlotOptions& options) {
  return write(path, options.width_px, options.height_px, [&](cairo_t* cr) {
    headline(cr, options.title, options.caption);
    Panel panel{70, 84, options.width_px - 100.0, options.height_px - 84 - 58.0};
    fit(panel, lines);
    panel.grid(cr, "distance to a flat wall, mm", "counts", 14, 10, 1000, 1);
    for (std::size_t i = 0; i < lines.size(); ++i) draw_curve(cr, panel, lines[i], kLineColours[i % 6]);
    double y = panel.y + 26;
    for (std::size_t i = 0; i < lines.size(); ++i, y += 22)
      legend(cr, panel.x + panel.width - 275, y, kLineColours[i % 6], lines[i].name);
    cairo_set_source_rgb(cr, 0.3, 0.3, 0.3);
    draw_text(cr, options.band, panel.x + panel.width - 275, y, 12);
  });
}

std::string write_sensor_picture(const std::string& path, const Scene& scene, int robot, Clicks at,
                                 const ProximityExplanation& reading, const CurveLine& curve,
                                 const SensorPictureOptions& options) {
  return write(path, options.width_px, options.height_px, [&](cairo_t* cr) {
    headline(cr, options.title, options.caption);
    const double top = 70, split = 0.54 * options.width_px, foot = 40;
    const double height = options.height_px - top - foot;
    Plan(cr, scene, robot, at, reading, Panel{24, top, split - 24, height}).paint();
    legend(cr, 24, options.height_px - 14, kSeen, "up to the hit");
    legend(cr, 170, options.height_px - 14, kLonger, "added by the colour");
    legend(cr, 350, options.height_px - 14, kFree, "free up to the range");
    const double x = split + 66, width = options.width_px - x - 20;
    const RobotModel* model = scene.world().model_of(scene.world().robots[static_cast<std::size_t>(robot)]);
    draw_side(cr, Panel{x, top + 18, width, 0.42 * height - 40}, reading, *model);
    Panel panel{x, top + 0.42 * height + 48, width, 0.58 * height - 92};
    fit(panel, {curve});
    panel.grid(cr, "apparent distance, mm", "counts, with noise band", 8, 6, 1000, 1);
    draw_curve(cr, panel, curve, kLineColours[0]);
    const double px = panel.px(std::min(reading.response.apparent_distance_m, panel.right));
    const double py = panel.py(reading.response.value);
    ink(cr, kSeen);
    cairo_set_line_width(cr, 1.5);
    cairo_move_to(cr, px, panel.y + panel.height);
    cairo_line_to(cr, px, py);
    cairo_line_to(cr, panel.x, py);
    cairo_stroke(cr);
    cairo_arc(cr, px, py, 5, 0, 2 * kPi);
    cairo_fill(cr);
    draw_text(cr,
              fmt::format("{:.4g} counts at {:.4g} mm", reading.response.value,
                          1000 * reading.response.apparent_distance_m),
              std::min(px + 10, panel.x + panel.width - 170), py - 8, 13);
  });
}

}  // namespace sim
