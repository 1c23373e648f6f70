// SPDX-License-Identifier: MIT
// What programs for Webots' interfaces find: devices, and how the world is told to them.
#pragma once
#include <string>
#include <vector>

#include "sim_core/geometry/axes.h"
#include "sim_core/geometry/pose.h"
#include "sim_core/world/proximity_desc.h"

namespace sim {

/// Motor to Pen, and Position, are there for a program, and do and sense nothing.
enum class DeviceKind {
  Gps,
  Compass,
  Inertial,
  Gyro,
  Emitter,
  Receiver,
  Distance,
  Display,
  Motor,
  Camera,
  Touch,
  Light,
  Led,
  Speaker,
  Pen,
  Lidar,
  RangeFinder,
  Position
};

/// A device that programs written for Webots' interfaces find on a robot, or a supervisor, by its name.
struct DeviceDesc {
  std::string name;
  DeviceKind kind = DeviceKind::Gps;
  int channel = 1;              ///< of emitters and receivers; -1: all
  double range_m = -1;          ///< of emitters; negative: unlimited
  double baud_rate_bit_s = -1;  ///< of emitters; negative: unlimited
  bool infra_red = false;       ///< of emitters: a free line of sight is needed
  int width = 128;              ///< of displays and cameras, pixels
  int height = 64;              ///< likewise
  Vec3 at_m;  ///< of what measures distances: from the robot's middle on the floor: ahead, left, up
  double heading_rad = 0;           ///< likewise, from ahead to the left
  double fov_rad = kPi / 2;         ///< of lidars and range finders: from the left to the right edge
  double vertical_fov_rad = 0.2;    ///< of lidars of several rows
  double near_m = 0.01, far_m = 1;  ///< likewise: what is nearer or farther is not there
  std::vector<ResponseRow> table;   ///< of distance sensors; empty: a supervisor sets the value
  int rays = 1;                     ///< of distance sensors
  double aperture_rad = kPi / 2;    ///< likewise
  int line = 0;                     ///< line in the world file; 0 when built in C++
};

/// What programs written for Webots' interfaces find; the robots' own library does not look at it.
struct WebotsDesc {
  double time_step_s = 0.032;    ///< basic time step of the world [Webots: WorldInfo.basicTimeStep]
  double speed_unit_rad_s = -1;  ///< rad/s per unit of differential_wheels_set_speed; negative: the usual one
  std::string sensor_order;      ///< how proximity and light sensors are numbered, a name the caller knows
  Axes axes = Axes::Enu;         ///< of positions and rotations that programs are told
  std::string world;   ///< the .wbt file this world was made of, whose nodes supervisors find; or empty
  double floor_m = 0;  ///< how high the floor lies in that file
};

}  // namespace sim
