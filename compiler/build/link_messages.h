// SPDX-License-Identifier: MIT
// What compiler and linker print, in the project's grammar.
#pragma once
#include <string>

#include "build.h"

namespace cc {

/// What twinpuck-cc --link prints, with what may help behind names that have no definition.
std::string with_hints(const std::string& text);

/// Splits what a compiler printed into errors and warnings; notes stay with the line before them, and behind an error
/// in a header stands where that is included.
void sort_messages(const std::string& text, BuildResult& result, bool failed);

/// The first line of the first error of what a compiler printed as it failed.
std::string first_error(const std::string& text);

}  // namespace cc
