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
#include "hal_sim/twin/firmware_store.h"
#include "programs/puck/program_runner.h"
#include "sim_core/base/file_uses.h"
#include "sim_core/radio/packet_medium.h"
#include "sim_core/radio/radio_medium.h"
#include "sim_core/simulation.h"
#include "sim_core/world/world_desc.h"

namespace board {
class BluetoothModule;
}

namespace twin {

struct Firmware;  // twin.cpp

/// Notes the files of robots' serial lines, and those of what they run.
void note_uart_files(const sim::WorldDesc& world, const Options& options, sim::FileUses& files);
void note_programs(const sim::WorldDesc& world, const Options& options, sim::FileUses& files);

/// What is wrong with a file that robots are to run; empty: nothing.
std::string wrong_image(const std::string& path);

class Twin {
 public:
  /// Joins world and firmware. Null when anything is wrong; every problem is one line in `problems`.
  static std::unique_ptr<Twin> open(sim::WorldDesc world, const Options& options,
                                    std::vector<std::string>& problems);

  const sim::WorldDesc& world() const { return simulation_->scene().world(); }
  sim::Simulation& simulation() { return *simulation_; }
  const sim::Simulation& simulation() const { return *simulation_; }
  int robots() const { return static_cast<int>(places_.size()); }
  host::FirmwareMind& mind(int robot) { return *at(robot).mind; }
  const host::FirmwareMind& mind(int robot) const { return *at(robot).mind; }
  /// Index of the robot of that name, -1 when there is none.
  int find(const std::string& name) const;
  /// Image file each robot runs; empty for a robot without firmware.
  const std::string& image_path(int robot) const { return at(robot).image_path; }
  /// What that was made of; no path for a robot without firmware.
  const Program& program(int robot) const { return at(robot).program; }
  /// Which HAL its image of the chip was linked with: sim, dspic, or own: elsewhere. Empty: no such image.
  const std::string& hal(int robot) const { return at(robot).hal; }
  /// How a robot's program of the PC is started, by whoever gives programs their turns (programs/team); null:
  /// it runs something else.
  const programs::Launch* launch(int robot) const { return at(robot).launch.get(); }
  /// Where its runner is found.
  const std::shared_ptr<programs::Seat>& seat(int robot) const { return at(robot).seat; }
  /// Where a robot's UART 1 or 2 goes, in open_uart_end()'s words: by the options, or by the world.
  const std::string& uart_choice(int robot, int port) const {
    return at(robot).uart_choices[static_cast<std::size_t>(port - 1)];
  }
  /// Flashes another image into robots that run programs; they start it where they stand. Returns what is
  /// wrong with the image, or an empty string. Between ticks.
  std::string flash(const std::vector<int>& robots, const std::string& path);
  /// `told` hears of each robot whose program is another one now; its runner is, too.
  void tell_flashes(std::function<void(int robot)> told) { flashed_ = std::move(told); }
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
  board::BluetoothModule& bluetooth(int robot) { return *at(robot).bluetooth; }

 private:
  /// A robot, and what it was given.
  struct Place {
    host::FirmwareMind* mind = nullptr;  // the simulation's
    std::shared_ptr<programs::Seat> seat = std::make_shared<programs::Seat>();
    std::array<std::string, 2> uart_choices;
    std::shared_ptr<board::BluetoothModule> bluetooth;  // its UART 1 holds it too
    // what it runs
    Program program;
    std::string image_path, hal;
    std::shared_ptr<const programs::Launch> launch;
  };
  explicit Twin(Options options) : options_(std::move(options)) {}
  Place& at(int robot) { return places_[static_cast<std::size_t>(robot)]; }
  const Place& at(int robot) const { return places_[static_cast<std::size_t>(robot)]; }
  std::unique_ptr<host::FirmwareMind> add_robot(const sim::WorldDesc& world, int index,
                                                const Firmware* firmware, std::vector<std::string>& problems);
  void add_media();
  std::unique_ptr<sim::Simulation> simulation_;  // owns the minds
  std::vector<Place> places_;                    // by robot
  std::function<void(int robot)> flashed_;       // empty: nobody wants to know
  Options options_;                              // as it was opened with
  sim::PacketMedium* packets_ = nullptr;         // the simulation's
  const sim::RadioMedium* radio_ = nullptr;      // the simulation's
};

}  // namespace twin
