// SPDX-License-Identifier: MIT
// Geometry nodes in, upright pieces out: what our worlds can hold of a shape in space. Metres, z up.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "import/affine.h"
#include "import/wbt_node.h"
#include "sim_core/world/world_desc.h"

namespace wbt {

struct Surface {
  sim::Colour colour;    ///< white where nothing is said
  double roughness = 0;  ///< 0 to 1; carried for the newer colour rule only
};

struct Piece {
  sim::ObjectKind kind = sim::ObjectKind::Box;
  Vec2 at;  ///< its middle; of a polygon the origin of its corners
  double heading_rad = 0;
  Vec2 size;                  ///< box, in plan
  double radius_m = 0;        ///< cylinder and ball
  std::vector<Vec2> corners;  ///< polygon, counter-clockwise around `at`, not turned
  double z_low = 0;
  double z_high = 0;
  double volume_m3 = 0;               ///< of the shape as Webots has it
  std::string approximation;          ///< how it differs from the node; empty: not at all
  std::optional<sim::RampDesc> ramp;  ///< the same as a slope, where that is possible
  bool endless_floor = false;         ///< a Plane
  Surface surface;
  int line = 0;

  /// Corners of its outline in the world.
  std::vector<Vec2> outline() const;
  /// Area of its outline.
  double area() const;
  /// Whether the point lies in its outline.
  bool covers(Vec2 p) const;
};

/// True for Box, Sphere and all others that pieces_of() understands or names.
bool is_geometry(const std::string& type);

/// What a geometry node makes where `frame` puts it. `z_up`: cylinders and planes stand on z (R2022 on), not
/// on y. `why`: set when nothing comes of it.
std::vector<Piece> pieces_of(const Node& geometry, const Affine& frame, bool z_up, std::string& why);

/// A piece around points: their convex hull seen from above. Empty when they do not span anything.
std::optional<Piece> hull_piece(const std::vector<Vec3>& points);

}  // namespace wbt
