// SPDX-License-Identifier: MIT
// Inside programs/build: which files of a folder are compiled together.
#pragma once
#include <string>
#include <vector>

#include "kinds.h"
#include "makefile.h"

namespace programs {

/// Lists to try one after the other, each of files from the folder on; empty, with a problem, when there is
/// none. With a Makefile of Webots that names no sources the file with the folder's name comes first, as
/// Webots does it.
std::vector<std::vector<fs::path>> source_lists(const Found& found, const MakeSays& says,
                                                const std::string& said, std::vector<std::string>& problems);

}  // namespace programs
