// SPDX-License-Identifier: MIT
// What robots run: found by name, built where it is source, kept in the user's cache. In: a name and options.
// Out: the file of an image, or how a program of the PC is started.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "programs/build/build.h"

namespace sim {
struct WorldDesc;
}

namespace twin {

/// What a robot runs whose program comes from outside.
inline constexpr const char* kExtern = "<extern>";

/// One `--fw` or `--uart`: what a robot gets instead of what the world file says. Robot
/// "*" means every robot.
struct Choice {
  std::string robot;
  std::string value;
};

struct Options {
  std::vector<Choice>
      firmware;  ///< value: an image, a folder with C files, or the name of a controller under firmware/
  std::vector<Choice> uart1;  ///< value: none, -, pty, pty:LINK, tcp:PORT or file:PATH
  std::vector<Choice> uart2;
  int threads = 1;  ///< 1 or more; results do not depend on it
  std::string
      world_folder;  ///< where relative firmware paths of the world file start; empty: the current folder
  /// Of controllers built from source, all robots, for the robot's own processor: sim or dspic
  /// (cc::BuildOptions). Empty: what the world says; sim if it says nothing. A program for Webots' interfaces
  /// is a process of the PC unless one of them says so.
  std::string hal;
  /// Robots whose program comes from outside; "*": all.
  std::vector<std::string> externs;
  std::string optimisation;  ///< of controllers built from source, as in cc::BuildOptions: "" -O0 -O1 -O2 -Os
  /// Of the world, for programs of Webots' interfaces on the chip (cc::BuildOptions); Twin::open() sets it.
  std::string webots_settings;
  /// Controllers are submissions, built of what lies below this folder alone (cc::BuildOptions); empty: they are not.
  std::string within;
  bool sanitize = false;  ///< ... with checks of every access and of 16-bit overflow
  /// File that counts of lines are added to (coverage_run.h, which whoever opens the twin makes); empty:
  /// none. Controllers are built for it with -O0, unless `optimisation` says otherwise.
  std::string coverage;
  /// Told the compiler's warnings, a line each; may be empty.
  std::function<void(const std::string&)> tell;
  /// Called when a controller's data and stack do not fit the chip; may be empty. `tell` has told it.
  std::function<void()> no_room;
};

/// Which HAL a controller is linked with that is built with these options: sim or dspic; empty: `path`, its
/// folder, holds a program of the PC, and the options do not say otherwise.
std::string hal_of(const Options& options, const std::string& path);

/// The folder of a controller of the project: firmware/NAME, else firmware/lab/NAME (a solution of the lab,
/// also called "lab/NAME"). Empty when there is none.
std::string stored_controller(const std::string& name);

/// The world's [webots] as Options::webots_settings has it.
std::string webots_settings_of(const sim::WorldDesc& world);

/// What a robot runs, for people.
struct Program {
  std::string path;   ///< a file, or a folder of sources
  std::string other;  ///< another one that the name means as well, and that was not taken
  int files = 0;      ///< sources; 0: an image
};
/// "./obstacle, 2 files; not /usr/share/twinpuck/firmware/lab/obstacle, which has that name, too"
std::string said(const Program& program);

/// The file or folder that `name` means: a path (relative ones begin in `from_folder`, then here), or
/// else a controller of the project. Empty, with a line in `problems`, when there is none. `other`: the next
/// of these places that holds another one.
std::string find_firmware(const std::string& name, const std::string& from_folder,
                          std::vector<std::string>& problems, std::string* other = nullptr);

/// The same of what a supervisor runs.
std::string find_supervisor(const std::string& name, const std::string& from_folder,
                            std::vector<std::string>& problems);

/// Where the image of a folder of C files is kept that is built with these options.
std::string image_file(const std::string& folder, const Options& options);

/// Finds the controller that `name` means and builds it when it is source. Returns the path of the
/// image; empty on failure, with lines appended to `problems`. Images lie in the user's cache, and
/// builds are incremental.
std::string provide_image(const std::string& name, const std::string& from_folder, const Options& options,
                          std::vector<std::string>& problems, Program* program = nullptr);

/// How the program of the PC that `name` means is started, built if need be; found as find_supervisor() does.
/// False, with lines in `problems`.
bool provide_launch(const std::string& name, const std::string& from_folder, const Options& options,
                    std::vector<std::string>& problems, programs::Launch& launch);

}  // namespace twin
