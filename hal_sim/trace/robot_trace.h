// SPDX-License-Identifier: MIT
// Writes down one robot's course: the changes of chosen signals, and what its processor did when.
//
//   Robot --reached(at)--> cycles since the last call at which a signal can change --> sample, compare, keep
//
// Pins that the board evaluates in closed form (coils, IR pulses) are asked at each cycle at which they can
// change, so a change has its exact cycle. Variables have none: they are looked at whenever the program calls
// the library or the host, at interrupts, and every kVariableCycles of running code. Registers of the chip
// are peeked at wherever they can change: after the program's accesses, at every instant of a peripheral and
// where a closed form changes (its horizon). Counters that run freely (TMRx) would be a change a tick: they
// are looked at in the cycles before and at those instants.
// In: calls on the thread that runs the robot. Out: take_*() between ticks. One robot each; nothing shared.
#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "hal_sim/board/board.h"
#include "hal_sim/host/runner.h"
#include "hal_sim/trace/signals.h"
#include "sim_core/base/clock.h"

namespace trace {

/// Longest stretch of running code in which a variable is not looked at.
inline constexpr host::Cycle kVariableCycles = 100;

/// A signal has another value from `at` on.
struct Change {
  sim::Clicks at = 0;  ///< world time
  int signal = 0;      ///< in the order in which the robot got them
  std::uint64_t value = 0;
};

/// Something on a robot's time line; cycles.
struct Span {
  enum class Kind { Busy, Waiting, Handler, HandlerWaiting, Callback };
  Kind kind = Kind::Busy;
  host::Cycle begin = 0;
  host::Cycle end = 0;
  int vector = -1;              ///< of a handler
  host::Cycle flagged = -1;     ///< when its flag rose; -1 unknown
  host::Cycle first = 0;        ///< its first instruction
  int depth = 0;                ///< handlers that it interrupted
  std::uintptr_t function = 0;  ///< of a callback
};

class RobotTrace final : public host::Observer, public board::UartWatch {
 public:
  /// `runner` null: a robot without firmware. Both outlive this object, which takes itself away from them.
  RobotTrace(board::Board& board, host::Runner* runner, std::vector<Signal> signals, bool spans);
  ~RobotTrace() override;
  RobotTrace(const RobotTrace&) = delete;
  RobotTrace& operator=(const RobotTrace&) = delete;

  const std::vector<Signal>& signals() const { return signals_; }
  /// Between ticks: the robot has run up to `now`. All changes before are then in changes().
  void advance(host::Cycle now) { reached(now); }
  std::deque<Change>& changes() { return changes_; }
  std::vector<Span>& spans() { return spans_; }
  /// The run is over at `now`: what goes on ends there.
  void finish(host::Cycle now);
  /// Bytes received so far, complete or under way.
  std::int64_t received() const { return received_; }

  void reached(host::Cycle at) override;
  void about_to_change(host::Cycle at) override;
  void handler_begins(int vector, host::Cycle flagged, host::Cycle entry, host::Cycle first) override;
  void handler_ends(host::Cycle at) override;
  void callback(std::uintptr_t function, host::Cycle at) override;
  void waited(host::Cycle from, host::Cycle to, int depth) override;
  void ended(host::Cycle at) override;
  void frame(int uart, bool sent, std::uint8_t byte, host::Cycle start, host::Cycle end) override;

 private:
  struct Sampled {
    SignalSource source;
    std::uint64_t value = 0;
    std::vector<int> signals;
  };
  struct Frame {
    std::uint8_t byte;
    host::Cycle start, end;
  };
  void show_until(host::Cycle at);
  void sample(host::Cycle at);
  std::uint64_t value_of(const SignalSource& source, host::Cycle at);
  host::Cycle horizon(host::Cycle at);
  void end_callback(host::Cycle at);
  void end_wait();

  board::Board& board_;
  host::Runner* runner_;
  std::vector<Signal> signals_;
  bool keeps_spans_;
  bool shows_counters_ = false;  // that run freely
  std::vector<Sampled> sampled_;
  std::vector<std::uint64_t> shown_;  // a signal's value as last reported
  bool begun_ = false;
  host::Cycle last_ = 0;  // everything before is reported
  std::deque<Change> changes_;

  std::vector<Span> spans_;
  std::vector<Span> open_;             // handlers, outermost first
  Span callback_;                      // function 0: none
  Span wait_;                          // the latest of the main program, may still grow
  host::Cycle waited_in_handler_ = 0;  // the latest in one ended there
  std::array<std::deque<Frame>, 4> frames_;
  std::array<std::uint8_t, 4> wire_byte_{};
  std::int64_t received_ = 0;
};

}  // namespace trace
