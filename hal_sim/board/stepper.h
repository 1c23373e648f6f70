// SPDX-License-Identifier: MIT
// One stepper motor with its gear, as its four coil pins see it.
//
//   LATD0..3 left / LATD4..7 right:  A B C D     phase 0: B D   1: B C   2: A C   3: A D   (two coils on)
//
// Modelled: a pattern one phase away from the rotor pulls it one step; two phases away: the step is lost (it
// might go either way); no coil or a single coil: the gear holds. The rotor follows a step at constant speed
// during the time it has (the expected period, at most kRotorMoveCycles), so it is never ahead of the
// pattern, and a constant step rate gives a constant rim speed. Pull-out: a rotor that is more than one step
// of kPullOutCycles behind loses the next one. A pattern that another one follows within kPatternCycles does
// not pull. One that is switched off early does: the library's drivers switch all coils off whenever a speed
// is set, often within a step, and count that step.
// Not modelled: half steps and single-coil drive, pull-out at high load, ringing, steps that a real rotor
// does not finish because its coils were on for too short.
//
// A motor may be made to lose steps (damage.h): its rotor follows the pattern electrically,
// its wheel does not.
//
// Steps that were lost and coils that heat the motor are counted (faults()); copies count for themselves.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hal_sim/board/checks_params.h"
#include "hal_sim/board/damage.h"
#include "hal_sim/board/epuck_params.h"

namespace board {

enum class Wheel { Left = 0, Right = 1 };

inline constexpr unsigned kPhaseCoils[4] = {0xA, 0x6, 0x5, 0x9};  // bit 0 = A [lib: motor_led/e_motors.c]

/// What a motor would not do for its driver; each with the cycle of its first time.
struct StepperFaults {
  struct Fault {
    std::int64_t count = 0;
    Cycle first = 0;
    void note(Cycle at) {
      if (count++ == 0) first = at;
    }
  };
  Fault jumps;     ///< the pattern jumped by two phases: step lost
  Fault too_fast;  ///< the pattern went on before the rotor had come near: step lost
  Fault opposed;  ///< both ends of a coil high together: the coil is without current, no pattern of the motor
  Fault held;     ///< both coils energised for kRestCycles without a step
};

/// How a rotor turns on, evenly.
struct RotorCourse {
  double steps = 0, rate = 0;  ///< position now; steps per cycle
  Cycle until = 0;
};

class Stepper {
 public:
  /// `forward` +1: the wheel rolls forward when the phase grows (right); -1 when it falls (left).
  explicit Stepper(int forward) : forward_(forward) {}

  int forward() const { return forward_; }
  /// Coils A to D in bits 0 to 3.
  unsigned coils() const { return coils_; }
  /// Full steps of the wheel, forward positive.
  std::int64_t steps() const { return motion_.steps; }
  /// When a pattern last pulled the rotor on.
  Cycle stepped_at() const { return motion_.stepped_at; }
  std::int64_t lost() const { return faults_.jumps.count + faults_.too_fast.count; }
  /// Up to `at`, coils that are held at this moment included.
  StepperFaults faults(Cycle at) const {
    Stepper now = *this;
    now.look_back(at);
    return now.faults_;
  }
  /// Is the rotor where a driver holding `phase` believes it to be?
  bool is_at(int phase) const { return connected_ && !loss_ && rotor_phase() == (phase & 3); }
  /// Steps are lost from now on as this says, or, null, no longer; it outlives the motor's use.
  void lose_steps(StepLoss* loss) { loss_ = loss; }

  /// Do the four pins drive the coils (outputs), or do they float (inputs, as after a reset)?
  void connect(bool driven, Cycle at = 0) {
    if (driven && !connected_) changed_at_ = at;
    connected_ = driven;
  }
  bool connected() const { return connected_; }

  /// The pins change. `move`: time the rotor may take for a step; 0 when the next step is not known: as long
  /// as since the last one.
  void energise(unsigned coils, Cycle at, Cycle move = 0) {
    look_back(at);
    coils_ = coils;
    changed_at_ = at;
    const int phase = phase_of(coils);
    if (!connected_ || phase < 0) return;
    if (phase != rotor_phase() && at - motion_.stepped_at < kPatternCycles) motion_ = before_;
    const int ahead = (phase - rotor_phase()) & 3;
    if (ahead == 1) step(forward_, at, move);
    if (ahead == 3) step(-forward_, at, move);
    if (ahead == 2) (at - motion_.pulled_at < kPullOutCycles ? faults_.too_fast : faults_.jumps).note(at);
    motion_.pulled_at = at;
  }

  /// `count` > 0 regular steps at once, all in wheel direction `direction`, the last one at `last`; `before`
  /// and `earlier`: when the two before it came, of which only those within the count are looked at. Each had
  /// time to finish before the next. The caller guarantees that rotor and driver agree.
  void turn(std::int64_t count, int direction, Cycle last, Cycle before, Cycle earlier, unsigned coils) {
    if (count > 1) {
      const Cycle since = count > 2 ? earlier : motion_.stepped_at;
      before_ = motion_.after((count - 2) * direction, (count - 2) * kPullOutCycles, direction, before,
                              before - since);
    } else {
      before_ = motion_;
    }
    motion_ = before_.after(0, 0, direction, last, last - before_.stepped_at);
    coils_ = coils;
    changed_at_ = last;
  }

  void set_coils_only(unsigned coils) { coils_ = coils; }

  /// As when the robot was first switched on: no step was made yet. What was told of its driver stays.
  void begin_again(Cycle at) {
    motion_ = Motion{};
    motion_.moved_at = motion_.ready_at = at;
    motion_.stepped_at = at - kPatternCycles;
    motion_.pulled_at = at - kPullOutCycles;
    before_ = motion_;
    coils_ = 0;
    changed_at_ = at;
  }

  /// Rotor position in steps of the wheel, forward positive; also shortly before the last step, when the
  /// driver's handler has been called that is about to make it.
  double position(Cycle at) const { return (at < motion_.moved_at ? before_ : motion_).position(at); }
  /// How that goes on as long as no pattern changes.
  RotorCourse course(Cycle at) const {
    const bool is_ahead = at < motion_.moved_at;
    const Motion& m = is_ahead ? before_ : motion_;
    const bool moves = at < m.moved_at + m.move;
    return {m.position(at), moves ? (static_cast<double>(m.steps) - m.from) / static_cast<double>(m.move) : 0,
            is_ahead ? at
            : moves  ? m.moved_at + m.move
                     : kNever};
  }

 private:
  /// What a pattern that turns out too short takes back.
  struct Motion {
    std::int64_t steps = 0;
    double from = 0;                     // position when the last step began
    Cycle moved_at = 0;                  // when it began
    Cycle move = 0;                      // how long it takes
    Cycle stepped_at = -kPatternCycles;  // when a pattern last pulled the rotor on
    Cycle pulled_at = -kPullOutCycles;   // when the last pattern of the motor began
    Cycle ready_at = 0;                  // a rotor at its fastest has done all its steps

    double position(Cycle at) const {
      const Cycle since = at - moved_at;
      const double target = static_cast<double>(steps);
      if (since >= move) return target;
      if (since <= 0) return from;
      return from + (target - from) * (static_cast<double>(since) / static_cast<double>(move));
    }
    /// A step further, which begins at `at` where the rotor is, at `from`.
    Motion stepped(int direction, double from, Cycle at, Cycle move) const {
      return {steps + direction,
              from,
              at,
              std::min(move, kRotorMoveCycles),
              at,
              at,
              std::max(ready_at, at) + kPullOutCycles};
    }
    /// A regular step, behind others that took it so far: the rotor stands where they have brought it.
    Motion after(std::int64_t passed, Cycle lasted, int direction, Cycle at, Cycle move) const {
      Motion m = *this;
      m.steps += passed;
      m.ready_at += lasted;
      return m.stepped(direction, static_cast<double>(m.steps), at, move);
    }
  };

  /// -1: no pattern of the motor.
  static int phase_of(unsigned coils) {
    constexpr signed char kPhase[16] = {-1, -1, -1, -1, -1, 2, 1, -1, -1, 3, 0, -1, -1, -1, -1, -1};
    static_assert(kPhase[kPhaseCoils[0]] == 0 && kPhase[kPhaseCoils[1]] == 1 && kPhase[kPhaseCoils[2]] == 2 &&
                  kPhase[kPhaseCoils[3]] == 3);
    return kPhase[coils & 15];
  }
  int rotor_phase() const { return static_cast<int>((motion_.steps + slipped_) * forward_) & 3; }

  void step(int direction, Cycle at, Cycle move) {
    if (motion_.ready_at - at > kPullOutCycles) return faults_.too_fast.note(at);
    if (loss_ && loss_->takes(at)) {
      slipped_ += direction;
      return;
    }
    before_ = motion_;
    if (move <= 0) move = at - motion_.stepped_at;
    motion_ = motion_.stepped(direction, position(at), at, move);
  }

  /// The pattern that ends at `at`: has it heated the motor for nothing?
  void look_back(Cycle at) {
    if (!connected_ || coils_ == 0) return;
    const bool opposed = (coils_ & 3) == 3 || (coils_ & 12) == 12;
    if (opposed && at - changed_at_ >= kPatternCycles) faults_.opposed.note(changed_at_);
    const bool both = (coils_ & 3) != 0 && (coils_ & 12) != 0;
    if (both && !opposed && at - changed_at_ >= kRestCycles) faults_.held.note(changed_at_);
  }

  int forward_;
  bool connected_ = false;
  unsigned coils_ = 0;
  Cycle changed_at_ = 0;  // when the present pattern began
  StepLoss* loss_ = nullptr;
  std::int64_t slipped_ = 0;  // steps that the rotor's field has made and the wheel has not
  Motion motion_, before_;
  StepperFaults faults_;
};

}  // namespace board
