// SPDX-License-Identifier: MIT
// Where a robot's serial line ends outside the simulation. A line carries bytes only; timing is the Uart's.
// Servers listen on 127.0.0.1 only. Nothing here blocks.
// Not modelled: parity, framing errors, flow control (the robot's connector has no such pins).
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "hal_sim/board/clock.h"
#include "hal_sim/board/first_use.h"

namespace board {

class UartEnd {
 public:
  virtual ~UartEnd() = default;

  /// Bytes whose stop bit has left the robot, in order; `ends` are the cycles at which they ended. Bytes that
  /// nobody takes are lost, as on a wire.
  virtual void deliver(const std::uint8_t* bytes, const Cycle* ends, std::size_t count) = 0;

  /// Takes up to `room` bytes that have come from outside by cycle `at`. Returns how many.
  virtual std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle at) = 0;

  /// The line was held low for longer than a byte; over at cycle `at`. Nothing, on most lines.
  virtual void on_break(Cycle /*at*/) {}

  /// The robot runs for the first time: what an earlier run has left may go.
  virtual void begin() {}

  /// The robot begins as when it was first switched on. Nothing, for ends that are no part of it.
  virtual void begin_again() {}

  /// Nothing will come out of collect() by itself: it need not be asked every tick. Written between ticks and
  /// by the robot's own thread.
  bool is_idle() const { return idle_; }
  /// First time that it is not.
  FirstUse first_use;
  /// Called when it is idle no more: its robot may be asleep over many ticks. Empty: nobody asks.
  std::function<void()> wake;

  /// A Bluetooth link carries packets: bytes sent without a pause arrive together. True for ends that
  /// programs talk to, since many take what one read() gives them for the whole reply.
  virtual bool takes_packets() const { return false; }

  /// How to reach it, for messages: "/tmp/robot0", "tcp:127.0.0.1:5000", "file:out.txt"; empty
  /// when nobody outside can.
  virtual std::string name() const = 0;

  /// What was lost on the way out: "file:F: cannot be written: No space left on device";
  /// empty while all is well.
  virtual std::string error() const { return {}; }

 protected:
  void set_idle(bool is) {
    idle_ = is;
    if (!is) first_use.note();
  }

 private:
  bool idle_ = false;
};

/// Whether a description is of files; which bytes go to, and come from; `in` may be empty.
bool is_file_end(const std::string& description, std::string& out, std::string& in);

/// Opens an end from its description:
///   "none"               no end (null)
///   "-"                  no end either: whoever runs the robot may show its text
///   "pty" "pty:LINK"     a pseudo-terminal; LINK (default `default_link`) is a symbolic link to it. One
///                        that a run left behind is replaced; a file, a link to a file or a link of a run
///                        that goes on is not
///   "tcp:PORT"           a server on 127.0.0.1; 0 takes any free port; one client at a time
///   "file:OUT" "file:OUT,IN"  bytes go to OUT, bytes come from IN at the line's speed
/// On failure null, and `error` says what was wrong (one line, without a full stop).
std::unique_ptr<UartEnd> open_uart_end(const std::string& description, const std::string& default_link,
                                       std::string& error);

}  // namespace board
