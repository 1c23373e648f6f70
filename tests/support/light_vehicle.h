// SPDX-License-Identifier: MIT
// What the tests of Braitenberg's vehicles share: starts around the lamp of worlds/braitenberg.toml, each
// with its own seed and unequal wheels, and what one would note down when watching.
#pragma once
#include <cmath>
#include <vector>

#include "tests/support/firmware_test.h"

namespace firmware_test {

/// What was seen at one moment.
struct Glimpse {
  double away_m;         ///< from the point below the lamp
  double aside_deg;      ///< between the robot's nose and the lamp, 0 straight at it, 180 away from it
  double speed_steps_s;  ///< mean of both wheels over the time since the glimpse before
};

class LightVehicle : public FirmwareTest, public ::testing::WithParamInterface<int> {
 protected:
  /// Start number 0 to 7: so far from the lamp, all around it, the nose 6 to 30 degrees off to either side.
  Robot& start(const std::string& firmware, int number, double away_m) {
    constexpr double kOff[8] = {-30, -22, -14, -6, 6, 14, 22, 30};
    load_world("worlds/braitenberg.toml");
    world.seed = static_cast<std::uint64_t>(number) + 1;
    const double bearing = sim::radians(45.0 * number);
    Robot& vehicle = robot(0);
    vehicle.at(away_m * std::cos(bearing), away_m * std::sin(bearing),
               45.0 * number + 180 + kOff[number % 8]);
    vehicle.settings().firmware = firmware;
    vehicle.settings().variation.wheel_spread = 0.01;
    return vehicle;
  }

  double away_m(const Robot& vehicle) const { return std::hypot(vehicle.x_m(), vehicle.y_m()); }
  double aside_deg(const Robot& vehicle) const {
    const double to_lamp = std::atan2(-vehicle.y_m(), -vehicle.x_m());
    return std::fabs(
        sim::degrees(std::remainder(to_lamp - sim::radians(vehicle.heading_deg()), 2 * sim::kPi)));
  }

  /// Watches for so long, ten times a second.
  std::vector<Glimpse> watch(const Robot& vehicle, double seconds) {
    std::vector<Glimpse> seen;
    std::int64_t steps = vehicle.left_steps() + vehicle.right_steps();
    for (int i = 0; i < static_cast<int>(10 * seconds); ++i) {
      run_for(0.1);
      const std::int64_t now = vehicle.left_steps() + vehicle.right_steps();
      seen.push_back({away_m(vehicle), aside_deg(vehicle), static_cast<double>(now - steps) / 2 / 0.1});
      steps = now;
    }
    return seen;
  }

  /// Mean speed over the last second of what was seen.
  static double last_speed(const std::vector<Glimpse>& seen) {
    double sum = 0;
    for (std::size_t i = seen.size() - 10; i < seen.size(); ++i) sum += seen[i].speed_steps_s;
    return sum / 10;
  }
};

}  // namespace firmware_test
