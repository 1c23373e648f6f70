// SPDX-License-Identifier: MIT
// Stands in for sim_core's air: a test says what is heard where and when, and sees what
// a loudspeaker publishes.
#include "sim_core/sound/sound_field.h"
#include "tests/board/flat_scene.h"

namespace sim {

double sense_sound_pa(const Scene& scene, int, const Vec3& point_m, Clicks at) {
  return scene.sound_pa ? scene.sound_pa(point_m, at) : 0;
}

bool has_sound(const Scene& scene) { return scene.sound_pa != nullptr; }

SoundField::SoundField(const WorldDesc&, Clicks tick) : tick_(tick), tick_s_(to_seconds(tick)) {}
void SoundField::play(int, const SpeakerTrack& track, Clicks now) {
  flat_sound().push_back({true, now, track});
}
void SoundField::stop(int, Clicks now) { flat_sound().push_back({false, now, {}}); }

std::vector<Published>& flat_sound() {
  static std::vector<Published> all;
  return all;
}

}  // namespace sim
