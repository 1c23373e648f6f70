// SPDX-License-Identifier: MIT
// The simplest mind that drives, for tests and benchmarks of the world alone.
#pragma once
#include "sim_core/simulation.h"

namespace sim_test {

/// Wheels turn at constant speeds, rad/s.
class Cruise : public sim::RobotMind {
 public:
  Cruise(double left_rad_s, double right_rad_s) : left_(left_rad_s), right_(right_rad_s) {
    set_idle_until(sim::kEver);
  }
  void run_until(const sim::Scene&, sim::Clicks) override {}
  sim::WheelCourse wheel_course(sim::Clicks at) override {
    constexpr double per_click = 1.0 / static_cast<double>(sim::kClicksPerSecond);
    return {{left_ * sim::to_seconds(at), right_ * sim::to_seconds(at)},
            left_ * per_click,
            right_ * per_click,
            at,
            sim::kEver};
  }
  sim::MindReport report() const override { return {}; }
  int proximity_counts(const sim::Scene&, int) override { return 0; }
  std::uint64_t state_hash() const override { return 0; }

 private:
  double left_, right_;
};

}  // namespace sim_test
