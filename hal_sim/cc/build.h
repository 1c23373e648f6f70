// SPDX-License-Identifier: MIT
// From a folder of firmware C to a loadable image. Spawns twinpuck-cc and ld; links no compiler itself. For
// the chip way twinpuck-cc links as well. In: a controller's folder. Out: one .so with the controller, the
// e_* API, the firmware libc and the runtime.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace cc {

struct BuildOptions {
  std::filesystem::path source_dir;  ///< every .c below it is compiled
  std::filesystem::path output;      ///< the image; its folder is created
  std::string optimisation;          ///< -O0 -O1 -O2 -Os; default: for the chip the project's, else -O1
  bool sanitize = false;             ///< address and 16-bit overflow checks
  bool coverage = false;             ///< line counters
  bool strict = false;               ///< more warnings
  bool chip_way = false;             ///< an image of the chip, .elf with .hex and .map
  /// An image of the chip for this HAL: "sim", whose busy drivers are the simulator's, or "dspic", the image
  /// that is flashed. Implies chip_way, which alone means dspic.
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
  std::vector<std::filesystem::path> include_dirs;  ///< searched first
  std::vector<std::filesystem::path> sources;       ///< instead of every .c of source_dir
  std::filesystem::path api_dir,
      include_root;  ///< default: hal_sim/api (register way: hal_dspic) and firmware/include of this tree
};

struct BuildResult {
  bool ok = false;
  std::vector<std::string> errors;     ///< "file:line: what: got X, expected Y; hint"
  std::vector<std::string> conflicts;  ///< two drivers with one timer or vector; found at each build
  std::vector<std::string> warnings;   ///< same grammar; 16-bit warnings of the compiler included
  /// hal sim: which drivers are not the simulator's: "agenda: the chip's own driver, since main.c:12 uses
  /// T2CON"
  std::vector<std::string> notes;
  int compiled = 0, reused = 0;  ///< translation units compiled now, taken from the cache
  int files = 0;                 ///< sources of the program itself
  long ram_bytes = 0;            ///< static data on the chip: the linker's number, other ways an estimate
  long stack_bytes = 0;     ///< the stack at most, every handler included: the linker's bound, or an estimate
  std::string recursive;    ///< a function that calls itself: then the stack has no bound
  std::string no_room;      ///< one of the warnings: data and stack are more than the chip's RAM
  std::string size_report;  ///< chip way: what the linker says of flash and RAM
  double seconds = 0;       ///< wall time of this build
};

/// Compiles and links. On failure the output file is left as it was.
BuildResult build_image(const BuildOptions& options);

/// Compiles with strict warnings and looks for what compiles but misbehaves: polled flags that are not
/// volatile, two drivers on one timer. Writes no image. ok is false when there is an error or a warning.
BuildResult lint_folder(const BuildOptions& options);

/// Estimated cycles of one function, its callees included. -1: no bound known.
struct FunctionCycles {
  std::string name, file;
  int line = 0;
  bool is_interrupt = false;  ///< a handler: entry, context saving and RETFIE are included
  bool is_library = false;    ///< of the e-puck library or the C library, not of the program
  std::string inlined_into;   ///< names of the functions in which its code stands; it has no cost of its own
  double min = 0, mean = 0, max = 0;
  double mean_us() const;  ///< at 14.7456 MHz
  /// Share of the processor when called every `period_s` seconds, 0..1 and above.
  double cpu_load(double period_s) const;
};

/// What a program takes of the chip's RAM in bytes, estimated (memory_use.cpp).
struct MemoryUse {
  long data = 0;          ///< variables with a place of their own
  long stack = 0;         ///< from main() down, and the deepest that can interrupt it
  std::string deepest;    ///< "main() > f() > g()"
  std::string recursive;  ///< a function that calls itself, counted once; then there is no bound
};
MemoryUse memory_use(const std::filesystem::path& image);

/// Reads the cost section of an image. Empty when the file is not one.
std::vector<FunctionCycles> function_costs(const std::filesystem::path& image);

}  // namespace cc
