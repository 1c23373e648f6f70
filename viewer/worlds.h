// SPDX-License-Identifier: MIT
// Worlds that a view can open beside its own.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace viewer {

/// What a new world begins with.
extern const char* const kNewWorld;

/// The world files of a folder, in order: `file`, its path, and `title`, empty where it has none.
nlohmann::json worlds_json(const std::string& folder);

}  // namespace viewer
