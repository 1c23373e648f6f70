// SPDX-License-Identifier: MIT
// What a program's files are compiled with: which files, in which order they look for headers.
#pragma once
#include <filesystem>
#include <set>
#include <vector>

#include "build.h"
#include "compiler/cache/object_cache.h"
#include "compiler/cache/readable_files.h"
#include "compiler/projects/library_copies.h"
#include "compiler/projects/program_files.h"

namespace cc {

struct Plan {
  std::vector<CompileJob> user, assembler;
  std::set<std::filesystem::path> assembler_members;
  bool is_webots = false;  // a program for Webots' interfaces, with the library behind them
};

/// What a build may read (BuildOptions::within).
ReadableFiles readable_files(const BuildOptions& o);
/// The same for the compiler.
std::vector<std::string> flags_of(const ReadableFiles& readable);

/// `lint`: what is told beyond what a build needs.
Plan plan(const BuildOptions& o, const LibraryCopies& copies, const Program& program, bool lint);

}  // namespace cc
