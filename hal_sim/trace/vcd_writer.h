// SPDX-License-Identifier: MIT
// A value change dump (IEEE 1364, clause 18) of chosen signals: a scope for every robot, in it one for every
// group. Time unit 1 ns; a cycle is 67.8 ns, so every cycle has its own time, rounded to the nearest ns.
// What is complete goes to the file at every tick, so that a file is readable up to there after any crash; on
// a full disk it ends with its last whole tick. In: changes in order of time. Out: those within the window,
// and all values at its beginning.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/trace/signals.h"
#include "sim_core/base/clock.h"
#include "sim_core/base/output_file.h"

namespace trace {

/// Nanoseconds since the world began, nearest; exact in integers.
std::int64_t to_ns(sim::Clicks at);

/// Which part of a run is written.
struct Window {
  sim::Clicks from = 0;
  sim::Clicks to = INT64_MAX;
  int trigger = -1;  ///< signal that starts it when it has `trigger_value` at or after `from`
  std::uint64_t trigger_value = 0;
  std::int64_t most_bytes = INT64_MAX;
};

class VcdWriter {
 public:
  /// Numbers of the signals count on over the scopes, in their order.
  struct Scope {
    std::string name;  ///< robot
    std::vector<Signal> signals;
  };
  /// Where `most_bytes` does not hold names and first values there is no file, and an error.
  VcdWriter(const std::string& path, const std::vector<Scope>& scopes, Window window);

  /// A signal has another value from `at` on; times never fall.
  void change(sim::Clicks at, int signal, std::uint64_t value);
  /// All changes before `now` have been told: what is complete goes to the file.
  void tick(sim::Clicks now);
  /// The last time stamp, `now`, and the end of the file.
  void finish(sim::Clicks now);

  /// The window is over or the file is as large as it may be: nothing more will be written.
  bool is_done() const { return state_ == State::Done; }
  /// Has the window been reached, and its trigger come?
  bool has_begun() const { return has_begun_; }
  /// Empty while all is well.
  const std::string& error() const { return file_ ? file_->error() : too_small_; }
  /// When the file became as large as it may be; negative: it did not.
  sim::Clicks cut_at() const { return cut_at_; }

 private:
  enum class State { Before, Writing, Done };
  struct Line {
    std::string code;
    int width = 1;
    bool real = false;
    bool known = false;
    std::uint64_t value = 0;
  };
  void arrive(sim::Clicks at);
  void begin(sim::Clicks at);
  void end(sim::Clicks at, const std::string& comment);
  void stamp(sim::Clicks at);
  void write_value(const Line& line);
  void flush();

  std::optional<sim::OutputFile> file_;
  std::string too_small_;
  Window window_;
  std::vector<Line> lines_;
  State state_ = State::Before;
  bool armed_ = false, has_begun_ = false;
  sim::Clicks cut_at_ = -1;
  std::int64_t stamped_ns_ = -1;
  std::int64_t bytes_ = 0;
  std::string pending_;
};

}  // namespace trace
