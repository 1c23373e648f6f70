// SPDX-License-Identifier: MIT
#include "tests/board/flat_scene.h"

namespace sim {

ProximityResponse sense_proximity(const Scene& scene, int, int sensor, Clicks at) {
  if (scene.asked.size() < 10000) scene.asked.push_back({sensor, at});
  ProximityResponse response;
  response.value = scene.reflection(sensor, at);
  response.relative_noise = scene.relative_noise;
  response.uniform_noise = scene.uniform_noise;
  return response;
}

Clicks motion_lag(const Scene&) { return 28800; }
Vec3 specific_force_m_s2(const Scene& scene, int, Clicks at) { return scene.force_m_s2(at); }
Vec3 angular_rate_rad_s(const Scene& scene, int, Clicks at) { return scene.turn_rad_s(at); }

bool has_light(const Scene& scene) { return scene.irradiance_w_m2 != 0; }
double sense_irradiance_w_m2(const Scene& scene, int, int, Clicks) { return scene.irradiance_w_m2; }

void render_camera(const Scene& scene, int, const Vec3&, Clicks at, const std::vector<double>& right,
                   const std::vector<double>& up, std::vector<Light>& out) {
  out.clear();
  for (double v : up)
    for (double u : right) out.push_back(scene.light(u, v, at));
}

void watch_leds(const Scene&) {}

Pose2 Scene::pose(int, Clicks) const { return {}; }
BodyState Scene::state(int) const { return {}; }
Stance stance(const Scene&, int, Clicks) { return {}; }

}  // namespace sim
