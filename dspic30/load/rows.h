// SPDX-License-Identifier: MIT
// Rows that begin at an address, in their order.
#pragma once
#include <algorithm>
#include <cstdint>

namespace dspic {

/// The last of `rows`, sorted by `address`, that begins at or before one; end() if none does.
template <typename Rows, typename Address>
typename Rows::const_iterator last_before(const Rows& rows, std::uint32_t address, Address of) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), address,
                                      [&](std::uint32_t a, const auto& row) { return a < of(row); });
  return after == rows.begin() ? rows.end() : after - 1;
}

/// Rows of equal addresses keep their order.
template <typename All, typename Before>
void sort_rows(All& all, const Before& before) {
  if (!std::is_sorted(all.begin(), all.end(), before)) std::stable_sort(all.begin(), all.end(), before);
}

}  // namespace dspic
