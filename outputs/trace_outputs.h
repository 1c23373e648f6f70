// SPDX-License-Identifier: MIT
// --vcd, --trace: what the command line asks to see over time, for every robot. Changes are
// gathered robot by robot while they run and put in order at each tick, so the files do not depend on the
// number of threads.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/trace/robot_trace.h"
#include "hal_sim/trace/timeline_writer.h"
#include "hal_sim/trace/vcd_writer.h"
#include "hal_sim/twin/twin.h"

namespace outputs {

struct TraceArguments {
  std::string vcd, trigger, timeline;
  std::vector<std::string> signals;
  double from_s = 0;
  double to_s = -1;  ///< negative: to the end
  double most_mb = 1024;
  double most_timeline_mb = 1024;
};

class TraceOutputs {
 public:
  TraceOutputs(TraceArguments arguments, twin::Twin& twin);
  ~TraceOutputs();
  /// One line per problem: an unknown signal, a file that cannot be written. Files stay as they are.
  void check(std::vector<std::string>& problems);
  /// Behind a check() that found nothing.
  void open(std::vector<std::string>& problems);
  void after_tick();
  /// A file was lost (disk full).
  bool failed() const;
  void finish(std::vector<std::string>& problems);

 private:
  struct Traced {
    int robot = 0;
    int first_signal = 0;
    std::unique_ptr<trace::RobotTrace> trace;
    host::Cycle counted_cycles = 0, counted_idle = 0;  // at the last point of its curves
  };
  bool choose(std::vector<std::string>& problems);
  bool add(const std::string& word, const char* option, std::vector<std::vector<trace::Signal>>& signals,
           std::vector<std::string>& problems);
  void write_changes(sim::Clicks before);
  void write_spans();
  void write_counters(sim::Clicks now);
  void release();

  const TraceArguments arguments_;
  twin::Twin& twin_;
  std::vector<std::vector<trace::Signal>> signals_;  // of each robot
  trace::Window window_;
  std::vector<Traced> traced_;
  std::unique_ptr<trace::VcdWriter> vcd_;
  std::unique_ptr<trace::TimelineWriter> timeline_;
  sim::Clicks next_count_ = 0;
  struct Waiting {
    trace::Change change;
    int signal;
  };
  std::vector<Waiting> batch_;
};

}  // namespace outputs
