// SPDX-License-Identifier: MIT
// One stepper motor with its gear, as its four coil pins see it.
//
//   LATD0..3 left / LATD4..7 right:  A B C D     phase 0: B D   1: B C   2: A C   3: A D   (two coils on)
//
// Modelled: a pattern one phase away from the rotor pulls it one step; two phases away: the step is lost (it
// might go either way); no coil or a single coil: the gear holds. The rotor follows a step at constant speed
// during the time it has (the expected period, at most kRotorMoveCycles), so it is never ahead of the
// pattern, and a constant step rate gives a constant rim speed.
// Not modelled: half steps and single-coil drive, pull-out at high load or speed, ringing.
#pragma once
#include <cstdint>

#include "hal_sim/board/epuck_params.h"

namespace board {

inline constexpr unsigned kPhaseCoils[4] = {0xA, 0x6, 0x5, 0x9};  // bit 0 = A [lib: motor_led/e_motors.c]

class Stepper {
 public:
  /// `forward` +1: the wheel rolls forward when the phase grows (right); -1 when it falls (left).
  explicit Stepper(int forward) : forward_(forward) {}

  int forward() const { return forward_; }
  /// Coils A to D in bits 0 to 3.
  unsigned coils() const { return coils_; }
  /// Full steps of the wheel, forward positive.
  std::int64_t steps() const { return steps_; }
  std::int64_t lost() const { return lost_; }
  /// Is the rotor where a driver holding `phase` believes it to be?
  bool is_at(int phase) const { return connected_ && rotor_phase() == (phase & 3); }

  /// Do the four pins drive the coils (outputs), or do they float (inputs, as after a reset)?
  void connect(bool driven) { connected_ = driven; }
  bool connected() const { return connected_; }

  /// The pins change. `move`: time the rotor may take for a step.
  void energise(unsigned coils, Cycle at, Cycle move = kRotorMoveCycles) {
    coils_ = coils;
    if (!connected_) return;
    for (int phase = 0; phase < 4; ++phase) {
      if (coils != kPhaseCoils[phase]) continue;
      const int ahead = (phase - rotor_phase()) & 3;
      if (ahead == 1) step(forward_, at, move);
      if (ahead == 3) step(-forward_, at, move);
      if (ahead == 2) ++lost_;
    }
  }

  /// `count` > 0 regular steps at once, all in wheel direction `direction`, the last one at `last`, each of
  /// which had time to finish before the next. The caller guarantees that rotor and driver agree.
  void turn(std::int64_t count, int direction, Cycle last, Cycle move, unsigned coils) {
    steps_ += count * direction;
    from_ = static_cast<double>(steps_ - direction);
    moved_at_ = last;
    move_ = move;
    coils_ = coils;
  }

  void set_coils_only(unsigned coils) { coils_ = coils; }

  /// Rotor position in steps of the wheel, forward positive.
  double position(Cycle at) const {
    const Cycle since = at - moved_at_;
    const double target = static_cast<double>(steps_);
    if (since >= move_) return target;
    if (since <= 0) return from_;
    return from_ + (target - from_) * (static_cast<double>(since) / static_cast<double>(move_));
  }

 private:
  int rotor_phase() const { return static_cast<int>(steps_ * forward_) & 3; }

  void step(int direction, Cycle at, Cycle move) {
    from_ = position(at);
    steps_ += direction;
    moved_at_ = at;
    move_ = move < kRotorMoveCycles ? move : kRotorMoveCycles;
  }

  int forward_;
  bool connected_ = false;
  unsigned coils_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t lost_ = 0;
  double from_ = 0;     // position when the last step began
  Cycle moved_at_ = 0;  // when it began
  Cycle move_ = 0;      // how long it takes
};

}  // namespace board
