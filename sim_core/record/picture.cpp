// SPDX-License-Identifier: MIT
#include "sim_core/record/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim_core/record/canvas.h"
#include "sim_core/record/map_frame.h"

namespace sim {
namespace {

constexpr double kFootPx = 64;
constexpr int kMostLegend = 8;  // robots named in the legend

Legend legend_of(const Scene& scene, bool ways, bool rays) {
  Legend legend;
  if (ways) {
    legend.add("start", [](cairo_t* cr, double x, double y) {
      cairo_arc(cr, x + 10, y, 4, 0, 2 * kPi);
      cairo_set_source_rgb(cr, 0.3, 0.3, 0.3);
      cairo_set_line_width(cr, 2);
      cairo_stroke(cr);
    });
  }
  if (rays) add_ray_legend(legend);
  for (int r = 0; r < std::min(scene.robots(), kMostLegend); ++r) {
    const RobotDesc& robot = scene.world().robots[static_cast<std::size_t>(r)];
    legend.add_line(robot.firmware.empty() ? robot.name : robot.name + " (" + robot.firmware + ")",
                    way_colour(r), 3);
  }
  return legend;
}

}  // namespace

std::string write_picture(const std::string& path, const Scene& scene, const Minds& minds,
                          const Trajectories* trajectories, const PictureOptions& options) {
  if (!ends_with(path, ".svg") && !ends_with(path, ".png"))
    return fmt::format("{}: picture: got the ending '{}', expected .png or .svg", path,
                       std::filesystem::path(path).extension().string());
  MapPlace place = place_map(scene, options.width_px);
  place.left_px = kMarginPx;
  place.top_px = kTitlePx;
  const double width = std::max(kNarrowestPx, std::ceil(place.width_px() + 2 * kMarginPx));
  Legend legend = legend_of(scene, trajectories, options.sensor_rays);
  const int rows = legend.arrange(width - 2 * kMarginPx - kScaleBarRoomPx);
  const double foot_y = kTitlePx + place.height_px() + kFootPx - 26;
  const double height =
      std::ceil(kTitlePx + place.height_px() + kFootPx + std::max(0, rows - 2) * Legend::kRowPx);
  return write_drawing(path, width, height, [&](cairo_t* cr) {
    {
      MapPainter map(cr, place, scene, scene.now());
      map.floor();
      map.ramps();
      if (trajectories) map.ways(*trajectories);
      map.solids();
      if (options.sensor_rays) map.rays();
      map.robots(minds);
      map.lamps();
    }
    if (options.names) draw_names(cr, place, scene, scene.now(), 13, width);
    const std::string caption = options.caption.empty()
                                    ? fmt::format("{:.2f} s, {} robot{}", to_seconds(scene.now()),
                                                  scene.robots(), scene.robots() == 1 ? "" : "s")
                                    : options.caption;
    draw_title(cr, scene, caption, kMarginPx);
    draw_scale_bar(cr, place, kMarginPx, foot_y);
    legend.draw(cr, kMarginPx + kScaleBarRoomPx, foot_y - 2);
    draw_labels(cr, options.labels, width, height);
  });
}

}  // namespace sim
