// SPDX-License-Identifier: MIT
// Ends the process when somebody (Ctrl-C, SIGTERM, SIGQUIT, a terminal that is closed) or --host-limit wants it
// ended, whatever runs. A verb that looks at end_asked() ends by itself, with its files whole. One that does not
// come to it, because a supervisor or the simulator loops for ever, is ended by a thread of its own, with the
// documented exit code.
//
// Compilers and other children end at once.
//
//   asked --- grace --> rescue: files written as far as safe --- grace --> end without anything
#pragma once
#include <functional>

namespace tools {

/// Once, at the start of main(): signals end the process from now on. `verb` is named where
/// nothing better is known.
void guard_process();

/// 0, or the exit code to end with: kInterrupted, kHostTime.
int end_asked();

/// Does what Ctrl-C does. For handlers of signals, too.
void ask_for_end();
/// Of a clock that only goes on, ms. For handlers of signals, too.
long long steady_ms();

/// kHostTime is asked for after so many seconds from now.
void limit_host_time(double seconds);

/// While one of these lives the verb looks at end_asked(), and gets the time of the first grace to react.
/// Without one the process ends at once.
class GracefulEnd {
 public:
  /// `rescue` writes what is left of the output files; called by the guard's thread.
  explicit GracefulEnd(std::function<void()> rescue);
  ~GracefulEnd();
  GracefulEnd(const GracefulEnd&) = delete;
  GracefulEnd& operator=(const GracefulEnd&) = delete;

  /// Nobody else's code runs any more, and the files are being finished: no end but by a second signal.
  void finishing();
};

}  // namespace tools
