// SPDX-License-Identifier: MIT
// A whole twin: a world, a board and a firmware for every robot in it, ready to step. The command line and
// the test fixture are two thin users of this class.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/host/mind.h"
#include "programs/build/build.h"
#include "programs/puck/program_runner.h"
#include "sim_core/radio/packet_medium.h"
#include "sim_core/radio/radio_medium.h"
#include "sim_core/simulation.h"
#include "sim_core/world/world_desc.h"

namespace board {
class BluetoothModule;
}

namespace twin {

/// What a robot runs whose program comes from outside.
inline constexpr const char* kExtern = "<extern>";

/// One `--fw` or `--uart`: what a robot gets instead of what the world file says. Robot "*" means every
/// robot.
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

/// Where the image of a folder of C files is kept that is built with these options.
std::string image_file(const std::string& folder, const Options& options);

/// Finds the controller that `name` means and builds it when it is source. Returns the path of the image;
/// empty on failure, with lines appended to `problems`. Images lie in the user's cache, and builds are
/// incremental.
std::string provide_image(const std::string& name, const std::string& from_folder, const Options& options,
                          std::vector<std::string>& problems, Program* program = nullptr);

/// How the program of the PC that `name` means is started, built if need be; found as find_firmware() does.
/// False, with lines in `problems`.
bool provide_launch(const std::string& name, const std::string& from_folder, const Options& options,
                    std::vector<std::string>& problems, programs::Launch& launch);

class Twin {
 public:
  /// Joins world and firmware. Null when anything is wrong; every problem is one line in `problems`.
  static std::unique_ptr<Twin> open(sim::WorldDesc world, const Options& options,
                                    std::vector<std::string>& problems);

  const sim::WorldDesc& world() const { return simulation_->scene().world(); }
  sim::Simulation& simulation() { return *simulation_; }
  const sim::Simulation& simulation() const { return *simulation_; }
  int robots() const { return static_cast<int>(minds_.size()); }
  host::FirmwareMind& mind(int robot) { return *minds_[static_cast<std::size_t>(robot)]; }
  const host::FirmwareMind& mind(int robot) const { return *minds_[static_cast<std::size_t>(robot)]; }
  /// Index of the robot of that name, -1 when there is none.
  int find(const std::string& name) const;
  /// Image file each robot runs; empty for a robot without firmware.
  const std::string& image_path(int robot) const { return image_paths_[static_cast<std::size_t>(robot)]; }
  /// What that was made of; no path for a robot without firmware.
  const Program& program(int robot) const { return programs_[static_cast<std::size_t>(robot)]; }
  /// Which HAL its image of the chip was linked with: sim, dspic, or own: elsewhere. Empty: no such image.
  const std::string& hal(int robot) const { return hals_[static_cast<std::size_t>(robot)]; }
  /// How a robot's program of the PC is started, by whoever gives programs their turns (programs/team); null:
  /// it runs something else.
  const programs::Launch* launch(int robot) const { return launches_[static_cast<std::size_t>(robot)].get(); }
  /// Where its runner is found.
  const std::shared_ptr<programs::Seat>& seat(int robot) const {
    return seats_[static_cast<std::size_t>(robot)];
  }
  /// Where a robot's UART 1 or 2 goes, in open_uart_end()'s words: by the options, or by the world.
  const std::string& uart_choice(int robot, int port) const {
    return uart_choices_[static_cast<std::size_t>(robot)][static_cast<std::size_t>(port - 1)];
  }
  /// Flashes another image into robots that run programs; they start it where they stand. Returns what is
  /// wrong with the image, or an empty string. Between ticks.
  std::string flash(const std::vector<int>& robots, const std::string& path);
  /// A robot that was restarted begins as when the world began; its keys are pressed again. Between ticks.
  void begin_again(int robot);
  /// All traps and unexpected resets so far, robot by robot.
  std::vector<host::TrapReport> traps() const;
  /// The radio channel; null when no robot has a radio.
  const sim::RadioMedium* radio() const { return radio_; }
  /// The channels of emitters and receivers; supervisors add their own end.
  sim::PacketMedium& packets() { return *packets_; }
  /// At the end of a run: lines that firmware has begun and not ended go to the console.
  void flush_console();
  board::BluetoothModule& bluetooth(int robot) { return *bluetooth_[static_cast<std::size_t>(robot)]; }

 private:
  Twin() = default;
  void add_media();
  std::unique_ptr<sim::Simulation> simulation_;  // owns the minds
  std::vector<host::FirmwareMind*> minds_;
  std::vector<std::string> hals_;
  std::vector<std::string> image_paths_;
  std::vector<Program> programs_;
  std::vector<std::shared_ptr<const programs::Launch>> launches_;
  std::vector<std::shared_ptr<programs::Seat>> seats_;
  Options options_;  // as it was opened with
  std::vector<std::array<std::string, 2>> uart_choices_;
  sim::PacketMedium* packets_ = nullptr;                            // the simulation's
  const sim::RadioMedium* radio_ = nullptr;                         // the simulation's
  std::vector<std::shared_ptr<board::BluetoothModule>> bluetooth_;  // one per robot; its UART 1 holds it too
};

}  // namespace twin
