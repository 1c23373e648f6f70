// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <vector>

namespace bench {

/// The upper one of two in the middle. Not of an empty list.
inline double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

}  // namespace bench
