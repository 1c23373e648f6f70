// SPDX-License-Identifier: MIT
// The basic proximity driver (a_d/e_prox on Timer 1, its twin on Timer 2), in closed form.
//
//   event 2k: dark samples of pair k mod 4, IR LED on;  5168 cycles later
//   event 2k+1: lit samples, reflected = dark - lit, LED off;  30968 cycles later the next pair
//
// A value is evaluated when it is asked for, at the instant at which it was taken, and then kept.
// Not modelled: interrupts of others that delay the two conversions.
// Source: [lib: a_d/e_prox.c], facts restated.
#pragma once
#include <array>
#include <cstdint>

#include "hal_sim/drivers/driver_params.h"

namespace board {
class Board;
}

namespace drivers {

using board::Board;

class BasicProx {
 public:
  explicit BasicProx(const Board& board) : board_(board) {}

  /// e_init_prox(): the timer starts from 0; the state machine goes on where it was.
  void start(Cycle at);
  /// e_stop_prox(): values stay.
  void stop(Cycle at);
  /// TON of its timer cleared / set by another driver: the rest of the period under way is kept meanwhile.
  /// release() starts the timer even if e_stop_prox() had stopped it, as the library's do.
  void hold(Cycle at);
  void release(Cycle at);
  void reset(Cycle at);
  bool is_on() const { return on_; }

  /// Interrupts of the driver so far.
  std::int64_t events(Cycle at) const;
  int ambient(int sensor, Cycle at);
  int reflected(int sensor, Cycle at);
  int peek_reflected(int sensor, Cycle at) const;
  Cycle horizon(Cycle at) const;
  unsigned pulses(Cycle at) const;

 private:
  struct Sample {
    std::int64_t event = -1;
    int counts = 0;
  };
  /// Cycles from event 0 to event `event` of an uninterrupted run.
  static Cycle span(std::int64_t event) {
    return event / 2 * (kBasicPulseCycles + kBasicRestCycles) + event % 2 * kBasicPulseCycles;
  }
  Cycle event_cycle(std::int64_t event) const {
    return started_ + kBasicPulseCycles + span(event) - span(base_);
  }
  /// Newest event of the sensor's pair with this phase (0 dark, 1 lit) among the first `events`; below 0 if
  /// none.
  static std::int64_t newest(std::int64_t events, int sensor, int phase);
  int evaluate(int sensor, std::int64_t event) const;
  int evaluate_reflected(int sensor, std::int64_t event) const;
  void settle(Cycle at);

  const Board& board_;
  bool on_ = false;
  Cycle started_ = 0;
  Cycle left_ = 0;         // of the period under way when the timer was stopped; 0: it never ran
  std::int64_t base_ = 0;  // events before the last start
  std::array<Sample, 8> dark_{};
  std::array<Sample, 8> reflected_{};
};

}  // namespace drivers
