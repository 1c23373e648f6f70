// SPDX-License-Identifier: MIT
// Signs of life during a run, on stderr: a line that is rewritten on a terminal, heartbeat lines elsewhere.
#pragma once
#include <chrono>

namespace outputs {

class Progress {
 public:
  /// `goal_s`: simulated seconds of the whole run.
  Progress(double goal_s, bool quiet);
  /// Cheap; true about five times a real second.
  bool is_due();
  void show(double simulated_s);
  void finish();
  /// Something else is about to be written to the terminal.
  void clear();

 private:
  using Wall = std::chrono::steady_clock;
  double goal_s_;
  bool quiet_, terminal_;
  bool shown_ = false;
  unsigned calls_ = 0;
  Wall::time_point start_, last_, last_heartbeat_;
};

}  // namespace outputs
