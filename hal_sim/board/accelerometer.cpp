// SPDX-License-Identifier: MIT
// See accelerometer.h.
#include "hal_sim/board/accelerometer.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/specimen.h"
#include "sim_core/base/portable_math.h"

namespace board {

namespace {

constexpr double kFaded = 0.01;  // older shares of a filter's answer are left to the oldest counted one

// a one-pole filter's answer is the mean of the past, weighted with exp(-age / tau); Gauss-Laguerre takes it
// at three ages, exactly for motions up to the fifth power of time
constexpr double kAge[3] = {0.4157745567834791, 2.294280360279042, 6.289945082937479};
constexpr double kWeight[3] = {0.7110930099291730, 0.2785177335692408, 0.0103892565015861};

sim::Vec3 plus(const sim::Vec3& a, double k, const sim::Vec3& b) {
  return {a.x + k * b.x, a.y + k * b.y, a.z + k * b.z};
}

double time_constant_s(double pole_hz) { return 1 / (sim::kTwoPi * pole_hz); }

/// The newest instant whose motion is known whenever a sample of `at` may be worked out.
sim::Clicks known(const Specimen& robot, Cycle at) {
  return robot.clock().click_at(at) - sim::motion_lag(*robot.scene());
}

}  // namespace

sim::Vec3 felt_force_m_s2(const Specimen& robot, Cycle at, double pole_hz) {
  sim::Vec3 f{0, 0, kStandardGravityMS2};
  if (robot.scene()) {
    f = {};
    const double tau_s = time_constant_s(pole_hz);
    for (int i = 0; i < 3; ++i) {
      const sim::Clicks then = known(robot, at) - sim::from_seconds(kAge[i] * tau_s);
      f = plus(f, kWeight[i], sim::specific_force_m_s2(*robot.scene(), robot.setup().robot, then));
    }
  }
  const auto& offset = robot.setup().acc_offset_m_s2;
  return {f.x + offset[0], f.y + offset[1], f.z + offset[2]};
}

sim::Vec3 felt_turn_rad_s(const Specimen& robot, Cycle at, double pole_hz) {
  sim::Vec3 w;
  if (robot.scene()) {
    // rates are means over a tick, so the filter is a sum over ticks, and turning in jerks
    // is averaged rightly
    const sim::Clicks tick = sim::motion_lag(*robot.scene());
    const double fading = std::exp(-sim::to_seconds(tick) / time_constant_s(pole_hz));
    double left = 1;
    for (sim::Clicks then = known(robot, at); left > kFaded; then -= tick) {
      const double share = left * fading > kFaded ? 1 - fading : 1;
      w = plus(w, left * share, sim::angular_rate_rad_s(*robot.scene(), robot.setup().robot, then));
      left *= 1 - share;
    }
  }
  const auto& offset = robot.setup().gyro_offset_rad_s;
  return {w.x + offset[0], w.y + offset[1], w.z + offset[2]};
}

static int sound_accelerometer_counts(const Specimen& robot, int axis, Cycle at) {
  const double pole_hz = axis == 2 ? kAccPoleZHz : kAccPoleXyHz;
  const sim::Vec3 f = felt_force_m_s2(robot, at, pole_hz);
  double g = (axis == 0 ? f.y : axis == 1 ? f.x : f.z) / kStandardGravityMS2;
  if (robot.setup().motion_noise_scale > 0) {
    // a pole lets through white noise as a band of pi / 2 times its frequency
    const double noise_g = kAccNoiseGPerRtHz * std::sqrt(0.25 * sim::kTwoPi * pole_hz);
    g += robot.setup().motion_noise_scale * noise_g * robot.noise().normal(NoiseOf::Accelerometer, axis, at);
  }
  constexpr double kRail = kAccRailV / kAdcReferenceV * (kAdcMax + 1);
  const double output = std::clamp(kAccZeroCounts + kAccCountsPerG * g, kRail, kAdcMax + 1 - kRail);
  return static_cast<int>(std::clamp(std::floor(output + 0.5), 0.0, double{kAdcMax}));
}

int accelerometer_counts(const Specimen& robot, int axis, Cycle at) {
  const int counts = sound_accelerometer_counts(robot, axis, at);
  const Damage* const damage = robot.damage();
  if (!damage || damage->acc_stuck.at(at) == 0) return counts;
  const int stuck = damage->acc_counts[static_cast<std::size_t>(axis)];
  if (stuck != counts) damage->note(damage->acc_stood_still, at);
  return stuck;
}

void stick_accelerometer(Specimen& robot, bool is, Cycle at) {
  Damage& d = robot.be_damaged();
  if (is && d.acc_stuck.now() == 0) {
    const Unseen unseen(&d);
    for (int axis = 0; axis < 3; ++axis)
      d.acc_counts[static_cast<std::size_t>(axis)] = accelerometer_counts(robot, axis, at);
    d.acc_since = at;
  }
  d.acc_stuck.set(is ? 1 : 0, at);
}

}  // namespace board
