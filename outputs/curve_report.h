// SPDX-License-Identifier: MIT
// Response curves as tables and plots: what a sensor answers to a flat wall of some colour at each distance.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim_core/light/profiles.h"
#include "sim_core/record/sensor_picture.h"
#include "sim_core/world/layout.h"

namespace outputs {

/// One curve to be shown.
struct CurveRequest {
  std::string name;
  sim::ProximityConfig config;
  double gain = 1;           ///< of one robot's sensor
  double offset_counts = 0;  ///< same
};

/// A curve over a wall with this surface, its table's rows marked when the wall is white and rays are one.
sim::CurveLine curve_line(const CurveRequest& request, const sim::Surface& surface);

/// Every curve's counts, noise and slope at round distances and at the rows of its table.
std::string curve_table(const std::vector<CurveRequest>& requests, const sim::Surface& surface);
nlohmann::ordered_json curve_json(const std::vector<CurveRequest>& requests, const sim::Surface& surface);

}  // namespace outputs
