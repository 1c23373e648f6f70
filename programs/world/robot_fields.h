// SPDX-License-Identifier: MIT
// What supervisors may ask of robots here beyond Webots' own fields: counts, motors, LEDs, power, the
// firmware's variables, sensors that a supervisor makes up. docs/connecting.md lists them.
#pragma once
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "programs/world/catalogue.h"

namespace programs {

struct RobotField {
  enum class What {
    Collisions,
    LongestWallTouch,
    Distance,
    Selector,
    BatteryVoltage,
    Leds,
    Proximity,
    LeftSteps,
    RightSteps,
    CpuLoad,
    Traps,
    ProximityNoise,
    WheelNoise,
    Sensor,
    Variable
  };
  What what;
  const char* name;  ///< one that ends in ':' is followed by words of the program's
  int type;
};

/// A field by all of its name: "variable:speed" is Variable with the words "speed".
struct NamedRobotField {
  const RobotField* field = nullptr;  ///< null: there is none of that name
  std::string words;                  ///< behind ':'
};
NamedRobotField robot_field(const std::string& name);
/// All of them, in order.
const std::vector<RobotField>& robot_fields();

/// What one holds. What is wrong is said; empty: done.
std::string get_robot_field(twin::Twin& twin, int robot, const NamedRobotField& asked,
                            std::vector<double>& numbers, std::vector<std::string>& texts);
/// Between ticks; the change is in the digest.
std::string set_robot_field(twin::Twin& twin, int robot, const NamedRobotField& asked, double value);

}  // namespace programs
