// SPDX-License-Identifier: MIT
// The rays are those of trace_proximity(); what they met is looked for once more, this time to be named.
#include "sim_core/light/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"
#include "sim_core/world/scene.h"

namespace sim {
namespace {

constexpr double kSameM = 1e-7;  // two distances along one ray that are the same meeting

/// What a ray meets at a distance at which it is known to meet something.
Met met_at(const Scene& scene, const Ray& ray, double distance_m, int skip_robot, Clicks at) {
  const Layout& layout = scene.layout();
  const Vec2 there{ray.from.x + distance_m * ray.dir.x, ray.from.y + distance_m * ray.dir.y};
  Met met;
  double best = distance_m + kSameM;
  std::vector<Candidate> around;
  scene.neighbours().gather(there, 2 * kSkinM, around);
  for (const Candidate& c : around) {
    if (c.moving && c.index == skip_robot) continue;
    const std::size_t i = static_cast<std::size_t>(c.index);
    const Placed placed = c.moving ? scene.placed(c.index, at) : layout.fixed[i];
    if (!cast_ray(ray, placed, best)) continue;
    met.name = c.moving ? layout.moving_name[i] : layout.fixed_name[i];
    met.surface = surface_of(scene.layout(), c);
    met.bottom_m = placed.z_m + placed.solid->z0_m;
    met.top_m = placed.z_m + placed.solid->z1_m;
  }
  if (layout.ground.has_ramps()) {
    const int ramp = layout.ground.cast(ray, best);
    if (ramp >= 0) {
      const RampDesc& desc = scene.world().ramps[static_cast<std::size_t>(ramp)];
      met = {fmt::format("ramp {}", ramp + 1), surface_of(desc.material), 0, desc.high_m};
    }
  }
  if (ray.dir.z < -1e-9 && -ray.from.z / ray.dir.z < best)
    met = {"the floor", floor_at(scene.world(), there), 0, 0};
  return met;
}

Ray ray_of(const RayTrace& t) {
  const Vec3 d{t.to_m.x - t.from_m.x, t.to_m.y - t.from_m.y, t.to_m.z - t.from_m.z};
  const double length_m = std::sqrt(dot(d, d));
  return {t.from_m, {d.x / length_m, d.y / length_m, d.z / length_m}};
}

/// -pi to pi
double turned(double angle_rad) { return std::remainder(angle_rad, 2 * kPi); }

}  // namespace

TableStep table_step(const std::vector<ResponseRow>& table, double distance_m) {
  CHECK(table.size() >= 2, "a table has two rows or more");
  TableStep step;
  step.result = look_up(table, distance_m);
  const bool below = !(distance_m > table.front().distance_m);
  if (below || distance_m >= table.back().distance_m) {
    step.row = below ? 0 : static_cast<int>(table.size()) - 1;
    step.clamped = distance_m < table.front().distance_m || distance_m > table.back().distance_m;
    step.from = step.to = table[static_cast<std::size_t>(step.row)];
    return step;
  }
  while (table[static_cast<std::size_t>(step.row) + 1].distance_m <= distance_m) ++step.row;
  step.from = table[static_cast<std::size_t>(step.row)];
  step.to = table[static_cast<std::size_t>(step.row) + 1];
  step.fraction = (distance_m - step.from.distance_m) / (step.to.distance_m - step.from.distance_m);
  return step;
}

ProximityExplanation explain_proximity(const Scene& scene, int robot, int sensor, Clicks at) {
  // What the sensor says, and the rays by which it came to that.
  ProximityExplanation e;
  e.config = proximity_config(scene, robot, sensor);
  e.response = sense_proximity(scene, robot, sensor, at);
  const SensorMount& mount = scene.world()
                                 .model_of(scene.world().robots[static_cast<std::size_t>(robot)])
                                 ->proximity[static_cast<std::size_t>(sensor)];
  e.bearing_rad = turned(mount.yaw_rad);
  const double heading_rad = scene.pose(robot, at).heading_rad;
  const std::vector<RayTrace> traces = trace_proximity(scene, robot, sensor, at);
  const std::vector<RayPlan> plans =
      plan_rays(e.config.rays, e.config.aperture_rad, e.config.gaussian_width, e.config.layout);
  CHECK(traces.size() == plans.size(), "a ray each");
  e.at_m = traces.front().from_m;
  e.factor = 0;
  // Each ray: where it goes, what it meets, and how far that seems to be.
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const RayTrace& t = traces[i];
    RayExplanation r;
    r.trace = t;
    // a sensor that touches what it sees has rays of no length: their direction is then the plan's alone
    if (t.distance_m > 1e-9) {
      const Ray ray = ray_of(t);
      r.dir = ray.dir;
      if (t.hit) r.met = met_at(scene, ray, t.distance_m, robot, at);
    } else {
      const SinCos yaw = sin_cos(heading_rad + mount.yaw_rad);
      const Vec3& p = plans[i].dir;
      r.dir = {yaw.c * p.x - yaw.s * p.y, yaw.s * p.x + yaw.c * p.y, p.z};
      r.met = met_at(scene, {t.from_m, r.dir}, t.distance_m, robot, at);
    }
    r.azimuth_rad = plans[i].azimuth_rad;
    r.off_axis_rad = plans[i].off_axis_rad;
    r.bearing_rad = turned(std::atan2(r.dir.y, r.dir.x) - heading_rad);
    r.rise_rad = std::asin(std::clamp(r.dir.z, -1.0, 1.0));
    r.apparent_m = t.distance_m / t.colour_factor;
    e.distance_m += t.weight * t.distance_m;
    e.factor += t.weight * t.colour_factor;
    e.rays.push_back(r);
  }
  // Where rays answer singly: what each adds, the one on the axis less what the slanted ones have of a wall.
  if (e.config.rays_answer_singly) {
    for (RayExplanation& r : e.rays) {
      if (!r.trace.hit) continue;
      r.answer_counts = look_up(e.config.table, r.apparent_m).value;
      if (r.off_axis_rad > 1e-9) continue;
      for (const RayPlan& other : plans) {
        if (other.off_axis_rad <= 1e-9) continue;
        const double slanted_m = r.apparent_m / std::cos(other.off_axis_rad);
        r.answer_counts -= look_up(e.config.table, slanted_m).value;
      }
    }
  }
  e.step = table_step(e.config.table, e.response.apparent_distance_m);
  return e;
}

LightExplanation explain_light(const Scene& scene, int robot, int sensor, Clicks at) {
  LightExplanation e;
  const WorldDesc& world = scene.world();
  e.ambient_w_m2 = world.ambient_w_m2;
  e.total_w_m2 = sense_irradiance_w_m2(scene, robot, sensor, at);
  const std::vector<LampShare> shares = trace_light(scene, robot, sensor, at);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const LampDesc& lamp = world.lamps[i];
    LampExplanation l;
    l.name = lamp.name.empty() ? fmt::format("lamp {}", i + 1) : lamp.name;
    l.share = shares[i];
    if (l.share.blocked) {
      const Vec3& from = l.share.from_m;
      const double d = l.share.distance_m;
      const Ray ray{from,
                    {(lamp.position_m.x - from.x) / d, (lamp.position_m.y - from.y) / d,
                     (lamp.position_m.z - from.z) / d}};
      SceneHit hit;
      if (scene.cast(ray, d, robot, at, &hit))
        l.blocked_by = met_at(scene, ray, hit.distance_m, robot, at).name;
      if (l.blocked_by.empty()) l.blocked_by = "something";
    }
    e.lamps.push_back(std::move(l));
  }
  return e;
}

}  // namespace sim
