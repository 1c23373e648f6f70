// SPDX-License-Identifier: MIT
// What a robot hears and says, as numbers for people: loudness, direction, the loudspeaker's level.
#pragma once
#include "hal_sim/board/sound_params.h"
#include "hal_sim/host/mind.h"
#include "sim_core/world/scene.h"

namespace signals {

/// What arrives at a robot's microphones, without their noise.
struct Heard {
  double counts[board::kMicrophones] = {};  ///< root mean square
  double bearing_rad = 0;                   ///< of where it comes from, robot frame
};

Heard listen(const sim::Scene& scene, int robot);
/// What the loudspeaker gets, root mean square, in per cent of full scale.
double speaker_level(const host::FirmwareMind& mind);

}  // namespace signals
