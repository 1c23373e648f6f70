// SPDX-License-Identifier: MIT
#include "sim_core/record/map_painter.h"

#include <algorithm>

#include "sim_core/light/proximity.h"

namespace sim {
namespace {

constexpr Colour kWayColours[10] = {
    {.122, .467, .706}, {.839, .153, .157}, {.173, .627, .173}, {.580, .404, .741}, {1.0, .498, .055},
    {.090, .745, .812}, {.890, .467, .761}, {.549, .337, .294}, {.737, .741, .133}, {.35, .35, .35}};
constexpr int kFadeSteps = 16;  // of a trail; each is one stroke

}  // namespace

const Colour& way_colour(int robot) { return kWayColours[robot % 10]; }

MapPainter::MapPainter(cairo_t* cr, const MapPlace& place, const Scene& scene, Clicks at)
    : cr_(cr), place_(place), scene_(scene), at_(at) {
  cairo_save(cr_);
  cairo_translate(cr_, place.left_px - place.low_m.x * place.px_per_m,
                  place.top_px + place.high_m.y * place.px_per_m);
  cairo_scale(cr_, place.px_per_m, -place.px_per_m);
}

MapPainter::~MapPainter() { cairo_restore(cr_); }

void MapPainter::line(Vec2 a, Vec2 b) {
  cairo_move_to(cr_, a.x, a.y);
  cairo_line_to(cr_, b.x, b.y);
  cairo_stroke(cr_);
}

void MapPainter::disc(Vec2 at, double radius_m) {
  cairo_new_path(cr_);
  cairo_arc(cr_, at.x, at.y, radius_m, 0, 2 * kPi);
}

void MapPainter::cell(Vec2 middle_m, double side_m, const Colour& colour) {
  cairo_rectangle(cr_, middle_m.x - 0.5 * side_m, middle_m.y - 0.5 * side_m, side_m, side_m);
  ink(colour);
  cairo_fill(cr_);
}

void MapPainter::outline(const Placed& p) {
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

void MapPainter::solid(const Placed& p, const Surface& s, bool loose) {
  // white and near-white things need an edge that shows on a light floor
  const double edge = 0.55;
  const bool see_under = p.z_m > 0;
  outline(p);
  ink(s.colour, see_under ? 0.45 : 1);
  cairo_fill_preserve(cr_);
  cairo_set_source_rgba(cr_, s.colour.r * edge * 0.6, s.colour.g * edge * 0.6, s.colour.b * edge * 0.6, 0.9);
  pen(loose ? 2 : 1.2);
  if (see_under) {
    const double dash[] = {6 / place_.px_per_m, 4 / place_.px_per_m};
    cairo_set_dash(cr_, dash, 2, 0);
  }
  cairo_stroke(cr_);
  cairo_set_dash(cr_, nullptr, 0, 0);
}

void MapPainter::solids() {
  const Layout& layout = scene_.layout();
  for (std::size_t i = 0; i < layout.fixed.size(); ++i)
    solid(layout.fixed[i], layout.fixed_surface[i], false);
  for (int b = scene_.robots(); b < scene_.bodies(); ++b) {
    solid(scene_.placed(b, at_), layout.moving_surface[static_cast<std::size_t>(b)], true);
  }
}

void MapPainter::ways(const Trajectories& trajectories) {
  pen(2);
  cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
  for (std::size_t r = 0; r < trajectories.ways().size(); ++r) {
    const Trajectories::Way& way = trajectories.ways()[r];
    if (way.points_m.empty()) continue;
    ink(way_colour(static_cast<int>(r)), 0.75);
    std::size_t next_break = 0;
    for (std::size_t i = 0; i < way.points_m.size(); ++i) {
      const bool lift = next_break < way.breaks.size() && way.breaks[next_break] == i;
      if (lift) ++next_break;
      (i == 0 || lift ? cairo_move_to : cairo_line_to)(cr_, way.points_m[i].x, way.points_m[i].y);
    }
    cairo_stroke(cr_);
    // where it began
    cairo_arc(cr_, way.points_m.front().x, way.points_m.front().y, 4 / place_.px_per_m, 0, 2 * kPi);
    cairo_set_source_rgb(cr_, 1, 1, 1);
    cairo_fill_preserve(cr_);
    ink(way_colour(static_cast<int>(r)));
    cairo_stroke(cr_);
  }
}

void MapPainter::trails(const Trails& trails) {
  if (trails.span() <= 0) return;
  pen(2);
  cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cr_, CAIRO_LINE_CAP_BUTT);
  for (int r = 0; r < scene_.robots(); ++r) {
    const auto& trail = trails.trail(r);
    const Pose2 here = scene_.pose(r, at_);
    int step = -1;  // of fading
    Vec2 drawn{};   // where the line has come to
    for (std::size_t i = 0; i < trail.size() && trail[i].when <= at_; ++i) {
      // each part of the way is as old as its end
      const bool last = i + 1 == trail.size() || trail[i + 1].when > at_;
      if (!last && trail[i + 1].lifted) continue;
      // what a pixel does not show is not drawn, but for the ends
      if (!last && step >= 0 && !trail[i].lifted && length(trail[i + 1].at_m - drawn) * place_.px_per_m < 1)
        continue;
      const Vec2 to = last ? Vec2{here.x_m, here.y_m} : trail[i + 1].at_m;
      if (length(to - trail[i].at_m) > kJumpM && last) break;
      const double age =
          static_cast<double>(at_ - (last ? at_ : trail[i + 1].when)) / static_cast<double>(trails.span());
      const int own = static_cast<int>(std::min(age, 1.0) * (kFadeSteps - 1));
      if (own != step || trail[i].lifted) {
        if (step >= 0) cairo_stroke(cr_);
        step = own;
        // a part that was not drawn belongs to the next stroke
        const Vec2 from = step >= 0 && !trail[i].lifted ? drawn : trail[i].at_m;
        cairo_move_to(cr_, from.x, from.y);
        ink(way_colour(r), 0.85 * (1 - static_cast<double>(own) / kFadeSteps));
      }
      cairo_line_to(cr_, to.x, to.y);
      drawn = to;
    }
    cairo_stroke(cr_);
  }
}

void MapPainter::rays() {
  pen(1.2);
  cairo_set_line_cap(cr_, CAIRO_LINE_CAP_BUTT);
  // beyond the map there is text
  cairo_save(cr_);
  cairo_rectangle(cr_, place_.low_m.x, place_.low_m.y, place_.high_m.x - place_.low_m.x,
                  place_.high_m.y - place_.low_m.y);
  cairo_clip(cr_);
  for (int r = 0; r < scene_.robots(); ++r) {
    const RobotModel* model = scene_.world().model_of(scene_.world().robots[static_cast<std::size_t>(r)]);
    for (int s = 0; s < static_cast<int>(model->proximity.size()); ++s) {
      const double range = proximity_config(scene_, r, s).max_range_m();
      for (const RayTrace& t : trace_proximity(scene_, r, s, at_)) {
        const Vec2 from{t.from_m.x, t.from_m.y}, to{t.to_m.x, t.to_m.y};
        if (t.distance_m <= 0) continue;
        // Free beyond what it seems to see; from what it met to there in another colour; then the ray itself.
        const Vec2 along = (1 / t.distance_m) * (to - from);  // in plan, for a metre of ray
        const double met = t.hit ? t.distance_m : 0;
        const double seems = t.hit ? std::min(range, t.distance_m / t.colour_factor) : 0;
        ink(kRayFree, 0.6);
        line(from + seems * along, from + range * along);
        if (!t.hit) continue;
        ink(kRayLonger);
        line(from + met * along, from + seems * along);
        ink(kRayHit);
        line(from, to);
        disc(to, 2 / place_.px_per_m);
        cairo_fill(cr_);
      }
    }
  }
  cairo_restore(cr_);
}

void MapPainter::robots(const Minds& minds) {
  for (int r = 0; r < scene_.robots(); ++r) {
    const std::size_t i = static_cast<std::size_t>(r);
    const RobotModel* model = scene_.world().model_of(scene_.world().robots[i]);
    const Frame2 frame(scene_.pose(r, at_));
    const double radius = model->body_radius_m;
    // the body, with a rim in the colour of its way
    disc(frame.at, radius);
    ink(scene_.layout().moving_surface[i].colour);
    cairo_fill_preserve(cr_);
    ink(way_colour(r));
    pen(std::clamp(0.16 * radius * place_.px_per_m, 1.0, 2.5));
    cairo_stroke(cr_);
    const std::uint32_t lit = minds[i]->report().leds;
    // one that sits in the middle lights the body from inside
    for (std::size_t k = 0; k < model->leds.size() && k < 32; ++k) {
      const LedMount& led = model->leds[k];
      if (!(lit >> k & 1) || length(led.at_m) >= led.spot_m) continue;
      disc(frame.at, 0.85 * radius);
      ink(led.colour, 0.8);
      cairo_fill(cr_);
    }
    // wheels
    cairo_set_source_rgb(cr_, 0.12, 0.12, 0.12);
    pen(std::max(std::min(2.0, 0.1 * radius * place_.px_per_m), 0.004 * place_.px_per_m));
    for (double side : {-0.5, 0.5}) {
      const double y = side * model->axle_m, half = 0.6 * model->wheel_radius_m;
      line(frame.to_world({-half, y}), frame.to_world({half, y}));
    }
    // an arrow that points ahead
    cairo_new_path(cr_);
    for (const Vec2 corner : {Vec2{0.72 * radius, 0},
                              {-0.3 * radius, 0.42 * radius},
                              {-0.1 * radius, 0},
                              {-0.3 * radius, -0.42 * radius}}) {
      cairo_line_to(cr_, frame.to_world(corner).x, frame.to_world(corner).y);
    }
    cairo_close_path(cr_);
    cairo_set_source_rgba(cr_, 1, 1, 1, 0.95);
    cairo_fill(cr_);
    leds(*model, frame, lit);
  }
}

void MapPainter::leds(const RobotModel& model, const Frame2& frame, std::uint32_t lit) {
  const double px = place_.px_per_m;
  const double radius = std::min(std::max(0.0045, 2.5 / px), 0.3 * model.body_radius_m);
  for (std::size_t k = 0; k < model.leds.size() && k < 32; ++k) {
    const LedMount& led = model.leds[k];
    if (length(led.at_m) < led.spot_m) continue;
    const bool on = lit >> k & 1;
    // those that are off show only where there is room
    if (!on && model.body_radius_m * px < 16) continue;
    disc(frame.to_world(led.at_m), on ? radius : 0.6 * radius);
    if (on) {
      ink(led.colour);
      cairo_fill_preserve(cr_);
      cairo_set_source_rgb(cr_, 1, 1, 1);
      pen(std::clamp(0.25 * radius * px, 0.4, 1.2));
      cairo_stroke(cr_);
    } else {
      cairo_set_source_rgba(cr_, 0, 0, 0, 0.35);
      cairo_fill(cr_);
    }
  }
}

void MapPainter::lamps() {
  for (const LampDesc& lamp : scene_.world().lamps) {
    cairo_arc(cr_, lamp.position_m.x, lamp.position_m.y, 9 / place_.px_per_m, 0, 2 * kPi);
    cairo_set_source_rgba(cr_, 1, 0.85, 0.2, lamp.on ? 0.9 : 0.2);
    cairo_fill_preserve(cr_);
    cairo_set_source_rgb(cr_, 0.7, 0.5, 0);
    pen(1.5);
    cairo_stroke(cr_);
  }
}

}  // namespace sim
