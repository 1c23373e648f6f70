// SPDX-License-Identifier: MIT
// Where robots spend their time: counts ticks per square cell, over all robots, as a picture with a colour
// bar (PNG, SVG) or as numbers (CSV). Cells are squares whose corners lie at multiples of their side.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim_core/world/scene.h"

namespace sim {

class Heatmap {
 public:
  /// `cell_m`: side of a cell, above 0.
  Heatmap(int robots, double cell_m);
  /// Call after every step: each robot's middle is in one cell for that tick.
  void sample(const Scene& scene);

  struct Cell {
    int column = 0;  ///< x from column * cell_m on
    int row = 0;     ///< y from row * cell_m on
    std::int64_t ticks = 0;
  };
  /// Cells that were visited, by row, then by column.
  std::vector<Cell> cells() const;
  /// Ticks of all robots together.
  std::int64_t total_ticks() const { return total_; }
  double cell_m() const { return cell_m_; }

 private:
  using Place = std::pair<int, int>;  // row, column
  struct Stay {
    Place place;
    std::int64_t ticks = 0;
  };
  double cell_m_;
  std::int64_t total_ = 0;
  std::vector<Stay> stays_;  // per robot, not yet in ticks_
  std::map<Place, std::int64_t> ticks_;
};

struct HeatmapOptions {
  int width_px = 1200;  ///< the longer side of the map
  bool linear = false;  ///< scale of the colours; otherwise by orders of magnitude
  std::string caption;  ///< under the title
};

/// The ending says what is written: .png and .svg a picture, .csv one row `x_m,y_m,time_s,share` for each
/// visited cell (its middle; all robots' time in it; its share of all robots' time), from the south west on.
/// Returns an empty string, or "FILE: what is wrong".
std::string write_heatmap(const std::string& path, const Heatmap& heatmap, const Scene& scene,
                          const HeatmapOptions& options = {});

/// The colours' scale, 0 to 1: dark blue to yellow, the same steps to the eye everywhere.
Colour heat_colour(double part);

}  // namespace sim
