// SPDX-License-Identifier: MIT
// What is wrong with one robot's electrics: what a bench can do to it, each from a cycle on until another
// (hal_sim/faults does it). A board without any has none of this, and pays a comparison with null.
//
//   light, reflection --> lifted --> lamp --> cover --> dirt --> dead parts --> converter
//
// Samples are worked out when somebody reads them, so whatever acts on them can be asked for the past. Each
// effect is noted the first time that it changed what the program or the world got: looks from outside do
// not count (Unseen).
// Not modelled: faults that come and go within a sample, heat, anything that a fault breaks for good.
#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "hal_sim/board/cycle.h"

namespace board {

/// A number that changes at known cycles and can be asked for any of them.
class Timed {
 public:
  explicit Timed(double at_first = 0) : first_(at_first) {}
  /// From `at` on, which is not before the last change.
  void set(double value, Cycle at) {
    if (!changes_.empty() && changes_.back().first == at)
      changes_.back().second = value;
    else if (value != now())
      changes_.emplace_back(at, value);
  }
  double at(Cycle cycle) const {
    for (std::size_t i = changes_.size(); i-- > 0;)
      if (cycle >= changes_[i].first) return changes_[i].second;
    return first_;
  }
  double now() const { return changes_.empty() ? first_ : changes_.back().second; }

 private:
  double first_;
  std::vector<std::pair<Cycle, double>> changes_;
};

/// When an effect was noticed first since somebody took it.
class Noticed {
 public:
  void note(Cycle at) const {
    if (at < first_) first_ = at;
  }
  /// kNever: not yet.
  Cycle first() const { return first_; }
  void forget() { first_ = kNever; }

 private:
  mutable Cycle first_ = kNever;
};

/// Steps that a motor does not make although its pattern asks for them.
class StepLoss {
 public:
  /// `key`: of the wheel's own random numbers.
  explicit StepLoss(std::uint64_t key) : key_(key) {}
  /// All of them, because something holds the wheel.
  void block(bool is) { is_blocked_ = is; }
  /// A share of them, 0 to 1: a rotor that falls behind by a whole electrical turn loses four in a row.
  void lose(double share);
  bool is_active() const { return is_blocked_ || begins_q32_ > 0 || left_ > 0; }
  /// A pattern pulls: is the step lost? Asked once for each.
  bool takes(Cycle at);

  Noticed blocked, lost;
  std::int64_t count = 0;

 private:
  std::uint64_t key_;
  bool is_blocked_ = false;
  std::uint64_t begins_q32_ = 0;  // chance of a fall with each step, of 2^32
  int left_ = 0;                  // steps that are still to be lost in this one
  std::uint64_t tried_ = 0;
};

struct Damage {
  /// Of a robot's seed.
  explicit Damage(std::uint64_t seed, int robot);

  struct Sensor {
    Timed cover{-1};     ///< counts that what covers it reflects, shutting out all light; -1: nothing does
    Timed transmits{1};  ///< share of the light that passes the dirt on it; a flash passes it twice
    Timed lamp_w_m2;     ///< light of a lamp that somebody holds
    Timed emitter_dead, receiver_dead;  ///< 1: is
    Noticed covered, dirty, lit, dead;
  };
  std::array<Sensor, 8> sensors;
  Timed lifted;  ///< 1: it hangs in the air, and its sensors look at nothing
  Noticed saw_nothing;

  std::array<Timed, 3> deaf;  ///< 1: that microphone hears nothing
  std::array<Noticed, 3> heard_nothing;

  Timed acc_stuck;                  ///< 1: the accelerometer's outputs stand still
  std::array<int, 3> acc_counts{};  ///< ... at these counts, before revision 1.3
  Cycle acc_since = 0;              ///< ... since then
  Noticed acc_stood_still;

  std::uint32_t dead_leds = 0;  ///< bits as Pins::leds(); those give no light and draw nothing
  Timed lens_covered;           ///< 1: no light reaches the camera
  Noticed saw_dark;

  /// Pins that somebody holds at a level, port by port: which, and at which.
  std::array<std::uint16_t, 6> held_pins{}, held_levels{};
  std::array<std::uint16_t, 6> rose{}, fell{};  ///< inputs that were so just now, until the chip hears of it
  std::uint64_t pins_changed = 0;               ///< grows with each change of these

  std::array<StepLoss, 2> steps;  ///< left, right

  /// While one of these lives, looking notices nothing: somebody outside asks.
  mutable int unseen = 0;
  void note(const Noticed& what, Cycle at) const {
    if (unseen == 0) what.note(at);
  }
};

/// While one of these lives, somebody outside asks: what is wrong has not been noticed by the robot.
class Unseen {
 public:
  explicit Unseen(const Damage* damage) : damage_(damage) {
    if (damage_) ++damage_->unseen;
  }
  ~Unseen() {
    if (damage_) --damage_->unseen;
  }
  Unseen(const Unseen&) = delete;
  Unseen& operator=(const Unseen&) = delete;

 private:
  const Damage* damage_;
};

}  // namespace board
