// SPDX-License-Identifier: MIT
// Plot of a share of runs against a quantity, with the interval in which the true share lies.
#pragma once
#include <string>
#include <vector>

namespace sim {

struct SharePoint {
  double x = 0;      ///< the quantity, 0 or more
  double share = 0;  ///< 0 to 1
  int runs = 0;      ///< behind the share, 1 or more
};

struct SharePlot {
  std::string title;
  std::string across;  ///< what x is
  std::vector<SharePoint> points;
};

/// PNG or SVG by the ending of `path`. Returns an empty string, or "FILE: what is wrong".
std::string write_share_plot(const std::string& path, const SharePlot& plot);

}  // namespace sim
