// SPDX-License-Identifier: MIT
// What stands, lies and shines in a world, and what it is made of.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim_core/geometry/pose.h"
#include "sim_core/world/robot_model.h"

namespace sim {

/// How surfaces look to light.
struct Material {
  std::string name;
  Colour colour;               ///< default white
  double ir_reflectance = -1;  ///< 0 to 1; negative: the red part of the colour
  double roughness = 0;        ///< 0 to 1
  double friction = 0.3;       ///< Coulomb coefficient of the sides
  double restitution = 0;      ///< 0 to 1
};

enum class ObjectKind { Box, Cylinder, Ball, Polygon };

/// Anything that stands, lies or falls in the arena.
struct ObjectDesc {
  ObjectKind kind = ObjectKind::Box;
  std::string name;
  std::string def;              ///< second name, by which supervisors may look it up; may be empty
  Vec3 size_m{0.1, 0.1, 0.1};   ///< box: x, y, z; otherwise only z counts (height)
  double radius_m = 0.05;       ///< cylinder and ball
  std::vector<Vec2> corners_m;  ///< polygon, in its own frame
  Pose2 pose;
  double z_m = 0;  ///< underside above the floor; movable ones fall from there
  bool movable = false;
  double mass_kg = 0.1;
  double floor_friction = 0.5;  ///< of movable ones, against whatever they stand on; balls roll instead
  /// Of a ball: what slows it as it rolls, as a part of its weight. [assumed: hard ball on a table, 0.005 to
  /// 0.03]
  double rolling_friction = 0.02;
  Material material;
  std::string model;                        ///< what cameras that recognise call it
  std::vector<Colour> recognition_colours;  ///< ... and its colours; empty: they do not notice it
  int node = 0;                             ///< line of its node in WebotsDesc::world; 0: none
  int line = 0;
};

/// A polyline of walls.
struct WallDesc {
  std::vector<Vec2> points_m;
  bool closed = false;
  double thickness_m = 0.01;
  double height_m = 0.1;
  double z_m = 0;
  Material material;
  int line = 0;
};

struct ArenaDesc {
  Vec2 size_m{1, 1};  ///< inside measures
  Vec2 centre_m;
  double wall_height_m = 0.1;
  double wall_thickness_m = 0.01;
  Material material;
};

struct FloorDesc {
  Colour colour{0.93, 0.93, 0.90};
  double ir_reflectance = -1;
  std::string image;    ///< PNG over the whole arena, as written; empty: plain
  int image_width = 0;  ///< pixels, once the file is read
  int image_height = 0;
  std::vector<std::uint8_t> image_rgb;  ///< rows from the north, three bytes a pixel
  double friction = 1.0;                ///< factor on the traction of wheels
  double tilt_x_rad = 0;                ///< the x axis rises above the horizontal by this angle
  double tilt_y_rad = 0;                ///< same for the y axis
};

/// A slope on the floor, or a platform when both ends are equally high.
struct RampDesc {
  std::string name;
  Pose2 pose;             ///< of its middle; heading uphill
  Vec2 size_m{0.2, 0.2};  ///< in plan, along the heading and across
  double low_m = 0;       ///< height of its low end
  double high_m = 0;      ///< height of its high end
  Material material;
  int line = 0;
};

struct LampDesc {
  std::string name;
  Vec3 position_m{0, 0, 1};
  double intensity_w_m2 = 1;                   ///< at a distance where the attenuation is 1
  std::array<double, 3> attenuation{1, 0, 0};  ///< a0 + a1 d + a2 d2 divides the intensity; d in m
  Colour colour;
  bool on = true;
  int node = 0;  ///< line of its node in WebotsDesc::world; 0: none
};

/// What cameras see where nothing stands, and the light that is everywhere for them.
struct SkyDesc {
  Colour colour{0.72, 0.80, 0.90};
  double light_w_m2 = 1.0;  ///< on the floor; proximity sensors do not see it
};

}  // namespace sim
