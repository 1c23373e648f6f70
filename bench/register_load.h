// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace bench {

/// One robot of the register way with every interrupt that the library keeps running, `rounds` times ten
/// simulated seconds: times real time on this core, processor time. Returns an exit code.
int measure_register_way(int rounds);

}  // namespace bench
