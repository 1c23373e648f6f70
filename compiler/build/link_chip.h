// SPDX-License-Identifier: MIT
// The last step of a build for the chip: .elf, .hex, .lst and .map, which appear together or not at all. For
// hal_sim the linker takes out what the simulator fills (dspic30/link/host.cpp); then there is no .hex,
// and .lst and .map only with BuildOptions::with_texts.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "build.h"
#include "compiler/cache/object_cache.h"
#include "compiler/projects/program_files.h"
#include "library_objects.h"

namespace cc {

/// What objects ask for by the first name is the second: in the program's objects, in the library's.
struct Renames {
  std::map<std::string, std::string> of_program, of_library;
};

/// `user` is linked as it is, `drivers` for their handlers too, of `members` and the
/// library what is asked for.
void link_chip(const std::vector<CompileOutcome>& user, const std::vector<CompileOutcome>& drivers,
               const std::vector<CompileOutcome>& members, const Program& program, const Library& library,
               const Renames& renames, const BuildOptions& options, const std::filesystem::path& output,
               BuildResult& result);

}  // namespace cc
