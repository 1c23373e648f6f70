// SPDX-License-Identifier: MIT
// Whether two placed solids share space, in 3-D (by libccd, the only file that includes it).
#pragma once
#include "sim_core/geometry/solid.h"

namespace sim {

/// True when the two solids overlap by more than about `slack_m` (each is shrunk by half of it, so that
/// bodies that only touch, such as a box on the floor of a shelf, do not count).
bool overlaps(const Placed& a, const Placed& b, double slack_m);

}  // namespace sim
