// SPDX-License-Identifier: MIT
#include "bench/playback.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "bench/processor_time.h"

namespace bench {
namespace {

class Playback final : public sim::RobotMind {
 public:
  explicit Playback(const std::vector<sim::WheelAngles>& angles) : angles_(angles) {}
  void run_until(const sim::Scene&, sim::Clicks) override {}
  sim::WheelCourse wheel_course(sim::Clicks at) override {
    return {angles_[std::min(next_++, angles_.size() - 1)], 0, 0, at, at};
  }
  sim::MindReport report() const override { return {}; }
  int proximity_counts(const sim::Scene&, int) override { return 0; }
  std::uint64_t state_hash() const override { return 0; }

 private:
  const std::vector<sim::WheelAngles>& angles_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<twin::Twin> open_twin(const sim::WorldDesc& world) {
  std::vector<std::string> problems;
  auto twin = twin::Twin::open(world, twin::Options(), problems);
  for (const auto& p : problems) std::fprintf(stderr, "%s\n", p.c_str());
  if (!twin) std::exit(2);
  return twin;
}

WheelTrack track_wheels(const sim::WorldDesc& world, double seconds) {
  WheelTrack track(world.robots.size());
  auto twin = open_twin(world);
  while (twin->simulation().now() < sim::from_seconds(seconds)) {
    twin->simulation().step();
    for (std::size_t r = 0; r < track.size(); ++r) {
      track[r].push_back(twin->mind(static_cast<int>(r))
                             .wheel_course(twin->simulation().now())
                             .at(twin->simulation().now()));
    }
  }
  return track;
}

std::unique_ptr<sim::Simulation> play_back(const sim::WorldDesc& world, const WheelTrack& track) {
  std::vector<std::unique_ptr<sim::RobotMind>> minds;
  for (const auto& angles : track) minds.push_back(std::make_unique<Playback>(angles));
  return std::make_unique<sim::Simulation>(world, std::move(minds), 1);
}

Speed timed_speed(sim::Simulation& simulation, double warm_s, double measured_s) {
  using Wall = std::chrono::steady_clock;
  simulation.run_until(sim::from_seconds(warm_s));
  const auto start = Wall::now();
  const double used_s = processor_s();
  simulation.run_until(sim::from_seconds(warm_s + measured_s));
  return {measured_s / std::chrono::duration<double>(Wall::now() - start).count(),
          measured_s / (processor_s() - used_s)};
}

}  // namespace bench
