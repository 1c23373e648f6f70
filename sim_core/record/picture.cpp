// SPDX-License-Identifier: MIT
// Everything is drawn in metres through one transform; line widths and text are given in pixels and
// converted.
#include "sim_core/record/picture.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_core/light/proximity.h"
#include "sim_core/world/scene.h"

namespace sim {
namespace {

constexpr double kMarginPx = 28, kTitlePx = 62, kFootPx = 64;
constexpr std::size_t kMostNames = 40;  // robots: more names would cover each other
constexpr std::size_t kMostLegend = 8;  // robots named in the legend
constexpr std::size_t kMostPoints = 400'000;
constexpr double kPointM = 0.001;

/// Ten colours that differ in hue and in brightness (Tableau 10).
constexpr double kWayColours[10][3] = {
    {.122, .467, .706}, {.839, .153, .157}, {.173, .627, .173}, {.580, .404, .741}, {1.0, .498, .055},
    {.090, .745, .812}, {.890, .467, .761}, {.549, .337, .294}, {.737, .741, .133}, {.35, .35, .35}};

class Painter {
 public:
  Painter(cairo_t* cr, const Scene& scene, const Minds& minds, const Trajectories* trajectories,
          const PictureOptions& options, double px_per_m, double width_px, double height_px)
      : cr_(cr),
        scene_(scene),
        minds_(minds),
        ways_(trajectories),
        options_(options),
        px_per_m_(px_per_m),
        width_px_(width_px),
        height_px_(height_px) {}

  void paint() {
    cairo_set_source_rgb(cr_, 1, 1, 1);
    cairo_paint(cr_);
    cairo_save(cr_);
    const Layout& layout = scene_.layout();
    cairo_translate(cr_, kMarginPx - layout.low_m.x * px_per_m_, kTitlePx + layout.high_m.y * px_per_m_);
    cairo_scale(cr_, px_per_m_, -px_per_m_);
    floor();
    ramps();
    if (ways_) ways();
    solids();
    if (options_.sensor_rays) rays();
    robots();
    lamps();
    cairo_restore(cr_);
    if (options_.names && static_cast<std::size_t>(scene_.robots()) <= kMostNames) names();
    title();
    foot();
  }

 private:
  void pen(double px) { cairo_set_line_width(cr_, px / px_per_m_); }
  void ink(const Colour& c, double alpha = 1) { cairo_set_source_rgba(cr_, c.r, c.g, c.b, alpha); }
  void way_ink(std::size_t robot, double alpha) {
    const double* c = kWayColours[robot % 10];
    cairo_set_source_rgba(cr_, c[0], c[1], c[2], alpha);
  }

  void floor() {
    const Layout& layout = scene_.layout();
    const WorldDesc& world = scene_.world();
    Vec2 low = layout.low_m, high = layout.high_m;
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

  /// Ramps: the higher the darker, contour lines every centimetre, an arrow uphill.
  void ramps() {
    for (const RampDesc& r : scene_.world().ramps) {
      const Frame2 frame(r.pose);
      const double half_x = 0.5 * r.size_m.x, half_y = 0.5 * r.size_m.y;
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

  void floor_image(Vec2 low, Vec2 high) {
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

  void line(Vec2 a, Vec2 b) {
    cairo_move_to(cr_, a.x, a.y);
    cairo_line_to(cr_, b.x, b.y);
    cairo_stroke(cr_);
  }

  void outline(const Placed& p) {
    cairo_new_path(cr_);
    if (p.solid->kind == SolidKind::Prism) {
      for (const Vec2& corner : p.solid->outline) {
        const Vec2 w = p.frame.to_world(corner);
        cairo_line_to(cr_, w.x, w.y);
      }
      cairo_close_path(cr_);
    } else {
      cairo_arc(cr_, p.frame.at.x, p.frame.at.y, p.solid->radius_m, 0, 2 * kPi);
    }
  }

  void solid(const Placed& p, const Surface& s, bool loose) {
    // white and near-white things need an edge that shows on a light floor
    const double edge = 0.55;
    const bool see_under = p.z_m > 0;
    outline(p);
    ink(s.colour, see_under ? 0.45 : 1);
    cairo_fill_preserve(cr_);
    cairo_set_source_rgba(cr_, s.colour.r * edge * 0.6, s.colour.g * edge * 0.6, s.colour.b * edge * 0.6,
                          0.9);
    pen(loose ? 2 : 1.2);
    if (see_under) {
      const double dash[] = {6 / px_per_m_, 4 / px_per_m_};
      cairo_set_dash(cr_, dash, 2, 0);
    }
    cairo_stroke(cr_);
    cairo_set_dash(cr_, nullptr, 0, 0);
  }

  void solids() {
    const Layout& layout = scene_.layout();
    for (std::size_t i = 0; i < layout.fixed.size(); ++i)
      solid(layout.fixed[i], layout.fixed_surface[i], false);
    for (int b = scene_.robots(); b < scene_.bodies(); ++b) {
      solid(scene_.placed(b, scene_.now()), layout.moving_surface[static_cast<std::size_t>(b)], true);
    }
  }

  void ways() {
    pen(2);
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
    for (std::size_t r = 0; r < ways_->ways().size(); ++r) {
      const Trajectories::Way& way = ways_->ways()[r];
      if (way.points_m.empty()) continue;
      way_ink(r, 0.75);
      std::size_t next_break = 0;
      for (std::size_t i = 0; i < way.points_m.size(); ++i) {
        const bool lift = next_break < way.breaks.size() && way.breaks[next_break] == i;
        if (lift) ++next_break;
        (i == 0 || lift ? cairo_move_to : cairo_line_to)(cr_, way.points_m[i].x, way.points_m[i].y);
      }
      cairo_stroke(cr_);
      // where it began
      cairo_arc(cr_, way.points_m.front().x, way.points_m.front().y, 4 / px_per_m_, 0, 2 * kPi);
      cairo_set_source_rgb(cr_, 1, 1, 1);
      cairo_fill_preserve(cr_);
      way_ink(r, 1);
      cairo_stroke(cr_);
    }
  }

  void rays() {
    pen(1);
    for (int r = 0; r < scene_.robots(); ++r) {
      const RobotModel* model = scene_.world().model_of(scene_.world().robots[static_cast<std::size_t>(r)]);
      for (int s = 0; s < static_cast<int>(model->proximity.size()); ++s) {
        for (const RayTrace& t : trace_proximity(scene_, r, s, scene_.now())) {
          if (t.hit) {
            cairo_set_source_rgba(cr_, 0.85, 0.1, 0.1, 0.9);
          } else {
            cairo_set_source_rgba(cr_, 0.1, 0.6, 0.2, 0.45);
          }
          line({t.from_m.x, t.from_m.y}, {t.to_m.x, t.to_m.y});
          if (!t.hit) continue;
          cairo_arc(cr_, t.to_m.x, t.to_m.y, 2 / px_per_m_, 0, 2 * kPi);
          cairo_fill(cr_);
        }
      }
    }
  }

  void robots() {
    for (int r = 0; r < scene_.robots(); ++r) {
      const std::size_t i = static_cast<std::size_t>(r);
      const RobotModel* model = scene_.world().model_of(scene_.world().robots[i]);
      const Frame2 frame(scene_.state(r).pose);
      const double radius = model->body_radius_m;
      cairo_arc(cr_, frame.at.x, frame.at.y, radius, 0, 2 * kPi);
      ink(scene_.layout().moving_surface[i].colour);
      cairo_fill_preserve(cr_);
      way_ink(i, 1);
      pen(2.5);
      cairo_stroke(cr_);
      // wheels
      cairo_set_source_rgb(cr_, 0.12, 0.12, 0.12);
      pen(std::max(2.0, 0.004 * px_per_m_));
      for (double side : {-0.5, 0.5}) {
        const double y = side * model->axle_m, half = 0.6 * model->wheel_radius_m;
        line(frame.to_world({-half, y}), frame.to_world({half, y}));
      }
      // an arrow that points ahead
      const Vec2 nose = frame.to_world({0.8 * radius, 0}),
                 left = frame.to_world({0.25 * radius, 0.4 * radius}),
                 right = frame.to_world({0.25 * radius, -0.4 * radius});
      cairo_move_to(cr_, nose.x, nose.y);
      cairo_line_to(cr_, left.x, left.y);
      cairo_line_to(cr_, right.x, right.y);
      cairo_close_path(cr_);
      cairo_set_source_rgba(cr_, 1, 1, 1, 0.95);
      cairo_fill(cr_);
      const std::uint32_t leds = minds_[i]->report().leds;
      for (std::size_t k = 0; k < model->leds.size() && k < 32; ++k) {
        if (!(leds >> k & 1)) continue;
        const Vec2 at = frame.to_world(model->leds[k].at_m);
        cairo_arc(cr_, at.x, at.y, std::max(0.003, 2.5 / px_per_m_), 0, 2 * kPi);
        ink(model->leds[k].colour);
        cairo_fill(cr_);
      }
    }
  }

  void lamps() {
    for (const LampDesc& lamp : scene_.world().lamps) {
      cairo_arc(cr_, lamp.position_m.x, lamp.position_m.y, 9 / px_per_m_, 0, 2 * kPi);
      cairo_set_source_rgba(cr_, 1, 0.85, 0.2, lamp.on ? 0.9 : 0.2);
      cairo_fill_preserve(cr_);
      cairo_set_source_rgb(cr_, 0.7, 0.5, 0);
      pen(1.5);
      cairo_stroke(cr_);
    }
  }

  Vec2 to_px(Vec2 m) const {
    const Layout& layout = scene_.layout();
    return {kMarginPx + (m.x - layout.low_m.x) * px_per_m_, kTitlePx + (layout.high_m.y - m.y) * px_per_m_};
  }

  void text(const std::string& s, double x, double y, double size, bool bold = false) {
    cairo_select_font_face(cr_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr_, size);
    cairo_move_to(cr_, x, y);
    cairo_show_text(cr_, s.c_str());
  }

  double text_width(const std::string& s, double size) {
    cairo_set_font_size(cr_, size);
    cairo_text_extents_t e;
    cairo_text_extents(cr_, s.c_str(), &e);
    return e.x_advance;
  }

  void names() {
    for (int r = 0; r < scene_.robots(); ++r) {
      const RobotDesc& robot = scene_.world().robots[static_cast<std::size_t>(r)];
      const RobotModel* model = scene_.world().model_of(robot);
      const Vec2 at = to_px({scene_.state(r).pose.x_m, scene_.state(r).pose.y_m});
      const double off = model->body_radius_m * px_per_m_ + 6;
      const double w = text_width(robot.name, 13);
      // on the side where there is room
      const double x = at.x + off + w < width_px_ - kMarginPx ? at.x + off : at.x - off - w;
      cairo_select_font_face(cr_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
      cairo_set_font_size(cr_, 13);
      cairo_move_to(cr_, x, at.y + 4);
      cairo_text_path(cr_, robot.name.c_str());
      cairo_set_source_rgba(cr_, 1, 1, 1, 0.85);
      cairo_set_line_width(cr_, 3);
      cairo_stroke_preserve(cr_);
      cairo_set_source_rgb(cr_, 0.1, 0.1, 0.1);
      cairo_fill(cr_);
    }
  }

  void title() {
    cairo_set_source_rgb(cr_, 0.1, 0.1, 0.1);
    const std::string& own = scene_.world().title;
    text(own.empty() ? "world" : own, kMarginPx, 30, 20, true);
    const std::string caption = options_.caption.empty()
                                    ? fmt::format("{:.2f} s, {} robot{}", to_seconds(scene_.now()),
                                                  scene_.robots(), scene_.robots() == 1 ? "" : "s")
                                    : options_.caption;
    cairo_set_source_rgb(cr_, 0.35, 0.35, 0.35);
    text(caption, kMarginPx, 50, 13);
  }

  /// Scale bar on the left, legend beside it.
  void foot() {
    const double y = height_px_ - 26;
    double bar_m = 0.001;
    for (double m : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1., 2., 5., 10., 20., 50., 100., 200., 500.}) {
      if (m * px_per_m_ <= 180) bar_m = m;
    }
    const double w = bar_m * px_per_m_;
    cairo_set_source_rgb(cr_, 0.1, 0.1, 0.1);
    cairo_set_line_width(cr_, 2);
    cairo_move_to(cr_, kMarginPx, y - 6);
    cairo_rel_line_to(cr_, 0, 6);
    cairo_rel_line_to(cr_, w, 0);
    cairo_rel_line_to(cr_, 0, -6);
    cairo_stroke(cr_);
    text(bar_m < 1 ? fmt::format("{:g} cm", bar_m * 100) : fmt::format("{:g} m", bar_m), kMarginPx, y + 18,
         13);

    double x = kMarginPx + std::max(w, 60.0) + 36;
    const auto entry = [&](const std::string& s, auto draw) {
      const double room = 26 + text_width(s, 13) + 22;
      if (x + room > width_px_ - kMarginPx + 22) return false;
      cairo_new_path(cr_);  // text leaves its end as the current point
      draw(x, y - 2);
      cairo_set_source_rgb(cr_, 0.1, 0.1, 0.1);
      text(s, x + 26, y + 3, 13);
      x += room;
      return true;
    };
    const std::size_t n = static_cast<std::size_t>(scene_.robots());
    cairo_select_font_face(cr_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    if (ways_) {
      entry("start", [&](double ex, double ey) {
        cairo_arc(cr_, ex + 10, ey, 4, 0, 2 * kPi);
        cairo_set_source_rgb(cr_, 0.3, 0.3, 0.3);
        cairo_set_line_width(cr_, 2);
        cairo_stroke(cr_);
      });
    }
    if (options_.sensor_rays) {
      const auto ray = [&](double r, double g, double b) {
        return [this, r, g, b](double ex, double ey) {
          cairo_set_source_rgb(cr_, r, g, b);
          cairo_set_line_width(cr_, 1.5);
          cairo_move_to(cr_, ex, ey);
          cairo_rel_line_to(cr_, 20, 0);
          cairo_stroke(cr_);
        };
      };
      entry("ray that hit", ray(0.85, 0.1, 0.1));
      entry("ray that missed", ray(0.1, 0.6, 0.2));
    }
    for (std::size_t r = 0; r < std::min(n, kMostLegend); ++r) {
      const RobotDesc& robot = scene_.world().robots[r];
      const std::string label =
          robot.firmware.empty() ? robot.name : robot.name + " (" + robot.firmware + ")";
      const bool fits = entry(label, [&](double ex, double ey) {
        way_ink(r, 1);
        cairo_set_line_width(cr_, 3);
        cairo_move_to(cr_, ex, ey);
        cairo_rel_line_to(cr_, 20, 0);
        cairo_stroke(cr_);
      });
      if (!fits) break;
    }
  }

  cairo_t* cr_;
  const Scene& scene_;
  const Minds& minds_;
  const Trajectories* ways_;
  const PictureOptions& options_;
  double px_per_m_, width_px_, height_px_;
};

bool ends_with(const std::string& s, const char* end) {
  const std::string e = end;
  return s.size() > e.size() && s.compare(s.size() - e.size(), e.size(), e) == 0;
}

}  // namespace

void Trajectories::sample(const Scene& scene) {
  for (std::size_t r = 0; r < ways_.size(); ++r) {
    Way& way = ways_[r];
    const Pose2& p = scene.state(static_cast<int>(r)).pose;
    const Vec2 at{p.x_m, p.y_m};
    const bool lifted = !way.breaks.empty() && way.breaks.back() == way.points_m.size();
    if (!way.points_m.empty() && !lifted && length(at - way.points_m.back()) < kPointM) continue;
    if (way.points_m.size() < kMostPoints) way.points_m.push_back(at);
  }
}

void Trajectories::lift_pen(int robot) {
  Way& way = ways_[static_cast<std::size_t>(robot)];
  if (way.breaks.empty() || way.breaks.back() != way.points_m.size())
    way.breaks.push_back(way.points_m.size());
}

std::string write_picture(const std::string& path, const Scene& scene, const Minds& minds,
                          const Trajectories* trajectories, const PictureOptions& options) {
  const bool svg = ends_with(path, ".svg");
  if (!svg && !ends_with(path, ".png"))
    return fmt::format("{}: picture: got this extension, expected .png or .svg", path);
  const Layout& layout = scene.layout();
  const Vec2 span = layout.high_m - layout.low_m;
  const double px_per_m = options.width_px / std::max({span.x, span.y, 1e-3});
  const double width = std::max(520.0, std::ceil(span.x * px_per_m + 2 * kMarginPx));
  const double height = std::ceil(span.y * px_per_m + kTitlePx + kFootPx);
  cairo_surface_t* surface =
      svg ? cairo_svg_surface_create(path.c_str(), width, height)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height));
  cairo_t* cr = cairo_create(surface);
  Painter(cr, scene, minds, trajectories, options, px_per_m, width, height).paint();
  cairo_status_t status = cairo_status(cr);
  cairo_destroy(cr);
  if (status == CAIRO_STATUS_SUCCESS && !svg) status = cairo_surface_write_to_png(surface, path.c_str());
  cairo_surface_finish(surface);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  return status == CAIRO_STATUS_SUCCESS
             ? std::string()
             : fmt::format("{}: cannot be written: {}", path, cairo_status_to_string(status));
}

}  // namespace sim
