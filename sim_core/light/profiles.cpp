// SPDX-License-Identifier: MIT
// The tables themselves, each with its source, and the placement of rays.
#include "sim_core/light/profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"
#include "sim_core/world/world_desc.h"

namespace sim {
namespace {

constexpr double kFullScale = 4095;  // counts of a 12-bit converter [DS70143]

/// 0.25 / d2, saturating at full scale. [FRM A3: driver of the real robot, 0.5 / sqrt(value)]
std::vector<ResponseRow> inverse_square_table() {
  std::vector<ResponseRow> rows;
  const auto add = [&](double d) {
    const double value = std::min(kFullScale, 0.25 / (d * d));
    rows.push_back({d, value, value >= kFullScale ? 0.005 : std::min(0.3, 3.0 / value + 0.01)});
  };
  rows.push_back({0, kFullScale, 0.005});
  add(std::sqrt(0.25 / kFullScale));
  for (int mm = 8; mm < 30; ++mm) add(0.001 * mm);
  for (int mm = 30; mm < 60; mm += 2) add(0.001 * mm);
  for (int mm = 60; mm <= 100; mm += 5) add(0.001 * mm);
  return rows;
}

/// m (c - x0^2) / (x^2 - 2 x0 x + c) with x in cm, saturating below x0; noise of 10 counts.
/// [Enki: IRSensor.cpp]
std::vector<ResponseRow> enki_table() {
  constexpr double m = 3731, x0_cm = 0.3, c_cm2 = 0.7, noise_counts = 10, range_mm = 120;
  std::vector<ResponseRow> rows;
  const auto add = [&](double mm) {
    const double x = 0.1 * mm;
    const double value = x <= x0_cm ? m : m * (c_cm2 - x0_cm * x0_cm) / (x * x - 2 * x0_cm * x + c_cm2);
    rows.push_back({0.001 * mm, value, noise_counts / value});
  };
  add(0);
  for (double mm = 3; mm < 20; mm += 1) add(mm);
  for (double mm = 20; mm < 40; mm += 2) add(mm);
  for (double mm = 40; mm < range_mm; mm += 5) add(mm);
  add(range_mm);
  rows.push_back({0.001 * range_mm + 1e-6, 0, 0});
  return rows;
}

/// 298.701 d2 - 36.8961 d + 1.08212 of full scale, nothing beyond 5 cm. [ARGoS]
std::vector<ResponseRow> argos_table() {
  std::vector<ResponseRow> rows;
  for (int k = 0; k <= 20; ++k) {
    const double d = 0.0025 * k;
    const double part = 298.701 * d * d - 36.8961 * d + 1.08212;
    rows.push_back({d, kFullScale * std::clamp(part, 0.0, 1.0), 0});
  }
  rows.push_back({0.050001, 0, 0});
  return rows;
}

std::vector<ProximityProfile> make_profiles() {
  // [Webots V6 to R2019a: the DistanceSensor lookupTable]
  const std::vector<ResponseRow> webots_old{{0, 4095, .005},  {.005, 3474, .037}, {.01, 2211, .071},
                                            {.02, 676, .105}, {.03, 306, .125},   {.04, 164, .206},
                                            {.05, 90, .269},  {.06, 56, .438},    {.07, 34, .704}};
  // [Webots R2020b and later: same table, measured on the real robot]
  const std::vector<ResponseRow> webots_new{
      {0, 4095, .002},       {.005, 2133.33, .003}, {.01, 1465.73, .007}, {.015, 601.46, .0406},
      {.02, 383.84, .01472}, {.03, 234.93, .0241},  {.04, 158.03, .0287}, {.05, 120, .04225},
      {.06, 104.09, .03065}, {.07, 67.19, .04897}};
  const double enki_aperture = radians(30);  // rays at -15, 0 and 15 degrees [Enki]
  return {
      {"inverse-square", inverse_square_table(), 1, 0, RayLayout::Cone, ColourRule::Old, NoiseLaw::Gaussian,
       false},
      {"webots-old", webots_old, 1, 0, RayLayout::Cone, ColourRule::Old, NoiseLaw::Gaussian, false},
      {"webots-new", webots_new, 1, 0.1, RayLayout::Cone, ColourRule::New, NoiseLaw::Gaussian, false},
      {"enki", enki_table(), 3, enki_aperture, RayLayout::Fan, ColourRule::None, NoiseLaw::Gaussian, true},
      {"argos", argos_table(), 1, 0, RayLayout::Cone, ColourRule::None, NoiseLaw::Uniform, false},
  };
}

/// First setting that is present, from the most special to the most general.
template <typename T>
T inherit(std::optional<T> ProximitySettings::*field, const ProximitySettings* const (&levels)[3],
          T otherwise) {
  for (const ProximitySettings* level : levels) {
    if (level && (level->*field)) return *(level->*field);
  }
  return otherwise;
}

}  // namespace

const std::vector<ProximityProfile>& proximity_profiles() {
  static const std::vector<ProximityProfile> profiles = make_profiles();
  return profiles;
}

const ProximityProfile* find_profile(const std::string& name) {
  for (const ProximityProfile& p : proximity_profiles()) {
    if (name == p.name) return &p;
  }
  return nullptr;
}

ProximityConfig resolve_proximity(const WorldDesc& world, int robot, int sensor) {
  // What the sensor says itself comes before what its robot says, and that before the world.
  const RobotDesc& r = world.robots[static_cast<std::size_t>(robot)];
  const ProximitySettings* own = nullptr;
  for (const SensorDesc& s : r.sensors) {
    if (s.index == sensor) own = &s.proximity;
  }
  const ProximitySettings* const levels[3] = {own, &r.proximity, &world.proximity};
  using S = ProximitySettings;
  const ProximityProfile* profile = find_profile(inherit(&S::profile, levels, std::string(kDefaultProfile)));
  CHECK(profile, "profiles are checked when a world is loaded");
  ProximityConfig c;
  c.profile = profile->name;
  // a table stands for a profile: whichever of the two is named at the nearest level counts
  c.table = profile->table;
  c.rays_answer_singly = profile->rays_answer_singly;
  for (const ProximitySettings* level : levels) {
    if (!level || (!level->table && !level->profile)) continue;
    if (level->table) {
      c.table = *level->table;
      c.profile.clear();
      c.rays_answer_singly = false;
    }
    break;
  }
  // Each of the other settings is inherited alone.
  c.type = inherit(&S::type, levels, SensorType::InfraRed);
  c.rays = c.rays_written = inherit(&S::rays, levels, profile->rays);
  c.aperture_rad = inherit(&S::aperture_rad, levels, profile->aperture_rad);
  c.gaussian_width = inherit(&S::gaussian_width, levels, 1.0);
  c.layout = inherit(&S::layout, levels, profile->layout);
  c.colour_rule = inherit(&S::colour_rule, levels, profile->colour_rule);
  c.noise_law = inherit(&S::noise_law, levels, profile->noise_law);
  c.noise_scale = inherit(&S::noise_scale, levels, 1.0);
  if (c.aperture_rad == 0) c.rays = 1;  // [Webots B2]
  CHECK(c.table.size() >= 2, "a table has two rows or more");
  return c;
}

ProximityConfig config_of(const ProximityProfile& profile) {
  WorldDesc world;
  world.proximity.profile = profile.name;
  world.robots.emplace_back();
  return resolve_proximity(world, 0, 0);
}

std::vector<RayPlan> plan_rays(int rays, double aperture_rad, double gaussian_width, RayLayout layout) {
  // Where the rays pass: at which angle around the axis, and how far out of it. [Webots B2]
  struct Place {
    double azimuth_rad, fraction;
  };
  std::vector<Place> places;
  const auto ring = [&](int count, double fraction) {
    for (int k = 0; k < count; ++k) places.push_back({2 * kPi * k / count, fraction});
  };
  if (layout == RayLayout::Fan) {
    // left to right in the plane
    for (int k = 0; k < rays; ++k) {
      const double f = rays == 1 ? 0 : 1 - 2.0 * k / (rays - 1);
      places.push_back({f >= 0 ? -kPi / 2 : kPi / 2, std::fabs(f)});
    }
  } else if (rays == 1) {
    places.push_back({0, 0});
  } else if (rays == 2) {
    places = {{kPi / 2, 1}, {-kPi / 2, 1}};
  } else if (rays == 3) {
    ring(3, 1);
  } else if (rays <= 8) {
    places.push_back({0, 0});
    ring(rays - 1, 1);
  } else if (rays == 9) {
    ring(3, 0.3);
    ring(6, 1);
  } else if (rays == 10) {
    places.push_back({0, 0});
    ring(3, 0.5);
    ring(6, 1);
  } else {
    // concentric orbits of 3 n + 1 rays each, the outermost on the edge
    places.push_back({0, 0});
    int orbits = 0;
    for (int left = rays - 1; left > 0; left -= 3 * ++orbits + 1) {
    }
    int left = rays - 1;
    for (int n = 1; left > 0; ++n) {
      const int count = std::min(left, 3 * n + 1);
      ring(count, static_cast<double>(n) / orbits);
      left -= count;
    }
  }
  // Their directions, and weights that sum up to 1.
  std::vector<RayPlan> plans;
  double total = 0;
  for (const Place& p : places) {
    RayPlan plan;
    plan.off_axis_rad = 0.5 * p.fraction * aperture_rad;
    const double side = std::sin(plan.off_axis_rad);
    plan.azimuth_rad = p.azimuth_rad;
    plan.dir = {std::cos(plan.off_axis_rad), -side * std::sin(p.azimuth_rad), side * std::cos(p.azimuth_rad)};
    if (std::fabs(plan.dir.y) < 1e-15) plan.dir.y = 0;
    if (std::fabs(plan.dir.z) < 1e-15) plan.dir.z = 0;
    const double spread = aperture_rad * gaussian_width;
    const double reach = plan.off_axis_rad == 0 ? 0 : plan.off_axis_rad / spread;
    plan.weight = std::exp(-reach * reach);  // [Webots B2]
    total += plan.weight;
    plans.push_back(plan);
  }
  if (total > 0) {
    for (RayPlan& plan : plans) plan.weight /= total;
    return plans;
  }
  // nothing has any weight left: those nearest to the axis are what a shrinking width tends to
  double inner_rad = kPi, share = 0;
  for (const RayPlan& plan : plans) inner_rad = std::min(inner_rad, plan.off_axis_rad);
  for (const RayPlan& plan : plans) share += plan.off_axis_rad <= inner_rad + 1e-12 ? 1 : 0;
  for (RayPlan& plan : plans) plan.weight = plan.off_axis_rad <= inner_rad + 1e-12 ? 1 / share : 0;
  return plans;
}

namespace {

/// What is odd about one sensor; empty: nothing.
std::string notice_of(const ProximityConfig& c) {
  if (c.rays < c.rays_written)
    return fmt::format("aperture is 0: one ray on the axis instead of {}", c.rays_written);
  if (c.rays == 1 || c.rays_answer_singly) return {};
  int alive = 0;
  bool on_axis = false;
  for (const RayPlan& plan : plan_rays(c.rays, c.aperture_rad, c.gaussian_width, c.layout)) {
    if (plan.weight == 0) continue;
    ++alive;
    on_axis = on_axis || plan.off_axis_rad == 0;
  }
  const bool zero = c.gaussian_width == 0;
  if (alive == c.rays && !(zero && !on_axis)) return {};
  const std::string width = zero ? std::string("gaussian_width is 0")
                                 : fmt::format("gaussian_width {} is next to nothing", c.gaussian_width);
  if (alive == 1)
    return fmt::format("{}: only the ray on the axis counts, the weight of the other {} is 0", width,
                       c.rays - 1);
  return fmt::format("{}: none of the {} rays lies on the axis, the {} nearest to it count alike", width,
                     c.rays, alive);
}

/// "sensors 0 to 3, 7"
std::string sensor_list(const std::vector<int>& sensors) {
  std::string text = sensors.size() == 1 ? "sensor " : "sensors ";
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < sensors.size() && sensors[last + 1] == sensors[last] + 1) ++last;
    if (i > 0) text += ", ";
    text += fmt::format("{}", sensors[i]);
    if (last > i) text += fmt::format("{}{}", last > i + 1 ? " to " : ", ", sensors[last]);
    i = last;
  }
  return text;
}

/// Of the group with that text, a new one behind the others where there is none yet.
template <class Member>
std::vector<Member>& members_of(std::vector<std::pair<std::string, std::vector<Member>>>& groups,
                                const std::string& text) {
  for (auto& group : groups)
    if (group.first == text) return group.second;
  return groups.emplace_back(text, std::vector<Member>{}).second;
}

}  // namespace

std::vector<std::string> proximity_notices(const WorldDesc& world) {
  // Sensors of a robot that have the same notice are told together, and so are robots.
  std::vector<std::pair<std::string, std::vector<std::string>>> found;  // notice and whom it concerns
  for (int r = 0; r < static_cast<int>(world.robots.size()); ++r) {
    const RobotDesc& robot = world.robots[static_cast<std::size_t>(r)];
    const RobotModel* model = world.model_of(robot);
    if (!model) continue;
    std::vector<std::pair<std::string, std::vector<int>>> mine;
    for (int i = 0; i < static_cast<int>(model->proximity.size()); ++i) {
      const std::string text = notice_of(resolve_proximity(world, r, i));
      if (text.empty()) continue;
      members_of(mine, text).push_back(i);
    }
    for (const auto& [text, sensors] : mine)
      members_of(found, sensor_list(sensors) + ": " + text).push_back(robot.name);
  }
  std::vector<std::string> out;
  for (const auto& [text, robots] : found) {
    const std::string who = robots.size() == 1 ? "robot " + robots[0]
                                               : fmt::format("{} robots, {} first", robots.size(), robots[0]);
    out.push_back("note: " + who + ", " + text);
  }
  return out;
}

ResponseRow look_up(const std::vector<ResponseRow>& table, double distance_m) {
  if (!(distance_m > table.front().distance_m)) return table.front();
  if (distance_m >= table.back().distance_m) return table.back();
  const auto next = std::upper_bound(table.begin(), table.end(), distance_m,
                                     [](double d, const ResponseRow& row) { return d < row.distance_m; });
  const ResponseRow& b = *next;
  const ResponseRow& a = *(next - 1);
  const double f = (distance_m - a.distance_m) / (b.distance_m - a.distance_m);
  return {distance_m, a.value + f * (b.value - a.value),
          a.relative_noise + f * (b.relative_noise - a.relative_noise)};
}

}  // namespace sim
