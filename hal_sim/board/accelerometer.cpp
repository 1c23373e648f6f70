// SPDX-License-Identifier: MIT
// See accelerometer.h. Random streams: kStreamBoard + 32 .. 34, one per axis.
#include "hal_sim/board/accelerometer.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/board.h"
#include "sim_core/random/counter_random.h"
#include "sim_core/world/true_motion.h"

namespace board {

namespace {

constexpr std::uint32_t kStream = sim::kStreamBoard + 32;
constexpr double kTwoPi = 6.283185307179586;

// a one-pole filter's answer is the mean of the past, weighted with exp(-age / tau); Gauss-Laguerre takes it
// at three ages, exactly for motions up to the fifth power of time
constexpr double kAge[3] = {0.4157745567834791, 2.294280360279042, 6.289945082937479};
constexpr double kWeight[3] = {0.7110930099291730, 0.2785177335692408, 0.0103892565015861};

template <typename Ask>
sim::Vec3 filtered(const Board& robot, Cycle at, double pole_hz, Ask ask) {
  const sim::Clicks now = robot.clock().click_at(at) - sim::motion_lag(*robot.scene());
  const double tau_s = 1 / (kTwoPi * pole_hz);
  sim::Vec3 sum;
  for (int i = 0; i < 3; ++i) {
    const sim::Vec3 then = ask(*robot.scene(), robot.setup().robot, now - sim::from_seconds(kAge[i] * tau_s));
    sum = {sum.x + kWeight[i] * then.x, sum.y + kWeight[i] * then.y, sum.z + kWeight[i] * then.z};
  }
  return sum;
}

}  // namespace

sim::Vec3 felt_force_m_s2(const Board& robot, Cycle at, double pole_hz) {
  sim::Vec3 f{0, 0, kStandardGravityMS2};
  if (robot.scene()) f = filtered(robot, at, pole_hz, sim::specific_force_m_s2);
  const auto& offset = robot.setup().acc_offset_m_s2;
  return {f.x + offset[0], f.y + offset[1], f.z + offset[2]};
}

sim::Vec3 felt_turn_rad_s(const Board& robot, Cycle at, double pole_hz) {
  sim::Vec3 w;
  if (robot.scene()) w = filtered(robot, at, pole_hz, sim::angular_rate_rad_s);
  const auto& offset = robot.setup().gyro_offset_rad_s;
  return {w.x + offset[0], w.y + offset[1], w.z + offset[2]};
}

int accelerometer_counts(const Board& robot, int axis, Cycle at, std::uint64_t sample) {
  const double pole_hz = axis == 2 ? kAccPoleZHz : kAccPoleXyHz;
  const sim::Vec3 f = felt_force_m_s2(robot, at, pole_hz);
  double g = (axis == 0 ? f.y : axis == 1 ? f.x : f.z) / kStandardGravityMS2;
  if (robot.setup().motion_noise_scale > 0) {
    const sim::RandomKey key{robot.setup().seed, static_cast<std::uint32_t>(robot.setup().robot),
                             kStream + static_cast<std::uint32_t>(axis)};
    // a pole lets through white noise as a band of pi / 2 times its frequency
    const double noise_g = kAccNoiseGPerRtHz * std::sqrt(0.25 * kTwoPi * pole_hz);
    g += robot.setup().motion_noise_scale * noise_g * sim::random_gaussian(key, sample);
  }
  constexpr double kRail = kAccRailV / kAdcVolts * (kAdcMax + 1);
  const double output = std::clamp(kAccZeroCounts + kAccCountsPerG * g, kRail, kAdcMax + 1 - kRail);
  return static_cast<int>(std::clamp(std::floor(output + 0.5), 0.0, double{kAdcMax}));
}

}  // namespace board
