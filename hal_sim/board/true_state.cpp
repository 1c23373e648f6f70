// SPDX-License-Identifier: MIT
#include "hal_sim/board/true_state.h"

#include <cmath>

#include "hal_sim/board/board.h"
#include "sim_core/world/scene.h"
#include "sim_core/world/true_motion.h"

namespace board {

namespace {

/// Forward, left, up to right, up, backward.
sim::Vec3 to_nue_robot(const sim::Vec3& v) { return {-v.y, v.z, -v.x}; }

}  // namespace

TrueState true_state(const Board& board, Cycle at) {
  TrueState out;
  const sim::Scene* scene = board.scene();
  if (!scene) return out;
  const int robot = board.setup().robot;
  const sim::Pose2 pose = scene->pose(robot, board.clock().click_at(at));
  const sim::Stance stance = sim::stance(*scene, robot, scene->now());
  const sim::BodyState& state = scene->state(robot);
  const bool nue = board.setup().webots.axes == sim::Axes::Nue;
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

int find_body(const Board& board, const std::string& name) {
  const sim::Scene* scene = board.scene();
  if (!scene || name.empty()) return -1;
  const sim::WorldDesc& world = scene->world();
  const auto& loose = scene->layout().loose_object;
  // a def is meant for this; names come second
  for (const bool by_def : {true, false}) {
    for (int r = 0; r < scene->robots(); ++r) {
      const sim::RobotDesc& robot = world.robots[static_cast<std::size_t>(r)];
      if ((by_def ? robot.def : robot.name) == name) return r;
    }
    for (std::size_t i = 0; i < loose.size(); ++i) {
      const sim::ObjectDesc& object = world.objects[static_cast<std::size_t>(loose[i])];
      if ((by_def ? object.def : object.name) == name) return scene->robots() + static_cast<int>(i);
    }
    // objects that nobody can move have no body; they are numbered behind the bodies
    for (std::size_t o = 0; o < world.objects.size(); ++o) {
      const sim::ObjectDesc& object = world.objects[o];
      if (!object.movable && (by_def ? object.def : object.name) == name)
        return scene->bodies() + static_cast<int>(o);
    }
  }
  return -1;
}

void true_pose(const Board& board, int body, Cycle at, sim::Vec3& position_m, double& angle_rad) {
  const sim::Scene* scene = board.scene();
  if (!scene || body < 0) return;
  const std::vector<sim::ObjectDesc>& objects = scene->world().objects;
  const std::size_t fixed = static_cast<std::size_t>(body - scene->bodies());
  const bool is_fixed = body >= scene->bodies();
  if (is_fixed && fixed >= objects.size()) return;
  const bool nue = board.setup().webots.axes == sim::Axes::Nue;
  const sim::Pose2 pose = is_fixed ? objects[fixed].pose : scene->pose(body, board.clock().click_at(at));
  position_m = {pose.x_m, pose.y_m, is_fixed ? objects[fixed].z_m : scene->state(body).z_m};
  // Webots places solids by their middle
  if (is_fixed)
    position_m.z += objects[fixed].size_m.z / 2;
  else if (body >= scene->robots())
    position_m.z +=
        objects[static_cast<std::size_t>(
                    scene->layout().loose_object[static_cast<std::size_t>(body - scene->robots())])]
            .size_m.z /
        2;
  if (nue) position_m = sim::to_nue(position_m);
  angle_rad = nue ? sim::angle_to_nue(pose.heading_rad) : pose.heading_rad;
}

}  // namespace board
