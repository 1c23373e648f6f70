// SPDX-License-Identifier: MIT
// What a proximity sensor's optics return at one instant: rays, colour rule, weights, lookup table; no noise drawn.
#pragma once
#include "sim_core/base/clock.h"

namespace sim {

class Scene;

/// One noise-free evaluation of a sensor.
struct ProximityResponse {
  double value = 0;             ///< table output for the apparent distance (the profile's own unit: counts of 4095)
  double relative_noise = 0;    ///< standard deviation (gaussian) or half width (uniform) as a fraction of value
  bool uniform_noise = false;   ///< noise law of the sensor
  double apparent_distance_m = 0;  ///< after the colour rule; the table's last row where nothing is seen
};

/// Sensor `sensor` of robot `robot` at instant `at`. `at` may lie up to 40 ms before or one tick after the last
/// tick: poses are interpolated, or carried on with the last tick's velocity. Deterministic; thread-safe.
ProximityResponse sense_proximity(const Scene& scene, int robot, int sensor, Clicks at);

/// Irradiance from lamps and ambient light on the same sensor, W/m2, occlusion by bodies included.
double sense_irradiance_w_m2(const Scene& scene, int robot, int sensor, Clicks at);

}  // namespace sim
