// SPDX-License-Identifier: MIT
#include "sim_core/light/response_curve.h"

#include "sim_core/base/check.h"

namespace sim {

ResponseCurve::ResponseCurve(std::vector<ResponseRow> rows) : rows_(std::move(rows)) {
  CHECK(rows_.size() >= 2, "a table has two rows or more");
  constexpr std::size_t kBins = 256;
  const double begin = rows_.front().distance_m;
  const double span = rows_.back().distance_m - begin;
  CHECK(span > 0, "a table's distances grow");
  bins_per_m_ = static_cast<double>(kBins) / span;
  for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
    per_span_.push_back(1 / (rows_[i + 1].distance_m - rows_[i].distance_m));
  }
  std::size_t row = 0;
  for (std::size_t bin = 0; bin <= kBins; ++bin) {
    // a hair early, so that rounding in the division can never skip a row
    const double edge = begin + (static_cast<double>(bin) / bins_per_m_) * (1 - 1e-12);
    while (row + 2 < rows_.size() && rows_[row + 1].distance_m <= edge) ++row;
    first_.push_back(row);
  }
}

}  // namespace sim
