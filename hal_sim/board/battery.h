// SPDX-License-Identifier: MIT
// The robot's lithium-ion battery: a voltage that depends on the charge left, behind an inner resistance.
//
//   terminal voltage = rest_v(charge) - current * inner resistance      charge falls with the current
//
// The current is constant between changes that the board reports, so charge, voltage and the moment at which
// the low-battery detector falls are closed forms; nothing is ticked, and nothing costs between changes.
// Modelled: discharge curve, sag under load, energy drawn. Not modelled: temperature, ageing, recovery after
// a load, self-discharge, the protection circuit (an empty battery goes on at a falling voltage).
#pragma once
#include "hal_sim/board/cycle.h"

namespace board {

class Battery {
 public:
  /// `capacity_wh`: energy of a full battery at small currents, above 0. `volts`: at the terminals at cycle 0
  /// while `amps` flow.
  Battery(double capacity_wh, double volts, double amps);

  /// From `at` on this current flows, A, 0 or more. `at` not before the last change.
  void draw(double amps, Cycle at);
  /// Another battery state, as if charged: terminal voltage at `at` with the present current.
  void set_voltage(double volts, Cycle at);
  /// As in the constructor, from `at` on; what was used stays counted.
  void begin_again(double volts, double amps, Cycle at);

  /// From `at` on the cell's own voltage is lower by so much (V, 0 or more), and so much more resistance lies
  /// before its terminals (ohm, 0 or more).
  void weaken(double drop_v, double more_ohm, Cycle at);
  /// What the terminals would have otherwise, V.
  double sound_voltage(Cycle at) const;

  double amps() const { return amps_; }
  /// V at the terminals, 0 or more.
  double voltage(Cycle at) const;
  /// Share of a full battery, 1 full, 0 empty; above 1 and below 0 beyond 4.2 V and 3.0 V, where it
  /// ends at a voltage of 0.
  double charge(Cycle at) const;
  /// Cycle at which the charge was used up for the first time, but for what the current changed since it was
  /// looked at last; kNever: it is not yet.
  Cycle empty_since(Cycle at) const;
  /// Energy that left the terminals since cycle 0, Wh.
  double used_wh(Cycle at) const;
  /// Until empty at the mean current so far, minutes, 0 or more; negative when nothing was drawn yet.
  double minutes_left(Cycle at) const;
  /// First cycle after `at` at which the voltage is below `volts` when the current stays; kNever when it is
  /// below already or never gets there.
  Cycle below(double volts, Cycle at) const;

  /// V at rest for a charge, and back. Linear between the points of the curve and beyond its ends.
  static double rest_v(double charge);
  static double charge_at(double rest_v);

 private:
  static double between(int point, double charge);
  static double energy(double charge);
  /// What has flowed from settled_ to `at`: ampere cycles, and their squares, of which the inner
  /// resistance makes heat.
  double flow(Cycle at) const { return flow_ + amps_ * static_cast<double>(at - since_); }
  double heat(Cycle at) const { return heat_ + amps_ * amps_ * static_cast<double>(at - since_); }
  void settle(Cycle at);
  Cycle empty_between(Cycle at) const;

  double capacity_as_;  // ampere seconds
  double amps_;
  Cycle since_ = 0;    // the present current flows since
  Cycle settled_ = 0;  // the state is of then
  Cycle empty_since_ = kNever;
  // the state when it was settled last, and what has flowed from then to since_: emitters flash hundreds of
  // times a second, and the state matters to whoever asks
  double charge_;
  double used_j_ = 0;    // joule
  double drawn_as_ = 0;  // ampere seconds
  double drop_v_ = 0, resistance_ohm_;
  double flow_ = 0, heat_ = 0;
};

}  // namespace board
