// SPDX-License-Identifier: MIT
#include "sim_core/record/heatmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "sim_core/record/canvas.h"
#include "sim_core/record/map_frame.h"

namespace sim {
namespace {

constexpr double kHeatmapFootPx = 66;
constexpr double kBarPx = 220;     // length of the colour bar
constexpr double kDecades = 1e-3;  // of the top of the scale: what is less has the lowest colour

/// Eleven even steps of viridis (public domain, S. van der Walt and N. Smith).
constexpr std::uint32_t kViridis[] = {0x440154, 0x482475, 0x414487, 0x355f8d, 0x2a788e, 0x21918c,
                                      0x22a884, 0x44bf70, 0x7ad151, 0xbddf26, 0xfde725};

/// What the colours stand for.
struct HeatScale {
  bool linear;
  double low = kDecades, high = 1;  // shares; low: of the logarithmic scale
  HeatScale(const Heatmap& heatmap, bool linear_) : linear(linear_) {
    std::int64_t most = 0, least = 0;
    for (const Heatmap::Cell& c : heatmap.cells()) {
      most = std::max(most, c.ticks);
      least = least ? std::min(least, c.ticks) : c.ticks;
    }
    if (!most) return;
    const double all = static_cast<double>(heatmap.total_ticks());
    high = static_cast<double>(most) / all;
    if (linear) return;
    // up to the next 1, 2 or 5 times a power of ten; at least one order of magnitude
    double top = high;
    const double decade = std::pow(10, std::floor(std::log10(high) + 1e-9));
    for (double round : {10.0, 5.0, 2.0, 1.0})
      if (high <= round * decade * (1 + 1e-9)) top = round * decade;
    high = top;
    low = std::max(static_cast<double>(least) / all, kDecades * high);
    low = std::min(low, high / 10);
  }
  double part(double share) const {
    return linear ? share / high : std::log(std::max(share, low) / low) / std::log(high / low);
  }
};

void colour_bar(cairo_t* cr, const HeatScale& scale, const std::string& meaning, double x, double y) {
  constexpr int kSteps = 110;
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
  for (int i = 0; i < kSteps; ++i) {
    const Colour c = heat_colour((i + 0.5) / kSteps);
    cairo_set_source_rgb(cr, c.r, c.g, c.b);
    cairo_rectangle(cr, x + kBarPx * i / kSteps, y - 12, kBarPx / kSteps + 0.5, 12);
    cairo_fill(cr);
  }
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_DEFAULT);
  cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
  const auto tick = [&](double share) {
    const double at = x + kBarPx * scale.part(share);
    cairo_set_line_width(cr, 1);
    cairo_move_to(cr, at, y);
    cairo_rel_line_to(cr, 0, 4);
    cairo_stroke(cr);
    const std::string text = fmt::format("{:.3g} %", 100 * share);
    draw_text(cr, text, at - 0.5 * text_width_px(cr, text, 11), y + 16, 11);
  };
  if (scale.linear) {
    for (double part : {0.0, 0.5, 1.0}) tick(part * scale.high);
  } else {
    tick(scale.high);
    // powers of ten below it that leave room for its number
    for (double share = std::pow(10, std::floor(std::log10(scale.high) + 1e-9)); share >= 0.999 * scale.low;
         share /= 10)
      if (kBarPx * (1 - scale.part(share)) > 44) tick(share);
  }
  draw_text(cr, meaning, x + kBarPx + 34, y, 13);
}

std::string write_csv(const std::string& path, const Heatmap& heatmap, double tick_s) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << "x_m,y_m,time_s,share\n";
  for (const Heatmap::Cell& c : heatmap.cells()) {
    out << fmt::format("{:.6g},{:.6g},{:.6f},{:.9f}\n", (c.column + 0.5) * heatmap.cell_m(),
                       (c.row + 0.5) * heatmap.cell_m(), static_cast<double>(c.ticks) * tick_s,
                       static_cast<double>(c.ticks) / static_cast<double>(heatmap.total_ticks()));
  }
  out.close();
  return out ? std::string()
             : fmt::format("{}: cannot be written: {}", path, std::strerror(errno ? errno : EIO));
}

}  // namespace

Heatmap::Heatmap(int robots, double cell_m) : cell_m_(cell_m), stays_(static_cast<std::size_t>(robots)) {}

void Heatmap::sample(const Scene& scene) {
  const auto cell = [&](double m) {
    return static_cast<int>(std::clamp(std::floor(m / cell_m_), -2e9, 2e9));
  };
  for (std::size_t r = 0; r < stays_.size(); ++r) {
    const Pose2& p = scene.state(static_cast<int>(r)).pose;
    const Place place{cell(p.y_m), cell(p.x_m)};
    Stay& stay = stays_[r];
    if (place != stay.place && stay.ticks) {
      ticks_[stay.place] += stay.ticks;
      stay.ticks = 0;
    }
    stay.place = place;
    ++stay.ticks;
    ++total_;
  }
}

std::vector<Heatmap::Cell> Heatmap::cells() const {
  std::map<Place, std::int64_t> all = ticks_;
  for (const Stay& stay : stays_)
    if (stay.ticks) all[stay.place] += stay.ticks;
  std::vector<Cell> cells;
  for (const auto& [place, ticks] : all) cells.push_back({place.second, place.first, ticks});
  return cells;
}

Colour heat_colour(double part) {
  constexpr int kSteps = static_cast<int>(std::size(kViridis)) - 1;
  const double at = std::clamp(part, 0.0, 1.0) * kSteps;
  const int i = std::min(static_cast<int>(at), kSteps - 1);
  const auto channel = [&](int shift) {
    const double a = kViridis[i] >> shift & 255, b = kViridis[i + 1] >> shift & 255;
    return (a + (b - a) * (at - i)) / 255;
  };
  return {channel(16), channel(8), channel(0)};
}

std::string write_heatmap(const std::string& path, const Heatmap& heatmap, const Scene& scene,
                          const HeatmapOptions& options) {
  if (ends_with(path, ".csv")) return write_csv(path, heatmap, scene.tick_s());
  if (!ends_with(path, ".svg") && !ends_with(path, ".png"))
    return fmt::format("{}: heat map: got the ending '{}', expected .png, .svg or .csv", path,
                       std::filesystem::path(path).extension().string());
  const std::vector<Heatmap::Cell> cells = heatmap.cells();
  const double side = heatmap.cell_m();
  MapPlace place = place_map(scene, options.width_px);
  // robots may have left what the world shows
  for (const Heatmap::Cell& c : cells) {
    const Vec2 low{c.column * side, c.row * side};
    place.low_m = {std::min(place.low_m.x, low.x), std::min(place.low_m.y, low.y)};
    place.high_m = {std::max(place.high_m.x, low.x + side), std::max(place.high_m.y, low.y + side)};
  }
  const Vec2 span = place.high_m - place.low_m;
  place.px_per_m = options.width_px / std::max(span.x, span.y);
  place.left_px = kMarginPx;
  place.top_px = kTitlePx;
  const double width = std::max(kNarrowestPx, std::ceil(place.width_px() + 2 * kMarginPx));
  const double height = std::ceil(kTitlePx + place.height_px() + kHeatmapFootPx);
  const HeatScale scale(heatmap, options.linear);
  return write_drawing(path, width, height, [&](cairo_t* cr) {
    {
      MapPainter map(cr, place, scene, scene.now());
      map.floor();
      map.ramps();
      cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);  // no seams between cells
      for (const Heatmap::Cell& c : cells) {
        const double share = static_cast<double>(c.ticks) / static_cast<double>(heatmap.total_ticks());
        map.cell({(c.column + 0.5) * side, (c.row + 0.5) * side}, side, heat_colour(scale.part(share)));
      }
      cairo_set_antialias(cr, CAIRO_ANTIALIAS_DEFAULT);
      map.solids();
      map.lamps();
    }
    draw_title(cr, scene, options.caption, kMarginPx);
    const double foot_y = kTitlePx + place.height_px() + kHeatmapFootPx - 30;
    draw_scale_bar(cr, place, kMarginPx, foot_y);
    colour_bar(cr, scale, fmt::format("of all robots' time, in a cell of {:g} cm", 100 * side),
               kMarginPx + kScaleBarRoomPx + 20, foot_y);
  });
}

}  // namespace sim
