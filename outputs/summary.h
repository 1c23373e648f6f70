// SPDX-License-Identifier: MIT
// What a run comes to: for people, and as JSON for programs (the keys are a contract).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/faults/injector.h"
#include "hal_sim/twin/twin.h"

namespace outputs {

struct RobotSummary {
  std::string name, firmware, hal;
  twin::Program program;
  double x_m = 0, y_m = 0, heading_rad = 0, distance_m = 0;
  int collisions = 0;
  double longest_wall_touch_s = 0;
  std::int64_t left_steps = 0, right_steps = 0;
  std::int64_t cycles = 0;
  double cpu_load = 0;  ///< share of cycles not spent waiting
  double battery_v = 0, battery_used_wh = 0;
  double battery_minutes = -1;  ///< until empty at the run's mean current; negative: nothing was drawn
  std::vector<host::TrapReport> traps;
  std::vector<board::Diagnosis> diagnoses;  ///< docs/controllers.md
};

struct Summary {
  std::string world;
  std::uint64_t seed = 0, digest = 0;
  double simulated_s = 0, wall_s = 0;
  std::vector<RobotSummary> robots;
  std::vector<host::TrapReport> traps;      ///< of all robots
  std::vector<faults::Status> faults;       ///< of the run, in the order in which they were added
  std::optional<sim::RadioCounters> radio;  ///< when a robot has one
};

Summary summarise(const twin::Twin& twin, double wall_s);
std::string to_text(const Summary& summary);
std::string to_json(const Summary& summary);
/// What each robot runs: "puck: ./obstacle, 2 files", a line for robots that run the same.
std::string programs_text(const twin::Twin& twin);
/// A report of a few lines: what, who, where, when, back-trace.
std::string to_text(const host::TrapReport& trap);
/// One line: who, when, where, what, what to do.
std::string to_text(const std::string& robot, const board::Diagnosis& diagnosis);

}  // namespace outputs
