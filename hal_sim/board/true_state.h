// SPDX-License-Identifier: MIT
// What a robot truly does, for the devices that tell the truth to programs written for Webots' interfaces
// (GPS, compass, inertial unit, gyroscope). No e-puck has them.
#pragma once
#include "hal_sim/board/cycle.h"
#include "sim_core/world/device_desc.h"

namespace board {

class Specimen;

/// In the axes that the world file chose ([webots] axes).
struct TrueState {
  sim::Vec3 position_m;    ///< of the robot's middle on the floor
  sim::Vec3 velocity_m_s;  ///< of the last tick
  sim::Vec3 north;         ///< unit, in the robot's axes
  sim::Vec3 attitude_rad;  ///< roll, pitch, yaw; 0, 0, 0 is level along the world's x (enu) or -z (nue)
  sim::Vec3 rates_rad_s;   ///< in the robot's axes
};

/// At `at`; all zero where there is no world.
TrueState true_state(const Specimen& robot, Cycle at);

}  // namespace board
