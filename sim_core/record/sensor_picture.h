// SPDX-License-Identifier: MIT
// Drawings for whoever edits sensors, by cairo, PNG or SVG by the file's extension: one sensor's rays in
// plan, their heights at the side and the place on the response curve; and response curves by themselves.
#pragma once
#include <string>
#include <vector>

#include "sim_core/light/explain.h"

namespace sim {

class Scene;

/// A line of a plot of counts against distance, with the band that noise gives it.
struct CurveLine {
  std::string name;
  struct Point {
    double distance_m = 0;
    double counts = 0;
    double low = 0;   ///< lower edge of the noise band, counts
    double high = 0;  ///< upper edge, counts
  };
  std::vector<Point> points;       ///< distances growing
  std::vector<ResponseRow> table;  ///< rows to mark on the line; may be empty
};

struct CurvePlotOptions {
  int width_px = 1000;
  int height_px = 620;
  std::string title;
  std::string caption;  ///< second line; may be empty
  const char* band = "noise band";
};

/// Draws lines of counts against distance and writes the file. Returns an empty string, or
/// "FILE: what is wrong".
std::string write_curve_plot(const std::string& path, const std::vector<CurveLine>& lines,
                             const CurvePlotOptions& options);

struct SensorPictureOptions {
  int width_px = 1200;
  int height_px = 720;
  std::string title, caption;
};

/// Draws one explained reading: plan on the left (red up to the hit, orange for what the colour adds, green
/// on to the range), heights and the curve on the right. Same return as above.
std::string write_sensor_picture(const std::string& path, const Scene& scene, int robot, Clicks at,
                                 const ProximityExplanation& reading, const CurveLine& curve,
                                 const SensorPictureOptions& options);

}  // namespace sim
