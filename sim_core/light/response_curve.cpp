// SPDX-License-Identifier: MIT
#include "sim_core/light/response_curve.h"

#include "sim_core/base/check.h"

namespace sim {

ResponseCurve::ResponseCurve(const std::vector<ResponseRow>& rows) {
  CHECK(rows.size() >= 2, "a table has two rows or more");
  constexpr std::size_t kBins = 256;
  first_ = rows.front();
  last_ = rows.back();
  const double begin = first_.distance_m;
  const double span = last_.distance_m - begin;
  CHECK(span > 0, "a table's distances grow");
  bins_per_m_ = static_cast<double>(kBins) / span;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const ResponseRow &a = rows[i], &b = rows[i + 1];
    spans_.push_back({a, b.distance_m, 1 / (b.distance_m - a.distance_m), b.value - a.value,
                      b.relative_noise - a.relative_noise});
  }
  const Span* row = spans_.data();
  for (std::size_t bin = 0; bin <= kBins; ++bin) {
    // a hair early, so that rounding in the division can never skip a row
    const double edge = begin + (static_cast<double>(bin) / bins_per_m_) * (1 - 1e-12);
    while (row != &spans_.back() && row->end_m <= edge) ++row;
    bins_.push_back(row);
  }
}

}  // namespace sim
