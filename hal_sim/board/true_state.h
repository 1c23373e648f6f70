// SPDX-License-Identifier: MIT
// What a robot truly does, for the devices that tell the truth to programs written for Webots' interfaces
// (GPS, compass, inertial unit, gyroscope). No e-puck has them.
#pragma once
#include <string>

#include "hal_sim/board/cycle.h"
#include "sim_core/world/world_desc.h"

namespace board {

class Board;

/// In the axes that the world file chose ([webots] axes).
struct TrueState {
  sim::Vec3 position_m;    ///< of the robot's middle on the floor
  sim::Vec3 velocity_m_s;  ///< of the last tick
  sim::Vec3 north;         ///< unit, in the robot's axes
  sim::Vec3 attitude_rad;  ///< roll, pitch, yaw; 0, 0, 0 is level along the world's x (enu) or -z (nue)
  sim::Vec3 rates_rad_s;   ///< in the robot's axes
};

/// At `at`; all zero where there is no world.
TrueState true_state(const Board& board, Cycle at);

/// Number of the robot or object, movable or fixed, with that def or name; -1: there is none.
int find_body(const Board& board, const std::string& name);
/// Where it is, in the world file's axes: a robot's middle on the floor, an object's middle; the angle about
/// the upward axis, 0 as above, rad, not wrapped.
void true_pose(const Board& board, int body, Cycle at, sim::Vec3& position_m, double& angle_rad);

}  // namespace board
