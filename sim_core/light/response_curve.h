// SPDX-License-Identifier: MIT
// A lookup table that finds its row without searching: equal distance bins say where to begin. Same results
// as look_up(), up to the last bit between rows.
#pragma once
#include <vector>

#include "sim_core/world/proximity_desc.h"

namespace sim {

class ResponseCurve {
 public:
  /// Rows sorted by distance, two or more.
  explicit ResponseCurve(const std::vector<ResponseRow>& rows);
  ResponseCurve(const ResponseCurve&) = delete;
  ResponseCurve& operator=(const ResponseCurve&) = delete;

  /// Value and relative noise at a distance, m.
  ResponseRow at(double distance_m) const {
    if (!(distance_m > first_.distance_m)) return first_;
    if (distance_m >= last_.distance_m) return last_;
    const Span* s = bins_[static_cast<int>((distance_m - first_.distance_m) * bins_per_m_)];
    while (s->end_m <= distance_m) ++s;
    const double f = (distance_m - s->from.distance_m) * s->per_m;
    return {distance_m, s->from.value + f * s->value_rise, s->from.relative_noise + f * s->noise_rise};
  }
  const ResponseRow& first() const { return first_; }

 private:
  /// From one row to the next.
  struct Span {
    ResponseRow from;
    double end_m, per_m, value_rise, noise_rise;
  };
  ResponseRow first_, last_;
  std::vector<Span> spans_;
  std::vector<const Span*> bins_;  // the last that begins at or before it
  double bins_per_m_ = 0;
};

}  // namespace sim
