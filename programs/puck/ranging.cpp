// SPDX-License-Identifier: MIT
#include "programs/puck/ranging.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace programs {

namespace {

/// Where a device is on the floor, and the way it looks.
struct Eye {
  sim::Vec3 at_m;
  double heading_rad;
};

Eye eye_of(const sim::Scene& scene, int robot, const sim::DeviceDesc& device, sim::Clicks at) {
  const sim::Pose2 pose = scene.pose(robot, at);
  const sim::Vec2 off = sim::Frame2(pose).turn({device.at_m.x, device.at_m.y});
  return {{pose.x_m + off.x, pose.y_m + off.y, scene.z_m(robot) + device.at_m.z},
          pose.heading_rad + device.heading_rad};
}

/// m along a ray, `left` and `up` of the way it looks; the limit when there is nothing.
double along(const sim::Scene& scene, int robot, const Eye& eye, double left_rad, double up_rad,
             double limit_m, sim::Clicks at) {
  const double yaw = eye.heading_rad + left_rad, flat = std::cos(up_rad);
  const sim::Ray ray{eye.at_m, {flat * std::cos(yaw), flat * std::sin(yaw), std::sin(up_rad)}};
  sim::SceneHit hit;
  return scene.cast(ray, limit_m, robot, at, &hit) ? hit.distance_m : limit_m;
}

}  // namespace

std::vector<double> ranges(const sim::Scene& scene, int robot, const sim::DeviceDesc& device,
                           sim::Clicks at) {
  const int columns = device.width, rows = device.height;
  const Eye eye = eye_of(scene, robot, device, at);
  const bool flat = device.kind == sim::DeviceKind::RangeFinder;  // a picture on a plane
  const double half = std::min(device.fov_rad / 2, flat ? 1.5 : sim::kPi);
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      // middles of pixels, from -1 on the left to 1 on the right
      const double right = (2 * column + 1.0) / columns - 1, down = (2 * row + 1.0) / rows - 1;
      double left_rad = -right * half, up_rad = 0, shorter = 1;
      if (flat) {
        const double x = right * std::tan(half), y = -down * std::tan(half) * rows / columns;
        left_rad = -std::atan(x);
        up_rad = std::atan2(y, std::hypot(1, x));
        shorter = std::cos(left_rad) * std::cos(up_rad);
      }
      if (!flat && rows > 1) up_rad = device.vertical_fov_rad * (0.5 - row / (rows - 1.0));
      const double limit = device.far_m / shorter;
      const double distance = along(scene, robot, eye, left_rad, up_rad, limit, at);
      const double range = distance * shorter;
      out.push_back(distance >= limit || range < device.near_m ? std::numeric_limits<double>::infinity()
                                                               : range);
    }
  return out;
}

double looked_up(const std::vector<sim::ResponseRow>& table, double distance_m) {
  if (distance_m <= table.front().distance_m) return table.front().value;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const sim::ResponseRow &a = table[i - 1], &b = table[i];
    if (distance_m < b.distance_m)
      return a.value + (b.value - a.value) * (distance_m - a.distance_m) / (b.distance_m - a.distance_m);
  }
  return table.back().value;
}

double measured_distance(const sim::Scene& scene, int robot, const sim::DeviceDesc& device, sim::Clicks at) {
  const Eye eye = eye_of(scene, robot, device, at);
  const double limit = device.table.back().distance_m;
  double sum = 0;
  for (int i = 0; i < device.rays; ++i) {
    const double left = device.rays == 1 ? 0 : device.aperture_rad * (0.5 - i / (device.rays - 1.0));
    sum += along(scene, robot, eye, left, 0, limit, at);
  }
  return looked_up(device.table, sum / device.rays);
}

}  // namespace programs
