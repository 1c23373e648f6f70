// SPDX-License-Identifier: MIT
// A world as Python has it: opened from text, run for so long or until somebody says so, asked and touched
// between ticks, with a recording of every touch, so that a run can be shown again.
//
//   module.cpp (Python's types) --> World --> runs::Run
//                                   touches --> inputs::Inputs, and into the recording
//
// Knows nothing of Python. Threads: one at a time; run() may be left to another one while nobody else asks.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/board/camera.h"
#include "hal_sim/chip/call_cost.h"
#include "hal_sim/debug/machine.h"
#include "hal_sim/inputs/recording.h"
#include "hal_sim/runs/run.h"
#include "sim_core/record/trajectories.h"

namespace python {

/// What a world is opened with.
struct Opening {
  std::string text, file;             ///< of the world; the file is where relative names begin
  std::optional<std::uint64_t> seed;  ///< instead of the world's
  twin::Options options;
  std::vector<std::string> supervisors;  ///< as `twinpuck run --supervisor`
  std::vector<std::string> measured;     ///< robots whose functions are measured; "*": all
};

/// Numbers of all robots side by side, which Python reads where they lie. Rows are robots.
struct Arrays {
  explicit Arrays(std::size_t robots)
      : poses(3 * robots), proximity(8 * robots), leds(10 * robots), steps(2 * robots), battery_v(robots) {}
  std::vector<double> poses;            ///< x, y (m), heading (rad)
  std::vector<std::int32_t> proximity;  ///< counts, as e_get_prox gives them
  std::vector<std::uint8_t> leds;       ///< 0 to 7 the ring, 8 body, 9 front; 1: lit
  std::vector<std::int64_t> steps;      ///< left, right
  std::vector<double> battery_v;        ///< V
};

/// Rows of all robots, one after the other, at multiples of a time.
struct Record {
  static constexpr int kColumns = 17;
  double every_s = 0;
  sim::Clicks next = 0;
  /// time_s, robot's index, x_m, y_m, heading_rad, left_steps, right_steps, ir0 to ir7, leds, battery_v
  std::vector<double> rows;
};

class World {
 public:
  /// Null when anything is wrong; every problem is one line in `problems`.
  static std::unique_ptr<World> open(const Opening& opening, std::vector<std::string>& problems);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  twin::Twin& twin() const { return run_->twin(); }
  sim::Simulation& simulation() const { return run_->simulation(); }
  host::FirmwareMind& mind(int robot) { return run_->twin().mind(robot); }
  /// Null: the robot runs no program.
  const host::Runner* runner(int robot) const {
    return static_cast<const twin::Twin&>(run_->twin()).mind(robot).runner();
  }
  /// Null: it runs no program of the chip.
  debug::Machine* machine(int robot);
  const programs::Outcome& outcome() const { return run_->team().outcome(); }

  // --- running
  enum class Why {
    Time,     ///< it is `end`
    Asked,    ///< `each_tick` has said so
    Trap,     ///< a robot trapped or was reset unexpectedly
    Ended,    ///< by a supervisor
    Stopped,  ///< should_stop() has said so
  };
  /// Advances up to the first tick at or after `end`. With `each_tick` ticks are not passed over, and it is
  /// asked after each: true ends the run. Traps end it where `stops_at_traps`, up to 1/64 s later.
  Why run(sim::Clicks end, const std::function<bool()>& each_tick, bool stops_at_traps);
  /// Asked every 20 ms of real time while it runs.
  std::function<bool()> should_stop;
  /// The run is over: programs of the PC are told and have a second to end; serial lines lose their other ends;
  /// coverage is written.
  void finish(std::vector<std::string>& problems);

  // --- touching
  /// An input of docs/connecting.md; throws as inputs::Inputs does.
  void apply(const inputs::Json& input);
  /// The run so far, for `twinpuck run --replay`, with its images beside it. Empty, or what was lost.
  std::string save_recording(const std::string& file) const;

  faults::Injector& faults() { return run_->inputs().faults(); }

  // --- asking
  /// All that a robot has sent over UART 1 or 2.
  const std::string& heard(int robot, int port);
  /// Lines of programs for Webots' interfaces, and of supervisors (robot -1).
  const std::vector<std::string>& console(int robot) { return consoles_[robot]; }
  /// Where text of a build goes: warnings and notes, a line each.
  const std::vector<std::string>& notices() const { return notices_; }
  std::int64_t traps_seen() const;
  /// Empty: its functions are not measured.
  std::optional<chip::ProfileReport> profile(int robot) const;
  /// False: `error` says why (chip/call_cost.h).
  bool cost_of(int robot, const std::string& function, chip::CallCost& cost, std::string& error);
  /// The last picture that a robot's program got; null: none.
  const board::CameraPicture* picture(int robot) const;
  /// PNG or SVG by the ending, with the robots' ways. Empty, or what is wrong.
  std::string draw(const std::string& file, const std::string& caption, bool rays, int width_px);
  /// Brings numbers up to now.
  void refresh(Arrays& arrays, bool poses, bool proximity, bool others);
  /// Rows from now on; they end with the world.
  std::shared_ptr<Record> record(double every_s);

 private:
  explicit World(const Opening& opening) : opening_(opening) {}
  bool begin(std::vector<std::string>& problems);
  void listen();
  void let_go_of_ends();
  void sample();
  void write_row(Record& record);
  sim::Clicks next_look() const;

  Opening opening_;
  inputs::RunImages images_;  // as the run began: a later build takes an image's place
  std::vector<std::string> notices_;
  std::map<int, std::vector<std::string>> consoles_;
  std::vector<std::array<std::string, 2>> heard_;  // UARTs keep pointers to them
  std::map<int, board::CameraPicture> pictures_;
  std::unique_ptr<runs::Run> run_;
  std::map<int, std::unique_ptr<debug::Machine>> machines_;
  std::map<int, std::unique_ptr<chip::Profile>> profiles_;
  std::vector<inputs::Json> touches_;
  std::unique_ptr<sim::Trajectories> ways_;
  sim::Clicks sampled_ = -1;
  std::vector<std::shared_ptr<Record>> records_;
  std::int64_t traps_ = 0;  // up to the last run's end; -1: not looked
  bool is_finished_ = false;
};

}  // namespace python
