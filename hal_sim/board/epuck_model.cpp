// SPDX-License-Identifier: MIT
#include "hal_sim/board/epuck_model.h"

namespace board {

sim::RobotModel epuck_model() {
  sim::RobotModel m;
  m.name = "e-puck";
  const double x[8] = {.030, .022, 0, -.030, -.030, 0, .022, .030}, y[8] = {-.010, -.025, -.031, -.015, .015, .031, .025, .010};
  const double yaw[8] = {-17.2, -45.9, -90, -151.5, 151.2, 90, 45.8, 17.1};
  for (int i = 0; i < 8; ++i) m.proximity.push_back({{x[i], y[i], 0.033}, sim::radians(yaw[i]), 0});
  return m;
}

}  // namespace board
