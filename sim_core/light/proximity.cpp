// SPDX-License-Identifier: MIT
// Rays are kept in the robot's frame and turned by its heading once per instant. Only solids on the robot's
// neighbour list are tried, and only those that a sensor's bundle of rays can touch. [Webots B2] [Enki: IRSensor.cpp]
#include "sim_core/light/proximity.h"

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"
#include "sim_core/world/scene.h"

namespace sim {

/// One ray in the robot's frame.
struct BodyRay {
  Vec3 dir;
  double weight = 1;
  double cos_off_axis = 1;
  double off_axis_rad = 0;
};

struct SensorOptics {
  ProximityConfig config;
  Vec3 at_m;
  Vec3 axis;
  double bundle_sin = 0;  // of the half angle around the axis that holds every ray, in plan
  bool wide = false;      // rays may go backwards: no culling by direction
  std::vector<BodyRay> rays;
  ProximityResponse nothing;  // the answer where no ray meets anything
};

struct ProximityOptics {
  std::vector<SensorOptics> sensors;
  std::vector<int> first;  // per robot, one more than robots
  struct alignas(64) PoseCache {
    Clicks at = -1;
    Clicks tick = -1;
    Frame2 frame;
  };
  mutable std::vector<PoseCache> poses;  // per robot; used by that robot's thread only
  std::vector<double> reach_m;
};

namespace {

const SensorOptics& optics_of(const Scene& scene, int robot, int sensor) {
  const ProximityOptics* optics = scene.optics();
  CHECK(optics, "a scene has its optics attached before anybody looks");
  const int first = optics->first[static_cast<std::size_t>(robot)];
  CHECK(sensor >= 0 && first + sensor < optics->first[static_cast<std::size_t>(robot) + 1], "no such sensor");
  return optics->sensors[static_cast<std::size_t>(first + sensor)];
}

/// The robot's frame at an instant; the four instants of one ADC scan serve two sensors each.
const Frame2& frame_of(const Scene& scene, int robot, Clicks at) {
  ProximityOptics::PoseCache& cache = scene.optics()->poses[static_cast<std::size_t>(robot)];
  if (cache.at != at || cache.tick != scene.now()) {
    cache.frame = Frame2(scene.pose(robot, at));
    cache.at = at;
    cache.tick = scene.now();
  }
  return cache.frame;
}

/// Colour factor f of a surface. [Webots B2]: .2 + .8 red, since R2019b times (1 - roughness / 2).
double colour_factor(const ProximityConfig& config, const Surface& surface) {
  if (config.type == SensorType::Generic || config.colour_rule == ColourRule::None) return 1;
  const double gloss = config.colour_rule == ColourRule::New ? 1 - 0.5 * surface.roughness : 1.0;
  return 0.2 + 0.8 * surface.ir_reflectance * gloss;
}

/// What each ray of a sensor met.
struct RayEnd {
  double distance_m;
  double factor;
  bool hit;
};

constexpr int kMostCandidates = 64;  // tried per sensor; a neighbour list is rarely longer than ten

/// Fills one end per ray; returns false when nothing can be met at all.
bool shoot(const Scene& scene, int robot, const SensorOptics& s, Clicks at, std::vector<RayEnd>& ends) {
  const Neighbours& near = scene.neighbours();
  const Frame2& frame = frame_of(scene, robot, at);
  const double range = s.config.max_range_m();
  const Vec2 from = frame.to_world({s.at_m.x, s.at_m.y});
  const Vec2 axis = frame.turn({s.axis.x, s.axis.y});

  // keep what the bundle of rays can touch
  Placed placed[kMostCandidates];
  const Surface* surface[kMostCandidates];
  int count = 0;
  for (const Candidate* c = near.begin(robot); c != near.end(robot) && count < kMostCandidates; ++c) {
    Placed& p = placed[count];
    p = c->moving ? scene.placed(c->index, at) : scene.layout().fixed[static_cast<std::size_t>(c->index)];
    const Vec2 gap = p.frame.at - from;
    const double bound = p.solid->bound_m;
    if (dot(gap, gap) > (range + bound) * (range + bound)) continue;
    if (!s.wide) {
      if (dot(gap, axis) < -bound) continue;
      if (std::fabs(cross(axis, gap)) > bound + range * s.bundle_sin) continue;
    }
    surface[count++] = &scene.surface(*c);
  }

  const double floor_z = s.at_m.z;
  bool any = false;
  ends.clear();
  for (const BodyRay& r : s.rays) {
    const Vec2 dir = frame.turn({r.dir.x, r.dir.y});
    const Ray ray{{from.x, from.y, s.at_m.z}, {dir.x, dir.y, r.dir.z}};
    RayEnd end{range, 1, false};
    RayHit hit;
    for (int k = 0; k < count; ++k) {
      if (!cast_ray(ray, placed[k], end.distance_m, &hit)) continue;
      end = {hit.distance_m, colour_factor(s.config, *surface[k]), true};
    }
    if (r.dir.z < -1e-9 && floor_z < -r.dir.z * end.distance_m) {
      const double d = -floor_z / r.dir.z;
      end = {d, colour_factor(s.config, scene.floor({from.x + d * dir.x, from.y + d * dir.y})), true};
    }
    any = any || end.hit;
    ends.push_back(end);
  }
  return any;
}

/// From the ends of the rays to the table's output.
ProximityResponse respond(const SensorOptics& s, const std::vector<RayEnd>& ends) {
  const ProximityConfig& c = s.config;
  double distance = 0, factor = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    distance += s.rays[i].weight * ends[i].distance_m;
    factor += s.rays[i].weight * ends[i].factor;
  }
  ProximityResponse out;
  out.apparent_distance_m = factor > 0 ? distance / factor : c.max_range_m();
  out.uniform_noise = c.noise_law == NoiseLaw::Uniform;
  const ResponseRow row = look_up(c.table, out.apparent_distance_m);
  out.value = row.value;
  out.relative_noise = row.relative_noise * c.noise_scale;
  if (c.rays_answer_singly) {
    // each slanted ray answers by itself; a ray on the axis answers for what a flat wall leaves to it [Enki]
    double sum = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const double d = ends[i].distance_m / ends[i].factor;
      if (!ends[i].hit) continue;
      sum += look_up(c.table, d).value;
      if (s.rays[i].off_axis_rad > 1e-9) continue;
      for (const BodyRay& other : s.rays) {
        if (other.off_axis_rad > 1e-9) sum -= look_up(c.table, d / other.cos_off_axis).value;
      }
    }
    out.value = std::clamp(sum, 0.0, c.table.front().value);
    const double absolute = row.relative_noise * row.value;  // Enki's noise is in counts
    out.relative_noise = out.value > 0 ? absolute * c.noise_scale / out.value : 0;
  }
  return out;
}

}  // namespace

std::shared_ptr<const ProximityOptics> make_optics(const WorldDesc& world) {
  auto optics = std::make_shared<ProximityOptics>();
  for (int robot = 0; robot < static_cast<int>(world.robots.size()); ++robot) {
    const RobotModel* model = world.model_of(world.robots[static_cast<std::size_t>(robot)]);
    CHECK(model, "every robot has a model");
    optics->first.push_back(static_cast<int>(optics->sensors.size()));
    double reach = model->body_radius_m;
    for (int sensor = 0; sensor < static_cast<int>(model->proximity.size()); ++sensor) {
      const SensorMount& mount = model->proximity[static_cast<std::size_t>(sensor)];
      SensorOptics s;
      s.config = resolve_proximity(world, robot, sensor);
      s.at_m = mount.at_m;
      // sensor frame to robot frame: pitch up about the sensor's left axis, then yaw
      const double cy = std::cos(mount.yaw_rad), sy = std::sin(mount.yaw_rad);
      const double cp = std::cos(mount.pitch_rad), sp = std::sin(mount.pitch_rad);
      const auto turn = [&](const Vec3& v) {
        const double x = cp * v.x - sp * v.z;
        const double z = sp * v.x + cp * v.z;
        return Vec3{cy * x - sy * v.y, sy * x + cy * v.y, z};
      };
      s.axis = turn({1, 0, 0});
      double widest = 0;
      for (const RayPlan& plan :
           plan_rays(s.config.rays, s.config.aperture_rad, s.config.gaussian_width, s.config.layout)) {
        s.rays.push_back({turn(plan.dir), plan.weight, std::cos(plan.off_axis_rad), plan.off_axis_rad});
        widest = std::max(widest, plan.off_axis_rad);
      }
      const double open = widest + std::fabs(mount.pitch_rad);
      s.wide = open > 0.4 * kPi;
      s.bundle_sin = std::sin(std::min(open, 0.5 * kPi));
      s.nothing = respond(s, std::vector<RayEnd>(s.rays.size(), RayEnd{s.config.max_range_m(), 1, false}));
      reach = std::max(reach, std::hypot(mount.at_m.x, mount.at_m.y) + s.config.max_range_m());
      optics->sensors.push_back(std::move(s));
    }
    optics->reach_m.push_back(reach);
  }
  optics->first.push_back(static_cast<int>(optics->sensors.size()));
  optics->poses.resize(world.robots.size());
  return optics;
}

std::vector<double> optics_reach_m(const ProximityOptics& optics) { return optics.reach_m; }

ProximityResponse sense_proximity(const Scene& scene, int robot, int sensor, Clicks at) {
  const SensorOptics& s = optics_of(scene, robot, sensor);
  const Neighbours& near = scene.neighbours();
  const bool looks_down = s.axis.z < 0 || s.rays.size() > 1;
  if (near.begin(robot) == near.end(robot) && !looks_down) return s.nothing;
  thread_local std::vector<RayEnd> ends;
  return shoot(scene, robot, s, at, ends) ? respond(s, ends) : s.nothing;
}

double sense_irradiance_w_m2(const Scene& scene, int robot, int sensor, Clicks at) {
  const WorldDesc& world = scene.world();
  double sum = world.ambient_w_m2;
  if (world.lamps.empty()) return sum;
  const SensorOptics& s = optics_of(scene, robot, sensor);
  const Frame2& frame = frame_of(scene, robot, at);
  const Vec2 at_m = frame.to_world({s.at_m.x, s.at_m.y});
  const Vec2 axis = frame.turn({s.axis.x, s.axis.y});
  for (const LampDesc& lamp : world.lamps) {
    if (!lamp.on) continue;
    const Vec3 to{lamp.position_m.x - at_m.x, lamp.position_m.y - at_m.y, lamp.position_m.z - s.at_m.z};
    const double d = std::sqrt(to.x * to.x + to.y * to.y + to.z * to.z);
    if (d <= 0) continue;
    const Vec3 dir{to.x / d, to.y / d, to.z / d};
    const double facing = dir.x * axis.x + dir.y * axis.y + dir.z * s.axis.z;
    if (facing <= 0) continue;
    if (scene.cast({{at_m.x, at_m.y, s.at_m.z}, dir}, d, robot, at, nullptr)) continue;
    const std::array<double, 3>& a = lamp.attenuation;
    const double white = (lamp.colour.r + lamp.colour.g + lamp.colour.b) / 3;  // [Webots B3]
    sum += lamp.intensity_w_m2 * white * facing / (a[0] + a[1] * d + a[2] * d * d);
  }
  return sum;
}

const ProximityConfig& proximity_config(const Scene& scene, int robot, int sensor) {
  return optics_of(scene, robot, sensor).config;
}

std::vector<RayTrace> trace_proximity(const Scene& scene, int robot, int sensor, Clicks at) {
  const SensorOptics& s = optics_of(scene, robot, sensor);
  std::vector<RayEnd> ends;
  shoot(scene, robot, s, at, ends);
  const Frame2 frame(scene.pose(robot, at));
  const Vec2 from = frame.to_world({s.at_m.x, s.at_m.y});
  std::vector<RayTrace> out;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Vec2 dir = frame.turn({s.rays[i].dir.x, s.rays[i].dir.y});
    const double d = ends[i].distance_m;
    out.push_back({{from.x, from.y, s.at_m.z},
                   {from.x + d * dir.x, from.y + d * dir.y, s.at_m.z + d * s.rays[i].dir.z},
                   d, ends[i].hit, ends[i].factor, s.rays[i].weight});
  }
  return out;
}

}  // namespace sim
