// SPDX-License-Identifier: MIT
#include "outputs/progress.h"

#include <unistd.h>

#include <cstdio>

namespace outputs {

namespace {
constexpr std::chrono::milliseconds kRefresh{200};
constexpr std::chrono::seconds kHeartbeat{5};
constexpr unsigned kTicksBetweenLooks = 16;  // reading the clock costs more than a quiet tick
}  // namespace

Progress::Progress(double goal_s, bool quiet)
    : goal_s_(goal_s),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Wall::now()),
      last_(start_),
      last_heartbeat_(start_) {}

bool Progress::is_due() {
  if (++calls_ % kTicksBetweenLooks != 0) return false;
  const auto now = Wall::now();
  if (now - last_ < kRefresh) return false;
  last_ = now;
  return true;
}

void Progress::show(double simulated_s) {
  if (quiet_) return;
  const double wall_s = std::chrono::duration<double>(last_ - start_).count();
  const double factor = wall_s > 0 ? simulated_s / wall_s : 0;
  if (terminal_) {
    std::fprintf(stderr, "\r%8.1f s of %.0f s simulated, %.1f times real time ", simulated_s, goal_s_,
                 factor);
    shown_ = true;
  } else if (last_ - last_heartbeat_ >= kHeartbeat) {
    last_heartbeat_ = last_;
    std::fprintf(stderr, "%.1f s of %.0f s simulated, %.1f times real time\n", simulated_s, goal_s_, factor);
  }
  std::fflush(stderr);
}

void Progress::clear() {
  finish();
  if (shown_) std::fflush(stderr);
  shown_ = false;
}

void Progress::finish() {
  if (shown_) std::fprintf(stderr, "\r%70s\r", "");
}

}  // namespace outputs
