// SPDX-License-Identifier: MIT
// From what people call a program to a process of the PC: what a file or folder is, how it is compiled, and
// the words and environment that start it. C and C++ are compiled by the PC's gcc as the project's Makefile
// says and kept in a cache; Python, Java and ready-made programs are started as they are. Nothing is started
// here but compilers and make. Not run: MATLAB, BotStudio, Docker; they are named.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace programs {

/// How a program of the PC is started.
struct Launch {
  std::vector<std::string> words;  ///< argv: the program (absolute) and what precedes the user's arguments
  std::string name;                ///< argv[0] where it is another one; empty: words[0]
  std::vector<std::string> environment;  ///< NAME=VALUE, in addition to the simulator's own
  std::string folder;                    ///< where it works: the controller's folder, absolute
  std::string source;                    ///< what people know it by: the file or folder
  int files = 0;                         ///< sources; 0: it is started as it is
  bool is_extern = false;                ///< waits for a program from outside
};

/// Whether a file or folder means a program of the PC and not firmware. A folder: C or C++ that
/// includes Webots' headers (also by way of headers of its own), C++ without the e-puck's library, a
/// Makefile of Webots, Python, Java, MATLAB, or an executable with the folder's name. A file: a source
/// of one of these languages, a jar or class, a script with #!, an ELF program of this machine.
/// "<extern>" is one. Reads files.
bool is_pc_program(const std::string& path);

/// Compiles what must be compiled into `cache_folder` (made if need be) and says how to start it; blocks
/// while compilers run, some seconds. Safe for several at once. False, with lines in `problems`. `tell` gets
/// warnings, a line each; it may be empty.
bool prepare(const std::string& path, const std::string& cache_folder,
             const std::function<void(const std::string&)>& tell, std::vector<std::string>& problems,
             Launch& launch);

/// "gsl: apt install libgsl-dev" for a message of a compiler, linker, pkg-config or Python that misses a
/// header, library or module of a usual package; empty for any other line.
std::string package_hint(const std::string& error_line);

}  // namespace programs
