// SPDX-License-Identifier: MIT
// How a robot's body truly lies and moves: attitude, specific force and angular rates at any instant of the
// pose history, for accelerometers and gyroscopes. In: the frozen scene. Out: SI, in the robot's own frame
// (x forward, y left, z up). All const, from any thread.
//
// Motion engines move bodies in steps of constant speed, so a blow would last exactly one tick. A real body
// is elastic: accelerations are means over RobotModel::shock_s (or one tick, whichever is longer), which
// keeps the change of speed and spreads it over that time. The specific force is that of the robot's origin.
// Known only up to the last tick: ask for scene.now() or earlier.
// Not modelled: vibration of motors and gears, rocking on the suspension of the tyres, tipping.
#pragma once
#include "sim_core/base/clock.h"
#include "sim_core/geometry/ground.h"

namespace sim {

class Scene;

/// How a body lies on the ground.
struct Stance {
  BodyAxes axes;         ///< in the floor's frame
  Vec3 origin_m;         ///< of the body's frame, in the floor's frame
  double pitch_rad = 0;  ///< nose above the horizontal
  double roll_rad = 0;   ///< left side above the horizontal
};

/// Of a robot or a loose object (robots come first). Solids for rays and contacts stay upright all the same.
Stance stance(const Scene& scene, int body, Clicks at);

/// Length of a tick: sensors that feel the motion `lag` ago have one value, whenever it is worked out.
Clicks motion_lag(const Scene& scene);

/// Acceleration minus gravity, m/s2: (0, 0, 9.81) at rest on the level.
Vec3 specific_force_m_s2(const Scene& scene, int robot, Clicks at);

/// Angular rates about the body's axes, rad/s, right-handed: about x (forward) positive lifts the left side,
/// about y (left) positive lowers the nose, about z (up) positive turns counter-clockwise. Mean over the tick
/// that ends at `at`.
Vec3 angular_rate_rad_s(const Scene& scene, int robot, Clicks at);

}  // namespace sim
