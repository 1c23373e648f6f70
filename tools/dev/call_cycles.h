// SPDX-License-Identifier: MIT
// The second half of `twinpuck-dev timings`: measures hal_sim/api/call_cycles.inc. A program calls
// hal_dspic's own functions on the chip, each in the states that matter to its time, and a watch counts
// each call's cycles.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace dev {

/// What each number of call_cycles.inc should be at a level, by name. Empty, with lines in
/// `problems`, on failure.
std::map<std::string, int> call_cycles(const std::string& level, std::vector<std::string>& problems);

/// call_cycles.inc's text for the levels -O0, -O1, -O2 and -Os, in the order of its rows.
std::string call_cycles_text(const std::vector<std::map<std::string, int>>& levels);

}  // namespace dev
