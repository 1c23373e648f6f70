// SPDX-License-Identifier: MIT
#include "viewer/pace.h"

#include "sim_core/simulation.h"

namespace viewer {

namespace {

using namespace std::chrono_literals;
constexpr auto kMeanOver = 500ms;
constexpr double kMostLate_s = 0.25;

double seconds(Pace::Wall::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

void Pace::begin(sim::Clicks now) {
  anchor_ = measured_from_ = now;
  anchor_wall_ = measured_wall_ = wall_();
}

void Pace::play(bool on, sim::Clicks now) {
  plays_ = on;
  anchor_ = now;
  anchor_wall_ = wall_();
}

void Pace::set_speed(double speed, sim::Clicks now) {
  speed_ = speed;
  play(plays_, now);
}

sim::Clicks Pace::due(sim::Clicks now) {
  if (speed_ == 0) return sim::kEver;
  const auto wall = wall_();
  if (seconds(wall - anchor_wall_) * speed_ - sim::to_seconds(now - anchor_) > kMostLate_s * speed_) {
    anchor_ = now;
    anchor_wall_ = wall;
  }
  return anchor_ + sim::from_seconds(seconds(wall - anchor_wall_) * speed_);
}

double Pace::wait_s(sim::Clicks now) const {
  if (speed_ == 0) return 0;
  return sim::to_seconds(now - anchor_) / speed_ - seconds(wall_() - anchor_wall_);
}

void Pace::measure(sim::Clicks now) {
  const auto wall = wall_();
  if (!plays_) {
    measured_ = 0;
  } else if (wall - measured_wall_ <= kMeanOver) {
    return;
  } else {
    measured_ = sim::to_seconds(now - measured_from_) / seconds(wall - measured_wall_);
  }
  measured_wall_ = wall;
  measured_from_ = now;
}

}  // namespace viewer
