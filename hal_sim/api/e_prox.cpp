// SPDX-License-Identifier: MIT
// a_d/advance_ad_scan/e_prox.h. Source: [lib: a_d/advance_ad_scan/e_prox.c], facts restated.
#include "hal_sim/api/host_library.h"

namespace api {

namespace {

constexpr unsigned kSensors = 10;  // with the turret's two

}  // namespace

/// The sensor's dark value less its lit one, each as its word is read in the call.
inline int HostLibrary::reading(const Call& call, unsigned sensor, Cycle dark_after, Cycle lit_after) {
  if (!call.cpu.watching) return variables_.dark_less_lit(sensor, call.at + dark_after, call.at + lit_after);
  const int dark = look_at(call, HostVariable::e_ambient_ir, sensor, dark_after),
            lit = look_at(call, HostVariable::e_ambient_and_reflected_ir, sensor, lit_after);
  return static_cast<std::int16_t>(dark - lit);
}

int HostLibrary::look_at(const Call& call, HostVariable which, unsigned index, Cycle after) {
  const Cycle at = call.at + after;
  if (call.cpu.watching)
    call.cpu.note_look(variables_.horizon(served_address(which) + 2 * index, at) - after);
  return static_cast<std::int16_t>(variables_.read(which, index, at));
}

HostResult HostLibrary::e_get_prox(const Call& call) {
  const unsigned sensor = call.word(0);
  if (sensor >= kSensors) {
    call.give(0);
    return HostResult::done(cycles_.prox_none);
  }
  call.give(reading(call, sensor, cycles_.prox_dark, cycles_.prox_lit));
  return HostResult::done(cycles_.prox);
}

HostResult HostLibrary::e_get_calibrated_prox(const Call& call) {
  const unsigned sensor = call.word(0);
  if (sensor >= kSensors) {
    call.give(0);
    return HostResult::done(cycles_.calibrated_none);
  }
  const int near = reading(call, sensor, cycles_.calibrated_dark, cycles_.calibrated_lit),
            free = static_cast<std::int16_t>(call.cpu.read16(served_.free_space + 2 * sensor)),
            rest = static_cast<std::int16_t>(near - free);
  call.give(rest > 0 ? rest : 0);
  return HostResult::done(rest > 0 ? cycles_.calibrated : cycles_.calibrated_zero);
}

HostResult HostLibrary::e_get_ambient_light(const Call& call) {
  const unsigned sensor = call.word(0);
  if (sensor >= kSensors) {
    call.give(0);
    return HostResult::done(cycles_.light_none);
  }
  call.give(look_at(call, HostVariable::e_ambient_ir, sensor, cycles_.light_dark));
  return HostResult::done(cycles_.light);
}

}  // namespace api
