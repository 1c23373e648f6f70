// SPDX-License-Identifier: MIT
// What a camera recognises, as Webots' Recognition node does: robots and objects with recognition colours
// that lie in its field of view and whose middle nothing hides. The truth, without noise; the camera's own
// picture has no part in it.
#include <algorithm>
#include <cmath>

#include "hal_sim/board/camera_params.h"
#include "programs/puck/puck.h"
#include "sim_core/world/scene.h"

namespace programs {

namespace {

constexpr double kCameraZM = 0.028;  // of the lens above the floor [Webots: E-puck.proto]
constexpr double kMostM = 100;       // [Webots: Recognition.maxRange]

/// A robot or an object that has colours for cameras.
struct Notable {
  int id;
  std::string model;
  const std::vector<sim::Colour>* colours;
  sim::Vec3 middle_m;
  double heading_rad;
  double length_m, width_m, height_m;  // along and across its heading, upwards
  bool is_round;
};

/// All of a scene but the robot itself.
std::vector<Notable> notables(const sim::Scene& scene, int robot, sim::Clicks at) {
  std::vector<Notable> all;
  const sim::WorldDesc& world = scene.world();
  int id = 0;
  // Robots, then objects. Each counts for the ids, also one that cannot be recognised.
  for (int r = 0; r < scene.robots(); ++r) {
    ++id;
    const sim::RobotDesc& desc = world.robots[static_cast<std::size_t>(r)];
    if (r == robot || desc.recognition_colours.empty()) continue;
    const sim::Pose2 pose = scene.pose(r, at);
    const sim::RobotModel& model = *world.model_of(desc);
    all.push_back({id,
                   "e-puck",
                   &desc.recognition_colours,
                   {pose.x_m, pose.y_m, scene.z_m(r) + model.body_height_m / 2},
                   pose.heading_rad,
                   2 * model.body_radius_m,
                   2 * model.body_radius_m,
                   model.body_height_m,
                   true});
  }
  const std::vector<int>& loose = scene.layout().loose_object;
  for (std::size_t o = 0; o < world.objects.size(); ++o) {
    ++id;
    const sim::ObjectDesc& desc = world.objects[o];
    if (desc.recognition_colours.empty()) continue;
    sim::Pose2 pose = desc.pose;
    double z_m = desc.z_m;
    // a loose object is where the engine has it
    const auto moving = std::find(loose.begin(), loose.end(), static_cast<int>(o));
    if (moving != loose.end()) {
      const int body = scene.robots() + static_cast<int>(moving - loose.begin());
      pose = scene.pose(body, at);
      z_m = scene.z_m(body);
    }
    const bool is_box = desc.kind == sim::ObjectKind::Box;
    const double length_m = is_box ? desc.size_m.x : 2 * desc.radius_m;
    const double width_m = is_box ? desc.size_m.y : 2 * desc.radius_m;
    const double height_m = desc.kind == sim::ObjectKind::Ball ? 2 * desc.radius_m : desc.size_m.z;
    all.push_back({id,
                   desc.model,
                   &desc.recognition_colours,
                   {pose.x_m, pose.y_m, z_m + height_m / 2},
                   pose.heading_rad,
                   length_m,
                   width_m,
                   height_m,
                   !is_box});
  }
  return all;
}

}  // namespace

void Puck::recognise(std::int64_t milliseconds, Cycle at, link_packet& to) {
  if (recognition_period_ms_ == 0) return;
  recognition_elapsed_ms_ += milliseconds;
  if (recognition_elapsed_ms_ < recognition_period_ms_) return;
  recognition_elapsed_ms_ = 0;
  // Where the lens is, and how many pixels its picture has.
  const auto camera =
      std::find_if(devices_.begin(), devices_.end(), [](const Device& d) { return d.kind == Kind::Camera; });
  const sim::Scene* scene = board_.scene();
  if (camera == devices_.end() || !scene) return;
  const auto tag = static_cast<std::int64_t>(camera - devices_.begin()) + 1;
  const double columns = camera->needs[0], rows = camera->needs[1], fov_rad = camera->needs[2];
  const double focal = columns / 2 / std::tan(fov_rad / 2);  // pixels
  const int robot = board_.setup().robot;
  const sim::Clicks now = board_.clock().click_at(at);
  const sim::Pose2 pose = scene->pose(robot, now);
  const sim::Frame2 frame(pose);
  const sim::Vec2 ahead = frame.turn({board::kCameraXM, 0});
  const sim::Vec3 lens{pose.x_m + ahead.x, pose.y_m + ahead.y, scene->z_m(robot) + kCameraZM};

  link_packet found{};
  std::int64_t count = 0;
  for (const Notable& n : notables(*scene, robot, now)) {
    const sim::Vec3 way{n.middle_m.x - lens.x, n.middle_m.y - lens.y, n.middle_m.z - lens.z};
    const sim::Vec2 flat = frame.turn_back({way.x, way.y});
    const sim::Vec3 seen{flat.x, flat.y, way.z};  // forward, left, up
    const double distance_m = std::sqrt(seen.x * seen.x + seen.y * seen.y + seen.z * seen.z);
    if (seen.x <= 0 || distance_m > kMostM) continue;
    // as wide as it looks from here
    const double turned_rad = n.heading_rad - pose.heading_rad;
    const double across_m = n.is_round ? n.width_m
                                       : n.length_m * std::fabs(std::sin(turned_rad)) +
                                             n.width_m * std::fabs(std::cos(turned_rad));
    const double column = columns / 2 - focal * seen.y / seen.x, row = rows / 2 - focal * seen.z / seen.x;
    const double wide = focal * across_m / seen.x, high = focal * n.height_m / seen.x;
    if (column + wide / 2 < 0 || column - wide / 2 > columns || row + high / 2 < 0 || row - high / 2 > rows)
      continue;
    // what stands before its middle hides it
    sim::SceneHit hit;
    const sim::Ray ray{lens, {way.x / distance_m, way.y / distance_m, way.z / distance_m}};
    const double reach_m = std::max({n.length_m, n.width_m, n.height_m});
    if (scene->cast(ray, distance_m, robot, now, &hit) && hit.distance_m < distance_m - reach_m) continue;
    ++count;
    const sim::Vec3 place = in_world_axes(seen);
    const bool nue = board_.setup().webots.axes == sim::Axes::Nue;
    link_begin(&found, LINK_RECOGNISED);
    link_int(&found, tag);
    link_int(&found, n.id);
    link_text(&found, n.model.c_str());
    const double numbers[13] = {place.x,
                                place.y,
                                place.z,
                                0,
                                nue ? 1.0 : 0.0,
                                nue ? 0.0 : 1.0,
                                std::remainder(turned_rad, 2 * sim::kPi),
                                across_m,
                                n.height_m,
                                std::floor(column),
                                std::floor(row),
                                std::ceil(wide),
                                std::ceil(high)};
    link_numbers(&found, numbers, 13);
    std::vector<double> colours;
    for (const sim::Colour& c : *n.colours) colours.insert(colours.end(), {c.r, c.g, c.b});
    link_numbers(&found, colours.data(), colours.size());
    link_end(&found);
  }
  link_begin(&to, LINK_RECOGNITION);
  link_int(&to, tag);
  link_int(&to, count);
  link_end(&to);
  link_append(&to, &found);
  link_free(&found);
}

}  // namespace programs
