// SPDX-License-Identifier: MIT
// A time line for Perfetto and chrome://tracing (Trace Event Format, the JSON array): a process for every
// robot with tracks for its main program, interrupts and agendas, and counters. Times are microseconds of
// world time with three decimals. An event a line; what is complete goes to the file at every tick, and
// viewers accept an array without its end, so that a file is readable up to there after any crash; on a
// full disk the array is closed after its last whole tick.
#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "hal_sim/board/clock.h"
#include "hal_sim/trace/robot_trace.h"
#include "sim_core/base/output_file.h"

namespace trace {

/// "busy", "waiting", an interrupt's name or an agenda's function; `runner` null: functions by address.
std::string span_name(const Span& span, const host::Runner* runner);

class TimelineWriter {
 public:
  /// `most_bytes`: the file ends before it is larger.
  TimelineWriter(const std::string& path, std::int64_t most_bytes);

  /// Names the tracks of a robot.
  void add_robot(int robot, const std::string& name);
  /// `runner` names callbacks; null: by address.
  void span(int robot, const Span& span, const board::RobotClock& clock, const host::Runner* runner);
  /// One point of a curve named `name`; `unit` names the value.
  void counter(int robot, sim::Clicks at, const char* name, const char* unit, double value);
  /// What was told so far goes to the file.
  void flush();
  void finish();

  bool is_done() const { return done_; }
  const std::string& error() const { return file_.error(); }
  /// When the file became as large as it may be (ns); negative: it did not.
  std::int64_t cut_at_ns() const { return cut_at_ns_; }

 private:
  void add(const std::string& event);

  sim::OutputFile file_;
  std::string pending_;
  std::int64_t bytes_ = 0;
  std::int64_t most_bytes_;
  std::int64_t latest_ns_ = 0;  // end of the last slice
  std::int64_t cut_at_ns_ = -1;
  bool done_ = false;
  bool first_ = true;
  std::map<std::pair<int, std::uintptr_t>, std::string> names_;
};

}  // namespace trace
