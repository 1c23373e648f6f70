// SPDX-License-Identifier: MIT
// A lookup table that finds its row without searching: equal distance bins say where to begin. Same results
// as look_up(), up to the last bit between rows.
#pragma once
#include <vector>

#include "sim_core/world/world_desc.h"

namespace sim {

class ResponseCurve {
 public:
  /// Rows sorted by distance, two or more.
  explicit ResponseCurve(std::vector<ResponseRow> rows);

  /// Value and relative noise at a distance, m.
  ResponseRow at(double distance_m) const {
    if (!(distance_m > rows_.front().distance_m)) return rows_.front();
    if (distance_m >= rows_.back().distance_m) return rows_.back();
    std::size_t i = first_[static_cast<std::size_t>((distance_m - rows_.front().distance_m) * bins_per_m_)];
    while (rows_[i + 1].distance_m <= distance_m) ++i;
    const ResponseRow& a = rows_[i];
    const ResponseRow& b = rows_[i + 1];
    const double f = (distance_m - a.distance_m) * per_span_[i];
    return {distance_m, a.value + f * (b.value - a.value),
            a.relative_noise + f * (b.relative_noise - a.relative_noise)};
  }

 private:
  std::vector<ResponseRow> rows_;
  std::vector<std::size_t> first_;  // per bin: the last row that begins at or before it
  std::vector<double> per_span_;    // per row: 1 / distance to the next
  double bins_per_m_ = 0;
};

}  // namespace sim
