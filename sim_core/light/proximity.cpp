// SPDX-License-Identifier: MIT
// Rays are kept in the robot's frame, and what they may meet is turned into it once per instant. Only solids
// on the robot's neighbour list are tried, and only those that a sensor's bundle of rays can touch. [Webots
// B2] [Enki: IRSensor.cpp]
#include "sim_core/light/proximity.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>

#include "sim_core/base/check.h"
#include "sim_core/light/response_curve.h"
#include "sim_core/world/scene.h"
#include "sim_core/world/true_motion.h"

namespace sim {

/// What one ray counts for.
struct RayShare {
  double weight = 1;
  double slant = 1;  // how much longer the ray is to a flat wall across the axis: 1 / cos(off axis)
  double off_axis_rad = 0;
};

struct SensorOptics {
  explicit SensorOptics(const ProximityConfig& c) : config(c), curve(c.table) {}
  ProximityConfig config;
  ResponseCurve curve;
  Fan fan;  // in the robot's frame
  bool meets_floor = false;
  std::vector<RayShare> rays;  // as in the fan
  ProximityResponse nothing;   // the answer where no ray meets anything
  bool sees(const RayEnd& end) const { return end.distance_m < fan.range_m; }
};

/// Poses that sensors see are of whole quanta, so that the two sensors that a converter samples one right
/// after the other share them: 0.14 ms, in which the fastest robot drives 18 um.
constexpr Clicks kPoseQuantum = 2048;  // [assumed: ten times what lies between the two]
static_assert((kPoseQuantum & (kPoseQuantum - 1)) == 0);

/// What one robot's rays may meet at one instant.
struct Surroundings {
  struct Item {
    Placed placed;  // in the robot's frame; in worlds with ramps, where robots tilt, in the world's
    const Surface* surface;
  };
  Clicks at = 0;
  Frame2 frame;
  std::vector<Item> items;
};

struct ProximityOptics {
  std::uint64_t serial;  // of all that were made
  std::vector<std::unique_ptr<SensorOptics>>
      sensors;  // robots of one model without settings of their own share
  struct Robot {
    std::int32_t first = 0, count = 0;  // its sensors among all
    double reach_m = 0;
  };
  std::vector<Robot> robots;
};

namespace {

const SensorOptics& optics_of(const Scene& scene, int robot, int sensor) {
  const ProximityOptics* optics = scene.optics();
  CHECK(optics, "a scene has its optics attached before anybody looks");
  const ProximityOptics::Robot& own = optics->robots[static_cast<std::size_t>(robot)];
  CHECK(static_cast<unsigned>(sensor) < static_cast<unsigned>(own.count), "no such sensor");
  return *optics->sensors[static_cast<std::size_t>(own.first + sensor)];
}

constexpr Clicks quantised(Clicks at) { return at & -kPoseQuantum; }

void look_around(const Scene& scene, int robot, Surroundings& s) {
  s.frame = Frame2(scene.pose(robot, s.at));
  s.items.clear();
  const bool is_tilting = scene.layout().ground.has_ramps();
  // who stands beyond the rays' reach after all is passed over by each sensor's bundle
  const auto add = [&](const Candidate& c, const Placed& placed) {
    s.items.push_back({{placed.solid, is_tilting ? placed.frame : s.frame.to_local(placed.frame), placed.z_m},
                       &surface_of(scene.layout(), c)});
  };
  const Neighbours& near = scene.neighbours();
  for (const Candidate *c = near.begin(robot), *end = near.end(robot); c != end; ++c) {
    if (!near.may_see(c, s.at)) continue;
    c->moving ? add(*c, scene.placed(c->index, s.at))
              : add(*c, scene.layout().fixed[static_cast<std::size_t>(c->index)]);
  }
}

/// What the robot that a thread looked at last sees around it: one after the other runs up to the end of a
/// tick, and then the scene is another one. A scan's newest samples are of four instants.
struct Kept {
  static constexpr Clicks kNone = -1;
  std::uint64_t optics = 0, version = 0;  // of the scene
  int robot = 0;
  unsigned oldest = 0;
  std::array<Clicks, 4> at{kNone, kNone, kNone, kNone};
  std::array<Surroundings, 4> instants;
};

// a function of its own: asking for the thread's own place takes longer than a call
__attribute__((noinline)) Kept& kept_by_thread() {
  thread_local Kept kept;
  return kept;
}

/// `at` of a whole quantum.
const Surroundings& surroundings(const Scene& scene, int robot, Clicks at) {
  Kept& kept = kept_by_thread();
  const std::uint64_t optics = scene.optics()->serial;
  if (kept.robot == robot && kept.version == scene.version() && kept.optics == optics) {
    for (std::size_t i = 0; i < kept.at.size(); ++i)
      if (kept.at[i] == at) return kept.instants[i];
  } else {
    kept.at.fill(Kept::kNone);
    kept.robot = robot;
    kept.version = scene.version();
    kept.optics = optics;
  }
  const std::size_t i = kept.oldest++ % kept.at.size();
  kept.at[i] = kept.instants[i].at = at;
  look_around(scene, robot, kept.instants[i]);
  return kept.instants[i];
}

/// Colour factor f of a surface. [Webots B2]: .2 + .8 red, since R2019b with red times (1 - roughness / 2).
double colour_factor(const ProximityConfig& config, const Surface& surface) {
  if (config.type == SensorType::Generic || config.colour_rule == ColourRule::None) return 1;
  const double gloss = config.colour_rule == ColourRule::New ? 1 - 0.5 * surface.roughness : 1.0;
  return 0.2 + 0.8 * surface.ir_reflectance * gloss;
}

/// The robot's frame in space, for worlds with ramps: sensors tilt with their robot.
struct TiltedFrame {
  Stance stance;
  TiltedFrame(const Scene& scene, int robot, Clicks at) : stance(sim::stance(scene, robot, at)) {}
  Vec3 turn(const Vec3& v) const {
    const BodyAxes& a = stance.axes;
    return {v.x * a.forward.x + v.y * a.left.x + v.z * a.up.x,
            v.x * a.forward.y + v.y * a.left.y + v.z * a.up.y,
            v.x * a.forward.z + v.y * a.left.z + v.z * a.up.z};
  }
  Vec3 to_world(const Vec3& v) const {
    const Vec3 t = turn(v);
    return {stance.origin_m.x + t.x, stance.origin_m.y + t.y, stance.origin_m.z + t.z};
  }
};

/// The same as shoot() in space, ramps included; every ray is tried on every neighbour.
__attribute__((noinline)) bool shoot_over_ramps(const Scene& scene, int robot, const SensorOptics& s,
                                                const Surroundings& around, RayEnd* ends) {
  const TiltedFrame frame(scene, robot, around.at);
  const Vec3 from = frame.to_world(s.fan.from);
  bool any = false;
  for (std::size_t i = 0; i < s.rays.size(); ++i) {
    RayEnd& end = ends[i] = {s.fan.range_m, 1};
    const Ray ray{from, frame.turn(s.fan.dirs[i])};
    for (const Surroundings::Item& item : around.items) {
      if (cast_ray(ray, item.placed, end.distance_m)) end.factor = colour_factor(s.config, *item.surface);
    }
    if (ray.dir.z < -1e-9 && from.z < -ray.dir.z * end.distance_m) {
      const double d = -from.z / ray.dir.z;
      end = {d, colour_factor(s.config,
                              floor_at(scene.world(), {from.x + d * ray.dir.x, from.y + d * ray.dir.y}))};
    }
    const int ramp = scene.layout().ground.cast(ray, end.distance_m);
    if (ramp >= 0) {
      const Material& material = scene.world().ramps[static_cast<std::size_t>(ramp)].material;
      end.factor = colour_factor(s.config, surface_of(material));
    }
    any = any || s.sees(end);
  }
  return any;
}

/// Returns false when no ray met anything; otherwise fills one end per ray.
__attribute__((always_inline)) inline bool shoot(const Scene& scene, int robot, const SensorOptics& s,
                                                 const Surroundings& around, RayEnd* ends) {
  if (scene.layout().ground.has_ramps()) return shoot_over_ramps(scene, robot, s, around, ends);
  bool any = false;
  for (const Surroundings::Item& item : around.items)
    any |= cast_fan(s.fan, item.placed, colour_factor(s.config, *item.surface), ends, any);
  if (!s.meets_floor) return any;
  if (!any) s.fan.end_freely(ends);
  const Vec3& from = s.fan.from;
  for (std::size_t i = 0; i < s.rays.size(); ++i) {
    const Vec3& dir = s.fan.dirs[i];
    if (dir.z > -1e-9 || from.z >= -dir.z * ends[i].distance_m) continue;
    const double d = -from.z / dir.z;
    const Vec2 there = around.frame.to_world(Vec2{from.x, from.y} + d * Vec2{dir.x, dir.y});
    ends[i] = {d, colour_factor(s.config, floor_at(scene.world(), there))};
    any = true;
  }
  return any;
}

/// Enki's law: each slanted ray answers by itself; a ray on the axis answers for what a
/// flat wall leaves to it.
double answer_singly(const SensorOptics& s, const RayEnd* ends) {
  double sum = 0;
  for (std::size_t i = 0; i < s.rays.size(); ++i) {
    if (!s.sees(ends[i])) continue;
    const double d = ends[i].factor == 1 ? ends[i].distance_m : ends[i].distance_m / ends[i].factor;
    sum += s.curve.at(d).value;
    if (s.rays[i].off_axis_rad > 1e-9) continue;
    double slant = 0, slanted = 0;
    for (const RayShare& other : s.rays) {
      if (other.off_axis_rad <= 1e-9) continue;
      if (other.slant != slant) slanted = s.curve.at(d * (slant = other.slant)).value;
      sum -= slanted;
    }
  }
  return std::clamp(sum, 0.0, s.curve.first().value);
}

/// From the ends of the rays to the table's output.
ProximityResponse respond(const SensorOptics& s, const RayEnd* ends) {
  double distance = 0, factor = 0;
  for (std::size_t i = 0; i < s.rays.size(); ++i) {
    distance += s.rays[i].weight * ends[i].distance_m;
    factor += s.rays[i].weight * ends[i].factor;
  }
  ProximityResponse out;
  out.apparent_distance_m = factor > 0 ? distance / factor : s.config.max_range_m();
  out.uniform_noise = s.config.noise_law == NoiseLaw::Uniform;
  const bool is_single = s.config.rays_answer_singly, is_noisy = s.config.noise_scale > 0;
  if (is_single) out.value = answer_singly(s, ends);
  if (is_single && !is_noisy) return out;
  const ResponseRow row = s.curve.at(out.apparent_distance_m);
  if (!is_single) out.value = row.value;
  const double of_row = row.relative_noise * s.config.noise_scale;
  // Enki's noise is in counts
  out.relative_noise = !is_single ? of_row : out.value > 0 ? of_row * row.value / out.value : 0;
  return out;
}

constexpr std::size_t kMostRays = 100;  // limit of the world format

std::unique_ptr<SensorOptics> make_sensor(const ProximityConfig& config, const SensorMount& mount) {
  auto s = std::make_unique<SensorOptics>(config);
  Fan& fan = s->fan;
  fan.from = mount.at_m;
  fan.range_m = config.max_range_m();
  // sensor frame to robot frame: pitch up about the sensor's left axis, then yaw
  const SinCos yaw = sin_cos(mount.yaw_rad), pitch = sin_cos(mount.pitch_rad);
  const auto turn = [&](const Vec3& v) {
    const double x = pitch.c * v.x - pitch.s * v.z;
    const double z = pitch.s * v.x + pitch.c * v.z;
    return Vec3{yaw.c * x - yaw.s * v.y, yaw.s * x + yaw.c * v.y, z};
  };
  // culling works in plan, around the direction in which the sensor looks
  fan.axis = {yaw.c, yaw.s};
  fan.is_level = true;
  double widest = 0;
  for (const RayPlan& plan :
       plan_rays(config.rays, config.aperture_rad, config.gaussian_width, config.layout)) {
    Vec3 dir = turn(plan.dir);
    if (std::fabs(dir.z) < 1e-15) dir.z = 0;
    fan.is_level = fan.is_level && dir.z == 0;
    s->meets_floor = s->meets_floor || -dir.z * fan.range_m > fan.from.z;
    const Vec2 plan_dir{dir.x, dir.y};
    widest = std::max(widest, std::atan2(std::fabs(cross(fan.axis, plan_dir)), dot(fan.axis, plan_dir)));
    fan.dirs.push_back(dir);
    s->rays.push_back({plan.weight, 1 / sin_cos(plan.off_axis_rad).c, plan.off_axis_rad});
  }
  CHECK(s->rays.size() <= kMostRays, "the world format limits the number of rays");
  // The wedge that holds all rays, a little wider than it is, against rounding.
  fan.is_wide = widest > 0.45 * kPi;
  fan.half_sin = std::min(1.0, std::sin(widest) + 1e-9);
  fan.half_cos = std::cos(widest) - 1e-9;
  // What the sensor answers when nothing is there.
  RayEnd ends[kMostRays];
  fan.end_freely(ends);
  s->nothing = respond(*s, ends);
  return s;
}

}  // namespace

std::shared_ptr<const ProximityOptics> make_optics(const WorldDesc& world) {
  static std::atomic<std::uint64_t> made{0};
  auto optics = std::make_shared<ProximityOptics>();
  optics->serial = ++made;
  std::map<const RobotModel*, int> shared;  // looked up only, never walked in order of address
  for (int robot = 0; robot < static_cast<int>(world.robots.size()); ++robot) {
    const RobotDesc& desc = world.robots[static_cast<std::size_t>(robot)];
    const RobotModel* model = world.model_of(desc);
    CHECK(model, "every robot has a model");
    const bool plain = desc.sensors.empty() && desc.proximity.is_empty();
    const auto known = shared.find(model);
    if (plain && known != shared.end()) {
      const ProximityOptics::Robot own = optics->robots[static_cast<std::size_t>(known->second)];
      optics->robots.push_back(own);
    } else {
      if (plain) shared.emplace(model, robot);
      const auto first = static_cast<std::int32_t>(optics->sensors.size());
      double reach = model->body_radius_m;
      for (int i = 0; i < static_cast<int>(model->proximity.size()); ++i) {
        const SensorMount& mount = model->proximity[static_cast<std::size_t>(i)];
        optics->sensors.push_back(make_sensor(resolve_proximity(world, robot, i), mount));
        reach = std::max(reach,
                         length({mount.at_m.x, mount.at_m.y}) + optics->sensors.back()->config.max_range_m());
      }
      optics->robots.push_back({first, static_cast<std::int32_t>(model->proximity.size()), reach});
    }
  }
  return optics;
}

std::vector<double> optics_reach_m(const ProximityOptics& optics) {
  std::vector<double> reach_m;
  for (const ProximityOptics::Robot& robot : optics.robots) reach_m.push_back(robot.reach_m);
  return reach_m;
}

/// `at` of a whole quantum. (A function of its own: half of all calls need not come here, and it keeps much.)
__attribute__((noinline)) static ProximityResponse sense_around(const Scene& scene, int robot,
                                                                const SensorOptics& s, Clicks at,
                                                                bool sees_ground) {
  const Surroundings& around = surroundings(scene, robot, at);
  if (!sees_ground && around.items.empty()) return s.nothing;
  RayEnd ends[kMostRays];
  return shoot(scene, robot, s, around, ends) ? respond(s, ends) : s.nothing;
}

ProximityResponse sense_proximity(const Scene& scene, int robot, int sensor, Clicks at) {
  const SensorOptics& s = optics_of(scene, robot, sensor);
  const bool sees_ground = s.meets_floor || scene.layout().ground.has_ramps();
  at = quantised(at);
  if (!sees_ground && !scene.neighbours().may_see(robot, at)) return s.nothing;
  return sense_around(scene, robot, s, at, sees_ground);
}

FlatWall::FlatWall(const ProximityConfig& config, const Surface& surface)
    : sensor_(make_sensor(config, {})), factor_(colour_factor(config, surface)) {}

FlatWall::~FlatWall() = default;

ProximityResponse FlatWall::at(double distance_m) const {
  const double range = sensor_->config.max_range_m();
  RayEnd ends[kMostRays];
  bool any = false;
  for (std::size_t i = 0; i < sensor_->rays.size(); ++i) {
    const double d = distance_m * sensor_->rays[i].slant;
    const bool hit = d < range;
    ends[i] = hit ? RayEnd{d, factor_} : RayEnd{range, 1};
    any = any || hit;
  }
  return any ? respond(*sensor_, ends) : sensor_->nothing;
}

namespace {

/// Where a sensor is and where it looks, for light.
struct Eye {
  Vec3 from, axis;
};

Eye eye_of(const Scene& scene, int robot, int sensor, Clicks at) {
  const WorldDesc& world = scene.world();
  const SensorOptics& s = optics_of(scene, robot, sensor);
  const Frame2& frame = surroundings(scene, robot, quantised(at)).frame;
  const Vec2 at_m = frame.to_world({s.fan.from.x, s.fan.from.y});
  const SensorMount& mount = world.model_of(world.robots[static_cast<std::size_t>(robot)])
                                 ->proximity[static_cast<std::size_t>(sensor)];
  const SinCos pitch = sin_cos(mount.pitch_rad);
  const Vec2 plan_axis = pitch.c * frame.turn(s.fan.axis);
  Eye eye{{at_m.x, at_m.y, s.fan.from.z}, {plan_axis.x, plan_axis.y, pitch.s}};
  if (scene.layout().ground.has_ramps()) {
    const TiltedFrame tilted(scene, robot, at);
    eye.from = tilted.to_world(s.fan.from);
    eye.axis = tilted.turn({pitch.c * s.fan.axis.x, pitch.c * s.fan.axis.y, pitch.s});
  }
  return eye;
}

/// [Webots B3] intensity times the cosine to the sensor's axis, attenuated, mean of the
/// colours; bodies block.
LampShare share_of(const Scene& scene, const LampDesc& lamp, const Eye& eye, int robot, Clicks at) {
  LampShare share;
  share.from_m = eye.from;
  share.on = lamp.on;
  const Vec3 to{lamp.position_m.x - eye.from.x, lamp.position_m.y - eye.from.y,
                lamp.position_m.z - eye.from.z};
  const double d = share.distance_m = std::sqrt(to.x * to.x + to.y * to.y + to.z * to.z);
  const std::array<double, 3>& a = lamp.attenuation;
  share.divisor = a[0] + a[1] * d + a[2] * d * d;
  share.white = (lamp.colour.r + lamp.colour.g + lamp.colour.b) / 3;
  if (d <= 0) return share;
  const Vec3 dir{to.x / d, to.y / d, to.z / d};
  share.facing = dir.x * eye.axis.x + dir.y * eye.axis.y + dir.z * eye.axis.z;
  if (!lamp.on || share.facing <= 0) return share;
  share.blocked = scene.cast({eye.from, dir}, d, robot, at, nullptr);
  if (!share.blocked) share.w_m2 = lamp.intensity_w_m2 * share.white * share.facing / share.divisor;
  return share;
}

}  // namespace

bool has_light(const Scene& scene) { return scene.world().ambient_w_m2 != 0 || !scene.world().lamps.empty(); }

double sense_irradiance_w_m2(const Scene& scene, int robot, int sensor, Clicks at) {
  const WorldDesc& world = scene.world();
  double sum = world.ambient_w_m2;
  if (world.lamps.empty()) return sum;
  const Eye eye = eye_of(scene, robot, sensor, at);
  for (const LampDesc& lamp : world.lamps)
    if (lamp.on) sum += share_of(scene, lamp, eye, robot, at).w_m2;
  return sum;
}

std::vector<LampShare> trace_light(const Scene& scene, int robot, int sensor, Clicks at) {
  std::vector<LampShare> shares;
  const Eye eye = eye_of(scene, robot, sensor, at);
  for (const LampDesc& lamp : scene.world().lamps) shares.push_back(share_of(scene, lamp, eye, robot, at));
  return shares;
}

const ProximityConfig& proximity_config(const Scene& scene, int robot, int sensor) {
  return optics_of(scene, robot, sensor).config;
}

std::vector<RayTrace> trace_proximity(const Scene& scene, int robot, int sensor, Clicks at) {
  const SensorOptics& s = optics_of(scene, robot, sensor);
  const Surroundings& around = surroundings(scene, robot, quantised(at));
  RayEnd ends[kMostRays];
  if (!shoot(scene, robot, s, around, ends)) s.fan.end_freely(ends);
  const TiltedFrame frame(scene, robot, around.at);
  const Vec3 from = frame.to_world(s.fan.from);
  std::vector<RayTrace> out;
  for (std::size_t i = 0; i < s.rays.size(); ++i) {
    const Vec3 dir = frame.turn(s.fan.dirs[i]);
    const double d = ends[i].distance_m;
    out.push_back({from,
                   {from.x + d * dir.x, from.y + d * dir.y, from.z + d * dir.z},
                   d,
                   s.sees(ends[i]),
                   ends[i].factor,
                   s.rays[i].weight});
  }
  return out;
}

}  // namespace sim
