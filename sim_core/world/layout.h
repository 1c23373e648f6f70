// SPDX-License-Identifier: MIT
// A world's description turned into solids at their places: what rays, physics, overlap checks
// and pictures share.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "sim_core/geometry/ground.h"
#include "sim_core/geometry/solid.h"
#include "sim_core/world/world_desc.h"

namespace sim {

/// How one solid looks.
struct Surface {
  Colour colour;
  double ir_reflectance = 1;  ///< 0 to 1, what the colour rule calls red
  double roughness = 0;
  double friction = 0.3;
  double restitution = 0;
};

Surface surface_of(const Material& material);
/// Look of the floor at a point; the image's pixel where there is one.
Surface floor_at(const WorldDesc& world, Vec2 point_m);

/// Everything solid. Fixed ones first come from the arena, then walls, then objects in order.
struct Layout {
  std::deque<Solid> solids;  ///< owns the shapes; a deque, so pointers stay good
  std::vector<Placed> fixed;
  std::vector<Surface> fixed_surface;
  std::vector<std::string> fixed_name;  ///< for messages: "arena wall 2", "box 'crate'"
  std::vector<int> fixed_line;          ///< line of the world file; 0 unknown
  std::vector<Placed> moving;           ///< robots, then movable objects, at their start
  std::vector<Pose2> moving_pose;
  std::vector<Surface> moving_surface;
  std::vector<std::string> moving_name;
  Ground ground;                  ///< what everything stands on
  std::vector<int> loose_object;  ///< per movable object: index into WorldDesc::objects
  Vec2 low_m, high_m;             ///< what a picture should show: all solids, or 1 m around nothing
};

/// A robot touches the ground with its wheels and, before and behind, with its underside this far out, as a
/// part of its radius. [assumed: the lowest parts of a round body lie within its rim]
inline constexpr double kFootingShare = 0.8;
/// Ground under a robot at a pose.
Footing robot_footing(const Ground& ground, const RobotModel& model, const Pose2& pose);

/// The world must be consistent (models known, sizes positive): load/ has seen to that, or
/// a test built it so.
Layout build_layout(const WorldDesc& world);

}  // namespace sim
