// SPDX-License-Identifier: MIT
// What a small camera on a robot sees: for a grid of viewing directions the light that comes from there.
// In: the Scene, the camera's place on its robot, tangents of the directions. Out: linear light per pixel.
//
//   up |   / direction (1 forward, `right` to the right, `up` upwards): points ahead of the camera at depth t
//      |  /  lie at t * (1, right, up), so columns of the grid are upright planes and solids, which all stand
//      +-----> forward            upright, are rasterised column by column against a depth buffer
//
// Light: every surface is matt. One of colour c (0 to 1) and unit normal n sends c * E, where
//   E = sky_light * (0.8 + 0.2 n_z)  +  sum over lamps that are on of
//                                       intensity * colour * max(0, n . l) / att(d)
// (l: unit vector to the lamp, d: distance, att = a0 + a1 d + a2 d2). Where nothing stands, the sky's colour
// times sky_light. Lamps show as discs of kLampRadiusM, lit LEDs of other robots as spots of their mount's
// size on the body, an LED in the robot's middle as a glow of the body's lower half.
// Not modelled: shadows, reflections, texture of solids, lens distortion, depth of field, the robot's own
// body, motion blur (an image has one instant; callers may render line by line).
#pragma once
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/pose.h"

namespace sim {

class Scene;

/// Linear light: 1 is what a white matt surface sends back under 1 W/m2. Not clipped.
struct Light {
  float r = 0, g = 0, b = 0;
};

/// Renders `right.size()` times `up.size()` pixels as robot `robot` sees them at `at` through a camera at
/// `eye_m` in the robot's frame that looks level and forward. `right` and `up` are tangents of the
/// directions, in any order. out[row * right.size() + column]. The robot itself is not seen. LEDs are those
/// of the last tick. Deterministic to the last bit. Safe from several threads while nobody publishes.
void render_camera(const Scene& scene, int robot, const Vec3& eye_m, Clicks at,
                   const std::vector<double>& right, const std::vector<double>& up, std::vector<Light>& out);

/// Somebody will look: from the next tick on the LEDs of all robots are kept for cameras.
void watch_leds(const Scene& scene);

inline constexpr double kLampRadiusM = 0.02;  ///< of the disc that a lamp shows
inline constexpr double kLampGlow = 30;       ///< light of the disc over the lamp's intensity
inline constexpr double kLedGlow = 3;         ///< light of a lit LED's spot times its colour
inline constexpr double kBodyLedGlow = 0.8;   ///< the same for an LED that lights the body from inside
inline constexpr double kSkyShare = 0.8;      ///< light on upright faces over that on the floor

}  // namespace sim
