// SPDX-License-Identifier: MIT
// A kind of robot as pure data: its body, its wheels, where its proximity sensors look from, what it looks
// like. Whoever knows a real robot fills one in and hands it to the loader; sim_core itself names none.
// Frame: x forward, y left, z up from the floor, origin between the wheels. Metres, radians, kilograms.
#pragma once
#include <string>
#include <vector>

#include "sim_core/geometry/pose.h"
#include "sim_core/world/own_keys.h"

namespace sim {

/// Colour, each part 0 to 1.
struct Colour {
  double r = 1;
  double g = 1;
  double b = 1;
};

/// Where one proximity sensor sits and looks.
struct SensorMount {
  Vec3 at_m;             ///< in the robot's frame
  double yaw_rad = 0;    ///< counter-clockwise from forward
  double pitch_rad = 0;  ///< above the horizontal
};

/// A lamp on the robot, for pictures and cameras.
struct LedMount {
  Vec2 at_m;
  Colour colour{1, 0.1, 0.1};
  double z_m = 0.035;  ///< height of the spot that cameras see on the body
  double spot_m =
      0.006;  ///< its radius; an LED nearer than this to the robot's middle lights the body from inside
};

struct RobotModel {
  std::string name;  ///< what world files write in `model`
  double body_radius_m = 0.037;
  double body_z0_m = 0.002;      ///< underside of the body above the floor
  double body_height_m = 0.047;  ///< top of the body above the floor
  double mass_kg = 0.15;
  Vec3 centre_of_mass_m{0, 0, 0.015};
  double inertia_kg_m2 = 8.75e-5;  ///< about the vertical axis
  double wheel_radius_m = 0.0205;
  double axle_m = 0.053;        ///< distance between the wheels
  double shock_s = 0.005;       ///< time over which the elastic body spreads a blow
  double max_push_n = 1e9;      ///< most the drive can push, N; traction may allow less
  double wheel_friction = 1.0;  ///< Coulomb coefficient tyre to floor
  double side_friction = 0.3;   ///< Coulomb coefficient of the body's side
  int steps_per_turn = 1000;    ///< motor full steps of one wheel turn
  double battery_v = 4.0;       ///< when the world file does not say
  double battery_wh = 5.0;      ///< same, full
  Colour colour{0.2, 0.6, 0.3};
  double ir_reflectance = -1;  ///< 0 to 1; negative: the red part of the colour
  double roughness = 0;        ///< 0 mirror to 1 matt, for the newer colour rule
  std::vector<SensorMount> proximity;
  std::vector<LedMount> leds;  ///< index = bit of MindReport::leds
  std::vector<OwnKey> keys;    ///< of `[[robot]]`, that only this kind has
};

}  // namespace sim
