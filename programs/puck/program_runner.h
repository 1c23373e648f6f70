// SPDX-License-Identifier: MIT
// A robot that a program of the PC commands, as a Runner: what it commanded holds until its step ends, and at
// that very cycle its sensors are sampled. Code takes no time, as in Webots.
//
//   run_until(end) ... step ends in the window: samples are taken, it is due
//   between ticks: whoever owns the program (team/) hands the samples over, takes commands, begin_step()
//
// So samples are those of the exact instant; commands act from the tick boundary behind it (1 ms later on
// average at 512 Hz). Until somebody begins a step, the robot stands: a program that has not answered yet.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/host/runner.h"
#include "programs/puck/puck.h"

namespace programs {

class ProgramRunner;

/// Where the program's owner finds the runner of a robot, which another may take the place of; both hold it.
struct Seat {
  ProgramRunner* runner = nullptr;  ///< null: the robot runs something else
  std::uint64_t began = 0;          ///< counts runners and restarts: the program is to be started anew
};

class ProgramRunner final : public host::Runner {
 public:
  /// The program begins at cycle `start`. `board` outlives it.
  ProgramRunner(std::string name, std::shared_ptr<Seat> seat, board::Board& board, Cycle start);
  ~ProgramRunner() override;

  // --- for the program's owner, between ticks
  /// The devices, for commands at now().
  Puck& puck() { return *puck_; }
  /// End of the last window.
  Cycle now() const { return end_; }
  /// Its step has ended and nobody has taken the samples.
  bool is_due() const { return is_due_; }
  /// The samples of that instant; is_due() no more.
  const link_packet& take_samples() {
    is_due_ = false;
    return samples_;
  }
  /// World time since the robot began, at the end of the program's last step, in ms.
  std::int64_t time_ms() const { return time_ms_; }
  /// The next step, of 1 ms or more.
  void begin_step(std::int64_t milliseconds);
  /// The robot is put back to its beginning, and the program goes on: its time begins anew, a step that it
  /// has begun is as long as it said.
  void reset_under_program();
  /// A command was carried out: courses and the hash are other ones.
  void note_command() { ++turns_; }
  /// The program is over: its robot goes on as it was told last, or stops for good after a fault.
  void end();
  void fail(host::TrapReport report);

  // --- host::Runner
  void begin_window(Cycle now) override { end_ = std::max(end_, now); }
  void run_until(Cycle end) override;
  Cycle idle_until() const override;
  void pass_to(Cycle end) override { end_ = std::max(end_, end); }
  std::int64_t interrupts_served() const override { return 0; }
  std::uint64_t turns() const override { return turns_; }
  /// The program begins anew, and time goes on, as in Webots.
  void restart() override;
  /// Time begins anew.
  void begin_again() override;
  Cycle cycles() const override { return end_; }
  Cycle idle_cycles() const override { return end_; }
  Cycle waiting_since() const override { return board::kNever; }
  bool has_stopped() const override { return has_failed_; }
  const std::vector<host::TrapReport>& traps() const override { return traps_; }
  std::vector<board::Diagnosis> diagnoses() const override { return dated({}, board_.diagnoses(end_)); }
  std::uint64_t hash() const override { return puck_->hash(); }
  host::ProgramData& data() const override { return *data_; }
  void observe(host::Observer*) override {}  // it has no course of its own
  const drivers::Drivers* closed_drivers() const override { return &puck_->drivers(); }

 private:
  Cycle step_end() const;
  void reset_processor();
  void end_step(Cycle at);

  std::shared_ptr<Seat> seat_;
  board::Board& board_;
  std::unique_ptr<Puck> puck_;
  std::unique_ptr<host::ProgramData> data_;
  Cycle end_;
  sim::Clicks began_;         // world time at which the program's own begins
  std::int64_t time_ms_ = 0;  // since then, at the end of the last step
  std::int64_t step_ms_ = 0;  // 0: none is under way
  bool is_due_ = false, has_failed_ = false;
  link_packet samples_{};
  std::uint64_t turns_ = 1;
  std::vector<host::TrapReport> traps_;
};

}  // namespace programs
