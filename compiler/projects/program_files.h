// SPDX-License-Identifier: MIT
// Which files a program consists of, and how its own project or Makefile wants them compiled.
#pragma once
#include <algorithm>
#include <set>

#include "compiler/cache/options.h"
#include "library_copies.h"

namespace cc {

/// The C files of a program. Those that its project file does not list are there for whatever asks for them.
struct Program {
  std::vector<std::filesystem::path> sources, include_dirs;
  std::set<std::filesystem::path> unlisted;
  bool has_project = false;  // a file that lists the sources
  bool is_exact = false;     // of a Makefile for Webots: nothing else is compiled
  std::vector<std::string> defines;
  std::string standard, level;              // "" unless given
  std::vector<std::string> library_places;  // of what it lists of the library and is not compiled from it
  std::vector<std::filesystem::path> assembler;        // sources of its own
  std::set<std::filesystem::path> unlisted_assembler;  // of those what a Makefile does not list
  std::vector<std::filesystem::path> objects;          // and objects and archives, of XC16

  /// The `own` first files to compile are the program's, the others members of a library: unlisted ones
  /// become the last of them. How many are own now.
  std::size_t order(LibraryCopies& copies, std::size_t own) const {
    const auto is_listed = [this](const std::filesystem::path& source) { return !unlisted.count(source); };
    const auto first = copies.kept.begin();
    const auto still_own = std::count_if(first, first + std::ptrdiff_t(own), is_listed);
    std::stable_partition(first, copies.kept.end(), is_listed);
    return std::size_t(still_own);
  }
};

/// Files below a folder whose names end so in any case, but for hidden folders; sorted.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder, const char* extension);
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder,
                                               std::initializer_list<const char*> extensions);
/// What is said of a folder in whose C files there is no program.
std::string no_program(const std::filesystem::path& folder);

/// Whether a program is written for Webots' interfaces: one of its files, or a header of its own, says so.
bool names_webots(const std::vector<std::filesystem::path>& sources,
                  const std::vector<std::filesystem::path>& headers);

/// Reads the project or the Makefile of the folder; warnings go to `result`.
Program program_of(const BuildOptions& options, BuildResult& result);

}  // namespace cc
