// SPDX-License-Identifier: MIT
#include "hal_sim/board/true_state.h"

#include <cmath>

#include "hal_sim/board/specimen.h"
#include "sim_core/world/scene.h"
#include "sim_core/world/true_motion.h"

namespace board {

namespace {

/// Forward, left, up to right, up, backward.
sim::Vec3 to_nue_robot(const sim::Vec3& v) { return {-v.y, v.z, -v.x}; }

}  // namespace

TrueState true_state(const Specimen& specimen, Cycle at) {
  TrueState out;
  const sim::Scene* scene = specimen.scene();
  if (!scene) return out;
  const int robot = specimen.setup().robot;
  const sim::Pose2 pose = scene->pose(robot, specimen.clock().click_at(at));
  const sim::Stance stance = sim::stance(*scene, robot, scene->now());
  const sim::BodyState& state = scene->state(robot);
  const bool nue = specimen.setup().webots.axes == sim::Axes::Nue;
  const sim::Frame2 frame(pose);
  out.position_m = {pose.x_m, pose.y_m, stance.origin_m.z};
  out.velocity_m_s = {state.velocity_m_s.x, state.velocity_m_s.y, 0};
  const sim::Vec2 north = frame.turn_back(nue ? sim::Vec2{1, 0} : sim::Vec2{0, 1});
  out.north = {north.x, north.y, 0};
  out.rates_rad_s = sim::angular_rate_rad_s(*scene, robot, scene->now());
  const double heading_rad = nue ? sim::angle_to_nue(pose.heading_rad) : pose.heading_rad;
  // our roll lifts the left side and our pitch the nose; about the forward axis that is positive, about the
  // left one negative
  out.attitude_rad = {stance.roll_rad, nue ? stance.pitch_rad : -stance.pitch_rad,
                      std::remainder(heading_rad, 2 * sim::kPi)};
  if (nue) {
    out.position_m = sim::to_nue(out.position_m);
    out.velocity_m_s = sim::to_nue(out.velocity_m_s);
    out.north = to_nue_robot(out.north);
    out.rates_rad_s = to_nue_robot(out.rates_rad_s);
  }
  return out;
}

}  // namespace board
