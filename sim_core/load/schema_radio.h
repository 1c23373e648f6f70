// SPDX-License-Identifier: MIT
// Schema entries of the room radio: the channel, and short-range links.
#pragma once
#include <vector>

#include "sim_core/load/schema.h"

namespace sim {

/// `[radio]` and `[bluetooth]`.
void add_radio_sections(std::vector<SectionSpec>& sections);
/// `[robot.bluetooth]`, which stands among the robot's sections.
void add_robot_link_section(std::vector<SectionSpec>& sections);

}  // namespace sim
