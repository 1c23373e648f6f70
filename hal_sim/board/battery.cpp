// SPDX-License-Identifier: MIT
// See battery.h.
#include "hal_sim/board/battery.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "hal_sim/board/battery_params.h"

namespace board {

namespace {

constexpr int kPoints = static_cast<int>(std::size(kCell));

constexpr double kSecondsPerCycle = 1 / static_cast<double>(kFcyHz);
constexpr double kSettledShare = 1e-4;  // of a full battery, after which the curve is looked at again
double seconds(Cycle span) { return static_cast<double>(span) / static_cast<double>(kFcyHz); }

/// Mean of the curve: what a full battery's charge is worth.
double mean_rest_v() {
  double sum = 0;
  for (int i = 1; i < kPoints; ++i)
    sum += (kCell[i].charge - kCell[i - 1].charge) * (kCell[i].rest_v + kCell[i - 1].rest_v) / 2;
  return sum;
}

}  // namespace

double Battery::rest_v(double charge) {
  int i = 1;
  while (i < kPoints - 1 && kCell[i].charge < charge) ++i;
  return between(i, charge);
}

double Battery::between(int i, double charge) {
  const CellPoint &a = kCell[i - 1], &b = kCell[i];
  return std::max(0.0, a.rest_v + (charge - a.charge) * (b.rest_v - a.rest_v) / (b.charge - a.charge));
}

double Battery::charge_at(double rest_v) {
  int i = 1;
  while (i < kPoints - 1 && kCell[i].rest_v < rest_v) ++i;
  const CellPoint &a = kCell[i - 1], &b = kCell[i];
  return a.charge + (rest_v - a.rest_v) * (b.charge - a.charge) / (b.rest_v - a.rest_v);
}

Battery::Battery(double capacity_wh, double volts, double amps)
    : capacity_as_(capacity_wh * 3600 / mean_rest_v()),
      amps_(amps),
      charge_(charge_at(volts + amps * kInnerResistanceOhm)),
      resistance_ohm_(kInnerResistanceOhm) {}

double Battery::charge(Cycle at) const {
  static const double kNothingLeft = charge_at(0);
  return std::max(kNothingLeft, charge_ - flow(at) * kSecondsPerCycle / capacity_as_);
}

double Battery::voltage(Cycle at) const {
  return std::max(0.0, rest_v(charge(at)) - drop_v_ - amps_ * resistance_ohm_);
}

double Battery::sound_voltage(Cycle at) const {
  return std::max(0.0, rest_v(charge(at)) - amps_ * kInnerResistanceOhm);
}

Cycle Battery::empty_since(Cycle at) const {
  if (empty_since_ < kNever) return empty_since_;
  return charge_ > 0 && charge(at) <= 0 ? empty_between(at) : kNever;
}

// the mean current since then, as good as constant between two looks at the curve
Cycle Battery::empty_between(Cycle at) const {
  const double share = charge_ * capacity_as_ / (flow(at) * kSecondsPerCycle);
  return settled_ + static_cast<Cycle>(share * static_cast<double>(at - settled_));
}

void Battery::weaken(double drop_v, double more_ohm, Cycle at) {
  settle(at);
  drop_v_ = drop_v;
  resistance_ohm_ = kInnerResistanceOhm + more_ohm;
}

// From charge 0 on, V times a share of the whole.
double Battery::energy(double charge) {
  if (charge <= 0) return charge * (rest_v(0) + rest_v(charge)) / 2;
  double sum = 0;
  for (int i = 1; i < kPoints && kCell[i - 1].charge < charge; ++i) {
    const double to = i == kPoints - 1 ? charge : std::min(charge, kCell[i].charge);
    sum += (to - kCell[i - 1].charge) * (kCell[i - 1].rest_v + between(i, to)) / 2;
  }
  return sum;
}

double Battery::used_wh(Cycle at) const {
  const double left = charge(at), given_as = (charge_ - left) * capacity_as_;
  const double of_cell_j = (energy(charge_) - energy(left)) * capacity_as_;
  // of what would have flowed an empty one gives no more
  const double flowed_as = flow(at) * kSecondsPerCycle, share = flowed_as > 0 ? given_as / flowed_as : 0;
  const double lost_j = share * (drop_v_ * flow(at) + resistance_ohm_ * heat(at)) * kSecondsPerCycle;
  return (used_j_ + std::max(0.0, of_cell_j - lost_j)) / 3600;
}

double Battery::minutes_left(Cycle at) const {
  const double drawn_as = drawn_as_ + flow(at) * kSecondsPerCycle;
  if (drawn_as <= 0 || at <= 0) return -1;
  return std::max(0.0, charge(at)) * capacity_as_ / (drawn_as / seconds(at)) / 60;
}

void Battery::draw(double amps, Cycle at) {
  if (amps == amps_) return;
  flow_ = flow(at);
  heat_ = heat(at);
  since_ = at;
  amps_ = amps;
  if (flow_ * kSecondsPerCycle > kSettledShare * capacity_as_) settle(at);
}

void Battery::settle(Cycle at) {
  used_j_ = used_wh(at) * 3600;
  drawn_as_ += flow(at) * kSecondsPerCycle;
  empty_since_ = empty_since(at);
  charge_ = charge(at);
  settled_ = at;
  flow_ = heat_ = 0;
  since_ = at;
}

void Battery::set_voltage(double volts, Cycle at) {
  settle(at);
  charge_ = charge_at(volts + drop_v_ + amps_ * resistance_ohm_);
}

void Battery::begin_again(double volts, double amps, Cycle at) {
  draw(amps, at);
  set_voltage(volts, at);
}

Cycle Battery::below(double volts, Cycle at) const {
  if (voltage(at) < volts || amps_ <= 0 || volts <= 0) return kNever;
  if (volts <= -drop_v_ - amps_ * resistance_ohm_) return kNever;  // an empty one is not below either
  const double left = charge(at) - charge_at(volts + drop_v_ + amps_ * resistance_ohm_);
  const double cycles = std::floor(left * capacity_as_ / amps_ * static_cast<double>(kFcyHz));
  if (cycles >= static_cast<double>(kNever) / 2) return kNever;
  // rounding may leave it a cycle off either way
  Cycle when = at + std::max<Cycle>(1, static_cast<Cycle>(cycles));
  while (when > at + 1 && voltage(when - 1) < volts) --when;
  while (voltage(when) >= volts) ++when;
  return when;
}

}  // namespace board
