// SPDX-License-Identifier: MIT
// Draws a world seen from above at one instant: floor, ramps, walls, objects, lamps, robots, ways, rays.
// North is up. Everything is drawn in metres through one transform; widths of lines are pixels, converted.
#pragma once
#include <cairo.h>

#include "sim_core/base/clock.h"
#include "sim_core/record/trajectories.h"
#include "sim_core/world/robot_mind.h"
#include "sim_core/world/scene.h"

namespace sim {

/// Where the map lies on the canvas.
struct MapPlace {
  Vec2 low_m, high_m;  ///< the part of the world that is shown
  double px_per_m = 1;
  double left_px = 0, top_px = 0;
  double width_px() const { return (high_m.x - low_m.x) * px_per_m; }
  double height_px() const { return (high_m.y - low_m.y) * px_per_m; }
  Vec2 to_px(Vec2 m) const {
    return {left_px + (m.x - low_m.x) * px_per_m, top_px + (high_m.y - m.y) * px_per_m};
  }
};

/// Colours of rays, as Webots shows them. [Webots B2]
inline constexpr Colour kRayHit{0.85, 0.08, 0.08}, kRayLonger{1.0, 0.55, 0.0}, kRayFree{0.10, 0.62, 0.20};

/// Ten colours that differ in hue and in brightness (Tableau 10), one per robot, over and over.
const Colour& way_colour(int robot);

class MapPainter {
 public:
  /// Poses are those at `at`, which may lie up to 40 ms before the scene's last tick. Sets the transform; the
  /// destructor puts it back.
  MapPainter(cairo_t* cr, const MapPlace& place, const Scene& scene, Clicks at);
  ~MapPainter();
  MapPainter(const MapPainter&) = delete;
  MapPainter& operator=(const MapPainter&) = delete;

  void floor();
  /// The higher the darker, contour lines every centimetre, an arrow uphill.
  void ramps();
  void ways(const Trajectories& trajectories);
  /// Older parts fade away.
  void trails(const Trails& trails);
  /// Walls and objects; things that hang in the air let through what is under them.
  void solids();
  /// Of every proximity sensor, up to its greatest distance: red to what it met, orange as much farther as a
  /// dark colour lets it seem, green beyond.
  void rays();
  /// Body, wheels, an arrow that points ahead, the LEDs.
  void robots(const Minds& minds);
  void lamps();
  /// A square of side `side_m` around a middle, without an edge.
  void cell(Vec2 middle_m, double side_m, const Colour& colour);

 private:
  void pen(double px) { cairo_set_line_width(cr_, px / place_.px_per_m); }
  void ink(const Colour& c, double alpha = 1) { cairo_set_source_rgba(cr_, c.r, c.g, c.b, alpha); }
  void line(Vec2 a, Vec2 b);
  void disc(Vec2 at, double radius_m);
  void floor_image(Vec2 low, Vec2 high);
  void solid(const Placed& p, const Surface& s, bool loose);
  void outline(const Placed& p);
  void leds(const RobotModel& model, const Frame2& frame, std::uint32_t lit);

  cairo_t* cr_;
  const MapPlace place_;
  const Scene& scene_;
  const Clicks at_;
};

}  // namespace sim
