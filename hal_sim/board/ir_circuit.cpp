// SPDX-License-Identifier: MIT
#include "hal_sim/board/ir_circuit.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/checks_params.h"
#include "sim_core/light/proximity.h"

namespace board {

// --- emitters

void IrCircuit::set_line(int line, bool high, Cycle at) {
  if (!lines_) {
    if (!high) return;
    lines_ = std::make_unique<std::array<Line, kEmitterLines>>();
  }
  Line& l = (*lines_)[static_cast<std::size_t>(line)];
  if (l.is_on() == high) return;
  if (!high) l.note_pulse(l.too_long, at);
  l.changed[static_cast<std::size_t>(l.changes++ % Line::kRemembered)] = at;
  lines_on_ += high ? 1 : -1;
}

void IrCircuit::Line::note_pulse(LongPulses& pulses, Cycle end) const {
  const Cycle begin = when(changes - 1), length = end - begin;
  if (length < kLongPulseCycles) return;
  if (pulses.count++ == 0) pulses.first = begin;
  pulses.longest = std::max(pulses.longest, length);
}

Cycle IrCircuit::lit_for(int sensor, Cycle at) const {
  if (!lines_) return -1;
  const Line& line = (*lines_)[static_cast<std::size_t>(sensor & 3)];
  int changes = line.changes;  // up to `at`, not fewer than those that are forgotten
  while (line.when(changes - 1) > at) --changes;
  return changes % 2 != 0 ? at - std::max<Cycle>(0, line.when(changes - 1)) : -1;
}

IrCircuit::LongPulses IrCircuit::long_pulses(int line, Cycle at) const {
  if (!lines_) return {};
  const Line& l = (*lines_)[static_cast<std::size_t>(line)];
  LongPulses pulses = l.too_long;
  if (l.is_on()) l.note_pulse(pulses, at);
  return pulses;
}

// --- what a sample is made of

inline double IrCircuit::light_counts(int sensor, Cycle at) const {
  if (!robot_.scene() || !robot_.is_lit()) return 0;
  const Setup& setup = robot_.setup();
  return sim::sense_irradiance_w_m2(*robot_.scene(), setup.robot, sensor, robot_.clock().click_at(at)) *
         setup.ambient_counts_per_w_m2;
}

inline double IrCircuit::ambient_noise(int sensor, Cycle at, bool lit) const {
  const double deviation = robot_.setup().ambient_noise_counts;
  if (!(deviation > 0)) return 0;
  return deviation * robot_.noise().normal(lit ? NoiseOf::AmbientLit : NoiseOf::AmbientDark, sensor, at);
}

// the phototransistor follows the flash with one time constant; after 300 us nothing is missing
inline double IrCircuit::settled_share(int sensor, Cycle lit_for) const {
  if (lit_for >= kSettled) return 1;
  Settled& kept = settled_[sensor < kRingSensors / 2 ? 0 : 1];
  if (lit_for != kept.lit_for) kept.settle(lit_for);
  return kept.share;
}

void IrCircuit::Settled::settle(Cycle flash) {
  lit_for = flash;
  share = 1.0 - std::exp(-static_cast<double>(flash) / static_cast<double>(kIrSettleCycles));
}

__attribute__((always_inline)) inline double IrCircuit::reflected_counts(int sensor, Cycle at,
                                                                         Cycle lit_for) const {
  const std::size_t i = static_cast<std::size_t>(sensor);
  const Setup& setup = robot_.setup();
  double reflection = 0;
  if (robot_.scene()) {
    const sim::ProximityResponse seen =
        sim::sense_proximity(*robot_.scene(), setup.robot, sensor, robot_.clock().click_at(at));
    reflection = seen.value * setup.ir_gain[i];
    if (reflection != 0 && seen.relative_noise > 0 && setup.ir_noise_scale > 0) {
      const double noise = seen.uniform_noise ? robot_.noise().uniform(NoiseOf::Reflection, sensor, at)
                                              : robot_.noise().normal(NoiseOf::Reflection, sensor, at);
      reflection *= 1.0 + noise * seen.relative_noise * setup.ir_noise_scale;
    }
  }
  return (reflection + setup.ir_offset_counts[i]) * settled_share(sensor, lit_for);
}

IrConversion IrCircuit::conversion(int sensor, Cycle at, Cycle lit_for) const {
  if (!is_driven(sensor)) lit_for = -1;
  const std::size_t i = static_cast<std::size_t>(sensor);
  const Setup& setup = robot_.setup();
  IrConversion c;
  if (const sim::Scene* scene = robot_.scene()) {
    const sim::Clicks when = robot_.clock().click_at(at);
    if (robot_.is_lit()) c.irradiance_w_m2 = sim::sense_irradiance_w_m2(*scene, setup.robot, sensor, when);
    if (lit_for >= 0) {
      const sim::ProximityResponse seen = sim::sense_proximity(*scene, setup.robot, sensor, when);
      c.reflection_counts = seen.value * setup.ir_gain[i];
      c.relative_noise = seen.relative_noise;
      c.uniform_noise = seen.uniform_noise;
    }
  }
  c.light_counts = c.irradiance_w_m2 * setup.ambient_counts_per_w_m2;
  if (lit_for >= 0) {
    c.offset_counts = setup.ir_offset_counts[i];
    c.settled = settled_share(sensor, lit_for);
  }
  return c;
}

// --- samples

int IrCircuit::counts_in_dark(int sensor, Cycle at, Cycle lit_for) const {
  if (!is_driven(sensor)) return kAdcMax;
  return adc_counts(kAdcMax - reflected_counts(sensor, at, lit_for));
}

int IrCircuit::counts(int sensor, Cycle at, Cycle lit_for) const {
  if (!is_driven(sensor)) lit_for = -1;
  if (robot_.damage()) return damaged_counts(sensor, at, lit_for);
  const bool lit = lit_for >= 0;
  if (is_dark()) return lit ? counts_in_dark(sensor, at, lit_for) : kAdcMax;
  const double light = light_counts(sensor, at) + ambient_noise(sensor, at, lit);
  return adc_counts(kAdcMax - light - (lit ? reflected_counts(sensor, at, lit_for) : 0));
}

/// counts() with all that may be wrong, one thing behind the other.
int IrCircuit::damaged_counts(int sensor, Cycle at, Cycle lit_for) const {
  const bool lit = lit_for >= 0;
  const auto s = static_cast<std::size_t>(sensor);
  const Setup& setup = robot_.setup();
  const Damage& damage = *robot_.damage();
  const Damage::Sensor& wrong = damage.sensors[s];
  double light = light_counts(sensor, at);
  const double noise = ambient_noise(sensor, at, lit);
  const double settled = lit ? settled_share(sensor, lit_for) : 0;
  double reflected = lit ? reflected_counts(sensor, at, lit_for) : 0;
  // in the order of a sum without damage, so that one which is over leaves the same numbers
  const auto counts = [&] { return adc_counts(kAdcMax - (light + noise) - reflected); };
  int before = counts();
  const auto noted = [&](const Noticed& what) {
    const int now = counts();
    if (now != before) damage.note(what, at);
    before = now;
  };
  if (damage.lifted.at(at) != 0) {
    reflected = lit ? setup.ir_offset_counts[s] * settled : 0;
    noted(damage.saw_nothing);
  }
  if (const double lamp = wrong.lamp_w_m2.at(at); lamp != 0) {
    light += lamp * setup.ambient_counts_per_w_m2;
    noted(wrong.lit);
  }
  if (const double cover = wrong.cover.at(at); cover >= 0) {
    light = 0;
    if (lit) reflected = (cover * setup.ir_gain[s] + setup.ir_offset_counts[s]) * settled;
    noted(wrong.covered);
  }
  if (const double passes = wrong.transmits.at(at); passes != 1) {
    light *= passes;
    reflected *= passes * passes;
    noted(wrong.dirty);
  }
  if (wrong.emitter_dead.at(at) != 0) {
    reflected = 0;
    noted(wrong.dead);
  }
  if (wrong.receiver_dead.at(at) != 0) {
    light = reflected = 0;
    noted(wrong.dead);
  }
  return before;
}

int IrCircuit::proximity_counts(int sensor, Cycle at) const {
  if (!robot_.scene()) return 0;
  if (robot_.damage()) return damaged_counts(sensor, at, -1) - damaged_counts(sensor, at, kSettled);
  const double seen =
      sim::sense_proximity(*robot_.scene(), robot_.setup().robot, sensor, robot_.clock().click_at(at)).value *
      robot_.setup().ir_gain[static_cast<std::size_t>(sensor)];
  return static_cast<int>(std::clamp(std::floor(seen + 0.5), 0.0, double{kAdcMax}));
}

}  // namespace board
