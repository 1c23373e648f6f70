// SPDX-License-Identifier: MIT
// bench --engines: the three motion engines side by side, in speed and in behaviour (docs/worlds.md).
#pragma once
#include <string>

namespace bench {

/// Prints both tables; `worlds` is the folder that holds engines.toml. Returns the exit code: 1 when the
/// planar engine was not the faster one than the dynamic one, 2 when the world is bad.
int compare_engines(const std::string& worlds, int rounds);

}  // namespace bench
