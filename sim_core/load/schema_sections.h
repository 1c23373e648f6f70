// SPDX-License-Identifier: MIT
// Sections of the schema that stand in files of their own, and what these share with the table in schema.cpp.
#pragma once
#include <string>

#include "sim_core/load/schema.h"

namespace sim {

/// The material named, or what to say when there is none.
std::string find_material(const WorldDesc& draft, const std::string& name, Material& out);

SectionSpec ramp_section();  ///< schema_ground.cpp

}  // namespace sim
