// SPDX-License-Identifier: MIT
// Each drawn quantity has its own counter, so adding one later moves none of the others.
#include "sim_core/world/variation.h"

#include "sim_core/base/check.h"
#include "sim_core/random/counter_random.h"
#include "sim_core/world/world_desc.h"

namespace sim {

std::uint64_t robot_seed(const WorldDesc& world, int robot) {
  const RobotDesc& r = world.robots[static_cast<std::size_t>(robot)];
  return r.seed ? *r.seed : mix64(world.seed ^ mix64(static_cast<std::uint64_t>(robot)));
}

ResolvedVariation resolve_variation(const WorldDesc& world, int robot) {
  const RobotDesc& r = world.robots[static_cast<std::size_t>(robot)];
  const RobotModel* model = world.model_of(r);
  CHECK(model, "every robot has a model");
  const Variation& v = r.variation;
  ResolvedVariation out;
  out.seed = robot_seed(world, robot);
  const RandomKey key{out.seed, 0, kStreamVariation};
  const auto draw = [&](std::uint64_t counter, double spread) {
    return spread == 0 ? 0.0 : spread * random_gaussian(key, counter);
  };
  out.left_wheel_ratio = v.left_wheel_ratio * (1 + draw(0, v.wheel_spread));
  out.right_wheel_ratio = v.right_wheel_ratio * (1 + draw(1, v.wheel_spread));
  out.axle_ratio = v.axle_ratio * (1 + draw(2, v.axle_spread));
  out.clock_ppm = v.clock_ppm + draw(3, v.clock_spread_ppm);
  out.boot_delay_s = v.boot_delay_s + v.boot_spread_s * random_uniform(key, 4);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.acc_offset_m_s2[axis] = v.acc_offset_m_s2[axis] + draw(10 + axis, v.acc_offset_spread_m_s2);
    out.gyro_offset_rad_s[axis] = v.gyro_offset_rad_s[axis] + draw(13 + axis, v.gyro_offset_spread_rad_s);
  }
  for (std::size_t s = 0; s < model->proximity.size(); ++s) {
    const double gain = s < v.sensor_gain.size() ? v.sensor_gain[s] : 1.0;
    const double offset = s < v.sensor_offset_counts.size() ? v.sensor_offset_counts[s] : 0.0;
    out.sensor_gain.push_back(gain * (1 + draw(100 + s, v.gain_spread)));
    out.sensor_offset_counts.push_back(offset + draw(200 + s, v.offset_spread_counts));
  }
  return out;
}

}  // namespace sim
