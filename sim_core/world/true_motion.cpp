// SPDX-License-Identifier: MIT
#include "sim_core/world/true_motion.h"

#include <algorithm>
#include <cmath>

#include "sim_core/world/scene.h"

namespace sim {

namespace {

constexpr double kLyingM = 0.001;  // a loose object this near to the ground lies on it

const RobotModel& model_of(const Scene& scene, int robot) {
  const WorldDesc& world = scene.world();
  return *world.model_of(world.robots[static_cast<std::size_t>(robot)]);
}

Footing footing_at(const Scene& scene, int body, const Pose2& pose) {
  const Ground& ground = scene.layout().ground;
  if (body < scene.robots()) return robot_footing(ground, model_of(scene, body), pose);
  // a loose object: as the engines tilt it; in the air and on other things it stands upright
  const double base = 0.5 * scene.layout().moving[static_cast<std::size_t>(body)].solid->bound_m;
  const double z = scene.state(body).z_m;
  const Footing under = ground.has_ramps() ? ground.footing(pose, base, base) : Footing{};
  return std::fabs(z - ground.height_m({pose.x_m, pose.y_m})) < kLyingM ? Footing{z, under.slope}
                                                                        : Footing{z, {}};
}

Vec3 place(const Pose2& pose, const Footing& under) { return {pose.x_m, pose.y_m, under.height_m}; }

Vec3 place(const Scene& scene, int robot, Clicks at) {
  const Pose2 pose = scene.pose_on_way(robot, at);
  return place(pose, footing_at(scene, robot, pose));
}

BodyAxes axes_at(const Scene& scene, int robot, Clicks at) {
  const Pose2 pose = scene.pose_on_way(robot, at);
  return axes_on(footing_at(scene, robot, pose).slope, pose.heading_rad);
}

constexpr Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

}  // namespace

Stance stance(const Scene& scene, int body, Clicks at) {
  const Pose2 pose = scene.pose(body, at);
  const Footing under = footing_at(scene, body, pose);
  Stance s;
  s.axes = axes_on(under.slope, pose.heading_rad);
  s.origin_m = {pose.x_m, pose.y_m, under.height_m};
  const Vec3& down = scene.layout().ground.down();
  s.pitch_rad = std::asin(std::clamp(-dot(s.axes.forward, down), -1.0, 1.0));
  s.roll_rad = std::asin(std::clamp(-dot(s.axes.left, down), -1.0, 1.0));
  return s;
}

Clicks motion_lag(const Scene& scene) { return scene.tick_clicks(); }

Vec3 specific_force_m_s2(const Scene& scene, int robot, Clicks at) {
  const Clicks tick = scene.tick_clicks();
  const Clicks window = std::max(tick, from_seconds(model_of(scene, robot).shock_s));
  // speeds are constant within a tick: the way of a whole tick gives a speed that changes evenly
  const Pose2 pose = scene.pose_on_way(robot, at);
  const Footing under = footing_at(scene, robot, pose);
  const Vec3 way = minus(place(pose, under), place(scene, robot, at - tick));
  const Vec3 before = minus(place(scene, robot, at - window), place(scene, robot, at - window - tick));
  const double per = 1 / (to_seconds(tick) * to_seconds(window));
  const Vec3& down = scene.layout().ground.down();
  const double g = scene.world().gravity_m_s2;
  const Vec3 f{(way.x - before.x) * per - g * down.x, (way.y - before.y) * per - g * down.y,
               (way.z - before.z) * per - g * down.z};
  const BodyAxes axes = axes_on(under.slope, pose.heading_rad);
  return {dot(f, axes.forward), dot(f, axes.left), dot(f, axes.up)};
}

Vec3 angular_rate_rad_s(const Scene& scene, int robot, Clicks at) {
  const BodyAxes a = axes_at(scene, robot, at - scene.tick_clicks());
  const BodyAxes b = axes_at(scene, robot, at);
  // half the skew part of the turn between them: axis times the sine of the angle
  Vec3 turn{0.5 * (dot(a.up, b.left) - dot(a.left, b.up)),
            0.5 * (dot(a.forward, b.up) - dot(a.up, b.forward)),
            0.5 * (dot(a.left, b.forward) - dot(a.forward, b.left))};
  const double sine = std::sqrt(dot(turn, turn));
  const double k = (sine > 1e-6 ? std::asin(std::min(1.0, sine)) / sine : 1.0) / scene.tick_s();
  return {k * turn.x, k * turn.y, k * turn.z};
}

}  // namespace sim
