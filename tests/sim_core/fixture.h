// SPDX-License-Identifier: MIT
// What the world's tests share: a test robot's model, minds of three lines, worlds from a raw string.
#pragma once
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "sim_core/base/hash.h"
#include "sim_core/light/proximity.h"
#include "sim_core/load/world_loader.h"
#include "sim_core/simulation.h"
#include "tests/support/cruise.h"
#include "twinpuck_paths.h"

namespace sim_test {

/// A file in the build's folder, for pictures and recordings; people may look at them after the tests.
inline std::string scratch(const std::string& name) {
  ::mkdir(TWINPUCK_BUILD_DIR "/tests/scratch", 0777);
  return TWINPUCK_BUILD_DIR "/tests/scratch/" + name;
}

/// All that a file has in it.
inline std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A puck of 37 mm with eight level sensors 33 mm from its middle, numbered like a clock from front right.
inline sim::RobotModel puck() {
  sim::RobotModel m;
  m.name = "puck";
  const double x[8] = {.0335, .023, 0, -.030, -.030, 0, .023, .0335};
  const double y[8] = {-.0105, -.026, -.033, -.018, .018, .033, .026, .0105};
  const double yaw_deg[8] = {-18, -45, -90, -142, 142, 90, 45, 18};
  m.keys = {{"selector", sim::OwnKeyType::Integer, "", 0, 15, "", "0", "position of a switch"}};
  for (int i = 0; i < 8; ++i) m.proximity.push_back({{x[i], y[i], 0.025}, sim::radians(yaw_deg[i]), 0});
  return m;
}

/// One sensor in the middle of the robot that looks straight ahead from a height of 25 mm.
inline sim::RobotModel one_eyed() {
  sim::RobotModel m;
  m.name = "one-eyed";
  m.keys = {{"selector", sim::OwnKeyType::Integer, "", 0, 15, "", "0", "position of a switch"}};
  m.proximity = {{{0.037, 0, 0.025}, 0, 0}};
  return m;
}

/// The peers' Braitenberg controller, every 64 ms: eight readings at four instants, two speeds.
class Braitenberg : public sim::RobotMind {
 public:
  explicit Braitenberg(int robot) : robot_(robot) {}
  void run_until(const sim::Scene& scene, sim::Clicks end) override {
    for (; next_ < end; next_ += kPeriod) {
      turn_until(next_);
      double left = 8, right = 8;
      constexpr double wl[8] = {-1.3, -1, -.5, 0, 0, .5, 1, 1.1}, wr[8] = {1.1, 1, .5, 0, 0, -.5, -1, -1.3};
      for (int s = 0; s < 8; ++s) {
        const sim::Clicks at = std::max<sim::Clicks>(0, next_ - (3 - s % 4) * 57600);
        const double p = std::min(1.0, sim::sense_proximity(scene, robot_, s, at).value / 1000);
        left += 8 * wl[s] * p;
        right += 8 * wr[s] * p;
      }
      const double limit = 12.8;
      left_ = std::max(-limit, std::min(limit, left)) / 2.05;
      right_ = std::max(-limit, std::min(limit, right)) / 2.05;
    }
    turn_until(end);
    set_idle_until(next_ + 1);
  }
  sim::WheelCourse wheel_course(sim::Clicks at) override {
    constexpr double per_click = 1.0 / static_cast<double>(sim::kClicksPerSecond);
    turn_until(at);
    return {angles_, left_ * per_click, right_ * per_click, at, next_};
  }
  sim::MindReport report() const override { return {}; }
  int proximity_counts(const sim::Scene& scene, int s) override {
    return static_cast<int>(sim::sense_proximity(scene, robot_, s, scene.now()).value);
  }
  std::uint64_t state_hash() const override { return sim::fold(sim::fold(1, left_), right_); }

 private:
  static constexpr sim::Clicks kPeriod = 943718;  // 64 ms
  void turn_until(sim::Clicks at) {
    angles_.left_rad += left_ * sim::to_seconds(at - turned_);
    angles_.right_rad += right_ * sim::to_seconds(at - turned_);
    turned_ = at;
  }
  int robot_;
  sim::Clicks next_ = 0, turned_ = 0;
  double left_ = 0, right_ = 0;
  sim::WheelAngles angles_;
};

/// Parses a world that must be good.
inline sim::WorldDesc world_of(const std::string& toml,
                               std::vector<sim::RobotModel> models = {puck(), one_eyed()}) {
  sim::LoadedWorld loaded = sim::parse_world(toml, "test.toml", models);
  EXPECT_TRUE(loaded.world) << loaded.report("test.toml");
  return loaded.world ? *loaded.world : sim::WorldDesc{};
}

using MakeMind = std::function<std::unique_ptr<sim::RobotMind>(int robot)>;

inline std::unique_ptr<sim::Simulation> simulation_of(const sim::WorldDesc& world, const MakeMind& make,
                                                      int threads = 1) {
  std::vector<std::unique_ptr<sim::RobotMind>> minds;
  for (int r = 0; r < static_cast<int>(world.robots.size()); ++r) minds.push_back(make(r));
  return std::make_unique<sim::Simulation>(world, std::move(minds), threads);
}

inline std::unique_ptr<sim::Simulation> cruising(const sim::WorldDesc& world, double left_rad_s,
                                                 double right_rad_s) {
  return simulation_of(world, [&](int) { return std::make_unique<Cruise>(left_rad_s, right_rad_s); });
}

inline void run_for(sim::Simulation& simulation, double seconds) {
  simulation.run_until(simulation.now() + sim::from_seconds(seconds));
}

}  // namespace sim_test
