// SPDX-License-Identifier: MIT
#include "hal_sim/board/specimen.h"

#include <cmath>

#include "sim_core/light/proximity.h"
#include "sim_core/sound/sound_field.h"

namespace board {

static std::int64_t to_ppb(double ppm) { return static_cast<std::int64_t>(std::llround(ppm * 1000.0)); }

Specimen::Specimen(const Setup& setup)
    : clock_(to_ppb(setup.clock_ppm), sim::from_seconds(setup.boot_delay_s)),
      noise_(setup.seed, setup.robot),
      setup_(setup) {}

void Specimen::look_at(const sim::Scene* scene) {
  scene_ = scene;
  is_lit_ = scene && sim::has_light(*scene);
  is_sounding_ = scene && sim::has_sound(*scene);
}

Damage& Specimen::be_damaged() {
  if (!damage_) damage_ = std::make_unique<Damage>(setup_.seed, setup_.robot);
  return *damage_;
}

void Specimen::set_clock_ppm(double ppm, sim::Clicks at) { clock_.set_ppb(to_ppb(ppm), at); }

void Specimen::begin_specimen_again(sim::Clicks now, Cycle at) {
  clock_.begin_again(now);
  noise_.begin_at(at);
  damage_.reset();
}

}  // namespace board
