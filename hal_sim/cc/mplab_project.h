// SPDX-License-Identifier: MIT
// The project files of Microchip's MPLAB beside a controller: which C files belong to the program, and where
// it looks for headers. A folder often holds more than its program: older versions of a file, a second
// main().
//
// Read are *.mcp (MPLAB 6 to 8) and nbproject/configurations.xml (MPLAB X), also in a folder *.X, which name
// files relative to themselves or by the path they had on their author's PC. Of an absolute path the longest
// end that exists in the folder or in one of three folders above it is taken.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

namespace cc {

struct MplabProject {
  std::filesystem::path file;
  std::vector<std::filesystem::path> sources;       ///< C files that exist, within the folder and without
  std::vector<std::filesystem::path> include_dirs;  ///< folders that exist
};

/// The project of `folder`: the only one of which a listed file has a main(). None: there is none, or
/// several.
std::optional<MplabProject> find_mplab_project(const std::filesystem::path& folder);

/// Whether a C file has a main() of its own.
bool defines_main(const std::filesystem::path& source);

}  // namespace cc
