// SPDX-License-Identifier: MIT
// One run of the world from time 0 on: the twin, its programs of the PC, all that was done to it, and what it
// says. The twin is the run's own, or a debugger's, which makes it anew whenever it goes back.
//
//   script:  done, done, done | to come ...
//   An input is done at its tick, also when a debugger repeats the run.
#pragma once
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal_sim/inputs/recording.h"
#include "hal_sim/twin/twin.h"
#include "programs/team/team.h"
#include "viewer/trace_feed.h"

namespace viewer {

using Json = nlohmann::json;

class Run {
 public:
  /// `script`: inputs with their ticks, "at"; `is_replay`: of a recording, which goes on
  /// whatever is done besides.
  Run(std::vector<Json> script, bool is_replay) : script_(std::move(script)), is_replay_(is_replay) {}
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// With a twin of its own. False, with lines in `problems`.
  bool open(const sim::WorldDesc& world, const twin::Options& options,
            const std::vector<std::string>& supervisors, std::vector<std::string>& problems);
  /// With a debugger's, from time 0; it stays there until detach() or until the run goes.
  void attach(twin::Twin& twin);
  void detach();
  /// Programs of the PC begin. `say`: what supervisors say; `should_give_up`: asked while a program computes.
  void begin(std::function<void(const std::string&)> say, std::function<bool()> should_give_up);

  twin::Twin& twin() const { return *twin_; }
  sim::Clicks now() const { return twin_->simulation().now(); }
  bool is_alone() const { return !team_ || team_->is_empty(); }
  bool has_ended() const { return team_ && team_->has_ended(); }
  const programs::Outcome& outcome() const { return team_->outcome(); }

  /// Writes what is done from now on, time 0, and what it is done to.
  void record(const std::string& file, const inputs::Opening& opening);
  /// "PATH: --record-inputs: cannot be written: ..."; empty: all is well, or nothing is recorded.
  const std::string& recording_error() const;

  // --- time. These throw what an input of the script throws that cannot be done.
  /// Does what is due now. Returns until when nothing is; kEver: nothing more comes.
  sim::Clicks do_due();
  /// Up to `until` or the next that is due.
  void advance(sim::Clicks until);
  /// A tick, with what is due before it.
  void step();

  /// Does it, and writes it down. Throws std::runtime_error where it cannot be done; nothing is done then.
  /// `world`: what the text of a "world" says; null: it is read.
  void input(const Json& request, const sim::WorldDesc* world = nullptr);
  /// The same at the next tick; what was done later than now, in a time that the debugger went back
  /// from, has not been.
  void input_later(const Json& request);
  /// What repeats the run: what was done until now, and of a recording what is to come. Of more than 200 MB, as
  /// of hours of dragging in a long world, nothing is kept: is_kept() is false then.
  std::vector<Json> script() const;
  bool is_kept() const { return script_bytes_ <= kMostScriptBytes; }

  /// Serial lines and consoles that nobody else listens to.
  struct Line {
    int robot, port;
    std::string text;
  };
  std::vector<std::unique_ptr<Line>>& lines() { return lines_; }

  /// What they have said and nobody has heard is no news: the run was repeated.
  void forget_said();

  void trace(int robot, const std::vector<std::string>& signals);
  void trace_no_more() { trace_.reset(); }
  /// What was traced since; null: nothing new, or nobody looks.
  Json take_trace(std::size_t most);

 private:
  static constexpr std::size_t kMostScriptBytes = 200u << 20;
  void listen();
  void keep(const Json& request);
  void apply(const Json& request, const sim::WorldDesc* world = nullptr);

  std::vector<Json> script_;
  std::size_t next_ = 0;          // of the script, to be done
  std::size_t script_bytes_ = 0;  // of what was done, nearly
  bool is_replay_;
  twin::Twin* twin_ = nullptr;
  std::unique_ptr<twin::Twin> own_twin_;
  std::unique_ptr<programs::Team> team_;
  std::unique_ptr<inputs::Inputs> inputs_;
  std::unique_ptr<TraceFeed> trace_;          // while a page shows a time line
  sim::Clicks traced_ = -1;                   // until when pages know it
  std::vector<std::unique_ptr<Line>> lines_;  // UARTs keep pointers
  std::unique_ptr<inputs::Recorder> recorder_;
};

}  // namespace viewer
