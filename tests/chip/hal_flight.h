// SPDX-License-Identifier: MIT
// Runs of one program under hal_sim and hal_dspic, for tests that hold them against each other.
#pragma once
#include <filesystem>
#include <fstream>

#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"
#include "tests/support/firmware_test.h"
#include "tests/support/memory_end.h"
#include "twinpuck_paths.h"

namespace hal_test {

using firmware_test::MemoryEnd;

constexpr double kSeconds = 2;

/// A run by one HAL.
class Flight {
 public:
  Flight(sim::WorldDesc world, const std::string& hal, const std::string& level = "",
         double seconds = kSeconds) {
    std::vector<std::string> problems;
    twin::Options options;
    options.hal = hal;
    options.optimisation = level;
    twin_ = twin::Twin::open(std::move(world), options, problems);
    for (const auto& p : problems) ADD_FAILURE() << hal << ": " << p;
    if (!twin_) return;
    for (int robot = 0; robot < twin_->robots(); ++robot) {
      lines_.push_back(std::make_shared<MemoryEnd>());
      twin_->mind(robot).board().uart(1).connect(lines_.back());
    }
    while (sim::to_seconds(twin_->simulation().now()) < seconds) {
      twin_->simulation().step();
      leds_.push_back(leds_now());
    }
  }
  bool is_there() const { return twin_ != nullptr; }
  twin::Twin& twin() const { return *twin_; }
  const std::string& text(int robot) const { return lines_[static_cast<std::size_t>(robot)]->text(); }
  /// Of all robots, tick by tick.
  const std::vector<std::uint32_t>& leds() const { return leds_; }
  std::vector<std::int16_t> words(const std::string& name, std::size_t count) const {
    std::vector<std::int16_t> all(count);
    const auto bytes = twin_->mind(0).runner()->data().read_variable(name, 2 * count);
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(all.data()));
    return all;
  }

 private:
  std::uint32_t leds_now() const {
    std::uint32_t all = 0;
    for (int robot = 0; robot < twin_->robots(); ++robot)
      all = 7 * all + static_cast<std::uint32_t>(twin_->mind(robot).report().leds);
    return all;
  }

  std::unique_ptr<twin::Twin> twin_;
  std::vector<std::shared_ptr<MemoryEnd>> lines_;
  std::vector<std::uint32_t> leds_;
};

/// A world with one robot that runs this C.
inline sim::WorldDesc world_with(const std::string& name, const std::string& program) {
  const std::filesystem::path folder = std::filesystem::path(TWINPUCK_BUILD_DIR) / "tests" / ("hal-" + name);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "main.c") << program;
  sim::WorldDesc world;
  world.models = twin::robot_models();
  world.robots.resize(1);
  world.robots[0].name = "puck";
  world.robots[0].firmware = folder.string();
  return world;
}

}  // namespace hal_test
