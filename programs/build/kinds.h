// SPDX-License-Identifier: MIT
// Inside programs/build: what a file or folder is, and which of its files is the program.
#pragma once
#include <string>
#include <vector>

#include "files.h"

namespace programs {

enum class Kind { Nothing, Firmware, Extern, Compiled, Python, Java, Jar, Class, Executable, Matlab, Other };

struct Found {
  Kind kind = Kind::Nothing;
  fs::path folder;  ///< absolute; where the program works
  fs::path main;    ///< its file; of Compiled empty where a folder's sources or Makefile tell
  std::string why;  ///< of Other, and of Nothing where there is something to say: what was got and expected
};

/// What a file or folder is. Reads it; starts nothing.
Found look_at(const std::string& path);

/// Whether a text includes one of Webots' headers, itself or by headers beside it.
bool includes_webots(const fs::path& source);
/// Names that a C text includes, "webots/robot.h".
std::vector<std::string> includes_of(const std::string& text);
/// Whether a file is a program of this machine that can be started, and not a shared object alone.
bool is_native_program(const fs::path& file);
/// The Makefile of a folder; empty: none.
fs::path makefile_of(const fs::path& folder);

}  // namespace programs
