// SPDX-License-Identifier: MIT
// What a user waits for: a run from the command line, a first build, an edited test. Processor time of the
// commands and all they start.
#pragma once

namespace bench {

/// Prints a row each; medians of `rounds`. True when every promise was kept.
bool measure_waits(int rounds);

}  // namespace bench
