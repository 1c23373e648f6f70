// SPDX-License-Identifier: MIT
#include "sim_core/record/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim_core/record/canvas.h"
#include "sim_core/record/frame_feed.h"
#include "sim_core/record/map_frame.h"

namespace sim {
namespace {

constexpr double kFilmMarginPx = 8, kHeadPx = 30, kFilmFootPx = 36;
constexpr double kFilmNarrowestPx = 320;  // room for the time and the scale bar
constexpr double kTimePx = 15;

int even(double px) { return 2 * static_cast<int>(std::ceil(px / 2 - 1e-9)); }

}  // namespace

Film::Film(const std::string& path, const Scene& scene, const FilmOptions& options)
    : options_(options),
      trails_(scene.robots(), from_seconds(options.trail_s)),
      legend_(std::make_unique<Legend>()) {
  if (!is_film(path)) {
    error_ = fmt::format("{}: film: got the ending '{}', expected .webm, .png or .apng", path,
                         std::filesystem::path(path).extension().string());
    return;
  }
  if (options.sensor_rays) add_ray_legend(*legend_);
  // the map gets what the texts leave of the longer side
  const Layout& layout = scene.layout();
  const Vec2 span{std::max(layout.high_m.x - layout.low_m.x, 1e-3),
                  std::max(layout.high_m.y - layout.low_m.y, 1e-3)};
  const double size = options.size_px;
  double width = size, height = size;
  double foot = kFilmFootPx;
  for (int round = 0; round < 2; ++round) {  // a narrower frame may need more rows of legend
    const int rows = legend_->arrange(width - 2 * kFilmMarginPx - kScaleBarRoomPx);
    foot = kFilmFootPx + std::max(0, rows - 1) * Legend::kRowPx;
    const double px_per_m = std::min((size - 2 * kFilmMarginPx) / span.x, (size - kHeadPx - foot) / span.y);
    place_ = std::make_unique<MapPlace>(place_map(scene, px_per_m * std::max(span.x, span.y)));
    width = std::max(std::min(kFilmNarrowestPx, size), place_->width_px() + 2 * kFilmMarginPx);
    height = kHeadPx + place_->height_px() + foot;
  }
  place_->left_px = 0.5 * (even(width) - place_->width_px());
  place_->top_px = kHeadPx;
  canvas_ = std::make_unique<Canvas>(even(width), even(height));
  feed_ = std::make_unique<FrameFeed>((ends_with(path, ".webm") ? make_webm_encoder : make_apng_encoder)(
      path, canvas_->width_px(), canvas_->height_px(), options.frames_per_s));
  error_ = feed_->error();
}

Film::~Film() = default;

bool Film::is_film(const std::string& path) {
  return ends_with(path, ".webm") || ends_with(path, ".png") || ends_with(path, ".apng");
}

int Film::width_px() const { return canvas_ ? canvas_->width_px() : 0; }
int Film::height_px() const { return canvas_ ? canvas_->height_px() : 0; }

Clicks Film::time_of(std::int64_t frame) const {
  return from_seconds(static_cast<double>(frame) * options_.speed / options_.frames_per_s);
}

void Film::sample(const Scene& scene, const Minds& minds, const std::vector<PictureLabel>& labels) {
  trails_.sample(scene);
  while (error_.empty() && time_of(frame_) <= scene.now()) {
    draw(time_of(frame_), scene, minds, labels);
    if (!error_.empty()) return;
    feed_->add(canvas_->pixels(), canvas_->stride_px(), canvas_->height_px());
    error_ = feed_->error();
    ++frame_;
  }
}

void Film::draw(Clicks at, const Scene& scene, const Minds& minds, const std::vector<PictureLabel>& labels) {
  cairo_t* cr = canvas_->cr();
  const double width = canvas_->width_px(), height = canvas_->height_px();
  // The map, from the floor up.
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
  {
    MapPainter map(cr, *place_, scene, at);
    cairo_set_antialias(cr, CAIRO_ANTIALIAS_FAST);  // nobody sees the difference in a film
    map.floor();
    map.ramps();
    map.trails(trails_);
    map.solids();
    if (options_.sensor_rays) map.rays();
    map.robots(minds);
    map.lamps();
  }
  // a robot that leaves the map must not write over the texts
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_rectangle(cr, 0, 0, width, kHeadPx - 2);
  cairo_rectangle(cr, 0, place_->top_px + place_->height_px() + 2, width, height);
  cairo_fill(cr);
  draw_names(cr, *place_, scene, at, 12, width);

  // The texts: time at the right, title at the left, scale and legend below.
  const std::string time = options_.speed == 1
                               ? fmt::format("{:.2f} s", to_seconds(at))
                               : fmt::format("{:.2f} s  x{:g}", to_seconds(at), options_.speed);
  const double time_width = text_width_px(cr, time, kTimePx, true);
  cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
  draw_text(cr, time, width - kFilmMarginPx - time_width, 20, kTimePx, true);
  // as much of the title as there is room for
  std::string title = scene.world().title;
  const double room = width - 3 * kFilmMarginPx - std::max(time_width, 110.0);
  if (text_width_px(cr, title, kTimePx) > room) {
    while (!title.empty() && text_width_px(cr, title + "...", kTimePx) > room) {
      do title.pop_back();
      while (!title.empty() && (title.back() & 0xC0) == 0x80);
    }
    if (!title.empty() && (title.back() & 0x80)) title.pop_back();  // what is left of a character
    title += "...";
  }
  cairo_set_source_rgb(cr, 0.35, 0.35, 0.35);
  draw_text(cr, title, kFilmMarginPx, 20, kTimePx);
  const double foot_y = place_->top_px + place_->height_px() + 16;
  draw_scale_bar(cr, *place_, kFilmMarginPx, foot_y);
  legend_->draw(cr, kFilmMarginPx + kScaleBarRoomPx, foot_y);
  draw_labels(cr, labels, width, height);
  if (!canvas_->error().empty()) error_ = "film: " + canvas_->error();
}

void Film::finish() {
  if (!feed_ || !error_.empty()) return;
  feed_->finish();
  error_ = feed_->error();
}

}  // namespace sim
