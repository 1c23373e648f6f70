// SPDX-License-Identifier: MIT
// The project files of Microchip's MPLAB beside a controller: which C files belong to the program,
// and where it looks for headers. A folder often holds more than its program: older versions of a
// file, a second main().
//
// Read are *.mcp (MPLAB 6 to 8) and nbproject/configurations.xml (MPLAB X), also in a folder *.X, which name
// files relative to themselves or by the path they had on their author's PC. Of an absolute path the longest
// end that exists in the folder or in one of three folders above it is taken. Of the compiler's options -I,
// -D, -std and -O count. Where the compiler's options say no level it is gcc's, 0. Of another project whose
// archive is linked the C files are taken.
//
// Of several projects those with a main() are looked at. When they list the same files, the first is taken;
// when one lists fewer files that are missing than all others, that one; else a project of MPLAB X, which is
// the newer program, when there is one alone.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

namespace cc {

struct MplabProject {
  std::filesystem::path file;
  std::vector<std::filesystem::path> sources;       ///< C files that exist, within the folder and without
  std::vector<std::filesystem::path> include_dirs;  ///< folders that exist
  std::vector<std::filesystem::path> assembler;     ///< assembler sources that exist
  std::vector<std::filesystem::path> objects;       ///< objects and archives that exist
  /// C files of other projects of which it links the archive.
  std::vector<std::filesystem::path> library_sources;
  std::vector<std::string> library_places;  ///< "a_d/e_prox.c" of what is listed of the library and missing
  std::vector<std::string> defines;         ///< "NAME=value"
  std::string standard;                     ///< of C, as -std= has it; "" unless given
  std::string level;                        ///< -O0 -O1 -O2 -Os; "" when it says nothing
  int missing = 0;                          ///< C files that are listed and do not exist
};

/// The project of `folder`. None: there is none, or several of which none is to be preferred. `told`: a line
/// about which of several is taken.
std::optional<MplabProject> find_mplab_project(const std::filesystem::path& folder, std::string& told);

/// -I, -D, -std and -O of a compiler's command line; folders as they are written.
struct CompilerOptions {
  std::vector<std::string> include_dirs, defines;
  std::string standard, level;
};
CompilerOptions compiler_options(const std::string& command_line);

/// The file or folder that a project in `home` means by `text`, written on whatever PC, or an empty path.
std::filesystem::path resolve_path(const std::filesystem::path& home, std::string text);

/// Whether a C file has a main() of its own.
bool defines_main(const std::filesystem::path& source);

}  // namespace cc
