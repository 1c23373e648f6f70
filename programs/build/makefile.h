// SPDX-License-Identifier: MIT
// Inside programs/build: what a project's Makefile says, asked of make itself. Its rules are not followed:
// only variables are read, by the names that Webots' Makefile.include gives them, and by usual ones.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "files.h"

namespace programs {

struct MakeSays {
  bool is_read = false;                  ///< there is a Makefile, and make understood it
  bool is_webots = false;                ///< it includes Webots' own
  std::vector<std::string> sources;      ///< as named; empty: none named
  std::vector<std::string> options;      ///< of the compiler, C and C++
  std::vector<std::string> cxx_options;  ///< of that of C++ alone
  std::vector<std::string> libraries;    ///< of the linker: -L, -l and the like
};

/// Reads the folder's Makefile. make runs in the folder, at most a minute. `scratch`: a folder for a
/// file; beside it an empty stand-in for Webots' own files is made.
MakeSays ask_makefile(const fs::path& folder, const fs::path& scratch,
                      const std::function<void(const std::string&)>& tell);

}  // namespace programs
