// SPDX-License-Identifier: MIT
// What a proximity sensor's optics return at one instant: rays, colour rule, weights, lookup table; no
// noise drawn. A robot's gains and offsets (its Variation) and the noise itself belong to its board and
// are not applied here.
#pragma once
#include <memory>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/pose.h"
#include "sim_core/light/profiles.h"

namespace sim {

class Scene;
struct Surface;
struct SensorOptics;     ///< rays and table of one sensor
struct ProximityOptics;  ///< rays and tables of every sensor of a world, resolved once

/// One noise-free evaluation of a sensor.
struct ProximityResponse {
  double value = 0;  ///< table output for the apparent distance (the profile's own unit: counts of 4095)
  double relative_noise = 0;       ///< standard deviation (gaussian) or half width (uniform) as a fraction of
                                   ///< value; the world file's noise scale is already in it
  bool uniform_noise = false;      ///< noise law of the sensor
  double apparent_distance_m = 0;  ///< after the colour rule; the table's last row where nothing is seen
};

/// Sensor `sensor` of robot `robot` at instant `at`. `at` may lie up to 40 ms before or one tick after the
/// last tick: poses are interpolated, or carried on with the last tick's velocity. Deterministic; may be
/// called from any thread. Quickest for one robot after the other (each thread keeps what it saw last).
ProximityResponse sense_proximity(const Scene& scene, int robot, int sensor, Clicks at);

/// What a sensor answers to an endless flat wall across its axis, without a scene: what response curves show.
class FlatWall {
 public:
  FlatWall(const ProximityConfig& config, const Surface& surface);
  ~FlatWall();
  FlatWall(const FlatWall&) = delete;
  FlatWall& operator=(const FlatWall&) = delete;
  /// `distance_m` along the axis, 0 or more. A ray that would meet the wall beyond the range misses it.
  ProximityResponse at(double distance_m) const;
  /// Colour factor f of the wall's surface.
  double factor() const { return factor_; }

 private:
  std::unique_ptr<const SensorOptics> sensor_;
  double factor_;
};

/// Is there a lamp, or ambient light?
bool has_light(const Scene& scene);
/// Irradiance from lamps and ambient light on the same sensor, W/m2, occlusion by bodies included.
double sense_irradiance_w_m2(const Scene& scene, int robot, int sensor, Clicks at);

/// One lamp's part in that irradiance.
struct LampShare {
  double distance_m = 0;
  double facing = 0;   ///< cosine between the sensor's axis and the direction to the lamp
  double divisor = 1;  ///< attenuation a + b d + c d2
  double white = 1;    ///< mean of the lamp's colour
  bool on = true;
  bool blocked = false;  ///< something stands in between; only looked for where the light would count
  double w_m2 = 0;
  Vec3 from_m;  ///< the sensor
};
std::vector<LampShare> trace_light(const Scene& scene, int robot, int sensor, Clicks at);

/// Settings of one sensor after inheritance.
const ProximityConfig& proximity_config(const Scene& scene, int robot, int sensor);

/// One ray as pictures and inspectors show it.
struct RayTrace {
  Vec3 from_m;
  Vec3 to_m;  ///< where it hit, or its end at the table's last distance
  double distance_m = 0;
  bool hit = false;
  double colour_factor = 1;  ///< f of the colour rule
  double weight = 1;
};
std::vector<RayTrace> trace_proximity(const Scene& scene, int robot, int sensor, Clicks at);

/// Rays and tables of every sensor of a world; made once, attached to its Scene.
std::shared_ptr<const ProximityOptics> make_optics(const WorldDesc& world);
/// How far from its centre each robot's rays can end, m.
std::vector<double> optics_reach_m(const ProximityOptics& optics);

}  // namespace sim
