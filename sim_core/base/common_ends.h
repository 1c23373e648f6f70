// SPDX-License-Identifier: MIT
// Where two texts that differ in one place do so.
#pragma once
#include <algorithm>
#include <cstddef>
#include <string_view>

namespace sim {

/// Bytes that two texts have in common at their beginnings and, behind those, at their ends.
struct CommonEnds {
  std::size_t head = 0, tail = 0;
};
inline CommonEnds common_ends(std::string_view before, std::string_view after) {
  const std::size_t shorter = std::min(before.size(), after.size());
  CommonEnds ends;
  while (ends.head < shorter && before[ends.head] == after[ends.head]) ++ends.head;
  while (ends.tail < shorter - ends.head &&
         before[before.size() - 1 - ends.tail] == after[after.size() - 1 - ends.tail])
    ++ends.tail;
  return ends;
}

}  // namespace sim
