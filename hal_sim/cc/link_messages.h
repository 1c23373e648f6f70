// SPDX-License-Identifier: MIT
// What ld prints, in the project's grammar. Names that the simulator itself brings at run time are expected
// to be undefined.
#pragma once
#include <string>

#include "build.h"
#include "program_files.h"

namespace cc {

/// Appends errors to `result`. `root`: of the project, whose headers name what the simulator brings.
void sort_linker_messages(const std::string& text, const Program& program, const std::filesystem::path& root,
                          BuildResult& result);

/// What twinpuck-cc --link prints, with what may help behind names that have no definition.
std::string with_hints(const std::string& text);

/// Splits what a compiler printed into errors and warnings; notes stay with the line before them.
void sort_messages(const std::string& text, BuildResult& result, bool failed);

}  // namespace cc
