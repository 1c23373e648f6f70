// SPDX-License-Identifier: MIT
// What a build is asked, and what comes of it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace cc {

struct BuildOptions {
  std::filesystem::path source_dir;  ///< every .c below it is compiled
  std::filesystem::path output;      ///< the image; its folder is created
  std::string optimisation;          ///< -O0 -O1 -O2 -Os; default: the project's, else -O1
  bool sanitize = false;             ///< checks of every access and of 16-bit overflow
  bool strict = false;               ///< more warnings
  /// "sim", whose busy drivers are the simulator's, or "dspic", the image that is flashed; empty: dspic.
  std::string hal;
  bool with_texts = false;           ///< hal sim: .lst and .map too
  int jobs = 2;                      ///< compilers at once
  std::string name;                  ///< controller's name; default: the folder's
  std::filesystem::path cache_dir;   ///< objects kept between builds; default: below the build folder
  std::vector<std::string> defines;  ///< "NAME=value"
  /// C that defines the constants of firmware/webots/settings.c, for a program of Webots' interfaces on the
  /// chip; empty: what that file says.
  std::string webots_settings;
  std::string standard;  ///< of C, as -std= has it; default: the project's, or XC16's gnu89
  /// A submission's folder, real: what is read must lie below it, be the library's, or in `include_dirs`
  /// (readable_files.h). Empty: whatever the user may read.
  std::filesystem::path within;
  std::vector<std::filesystem::path> include_dirs;  ///< searched first
  std::vector<std::filesystem::path> sources;       ///< instead of every .c of source_dir
  std::filesystem::path api_dir, include_root;      ///< default: hal_dspic and firmware/include of this tree
};

struct BuildResult {
  bool ok = false;
  bool is_bad_input =
      false;  ///< no program is there, or a file of it cannot be read or the image not be written
  std::vector<std::string> errors;     ///< "file:line: what: got X, expected Y; hint"
  std::vector<std::string> conflicts;  ///< two drivers with one timer or vector; found at each build
  std::vector<std::string> warnings;   ///< same grammar; 16-bit warnings of the compiler included
  /// hal sim: which drivers are not the simulator's: "agenda: the chip's own driver, since
  /// main.c:12 uses T2CON"
  std::vector<std::string> notes;
  int compiled = 0, reused = 0;  ///< translation units compiled now, taken from the cache
  int files = 0;                 ///< sources of the program itself
  long ram_bytes = 0;            ///< static data
  long stack_bytes = 0;          ///< the stack at most, every handler included
  std::string recursive;         ///< a function that calls itself: then the stack has no bound
  std::string no_room;           ///< one of the warnings: data and stack are more than the chip's RAM
  std::string size_report;       ///< what the linker says of flash and RAM
  double seconds = 0;            ///< wall time of this build
};

}  // namespace cc
