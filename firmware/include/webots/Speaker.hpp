// SPDX-License-Identifier: MIT
// The loudspeaker; see webots/speaker.h.
#ifndef WB_SPEAKER_HPP
#define WB_SPEAKER_HPP

#include "Device.hpp"
#include "speaker.h"

namespace webots {

class Speaker : public Device {
 public:
  explicit Speaker(WbDeviceTag tag) : Device(tag) {}
  static void playSound(Speaker* left, Speaker* right, const std::string& sound, double volume, double pitch,
                        double balance, bool loop) {
    wb_speaker_play_sound(left ? left->tag() : 0, right ? right->tag() : 0, sound.c_str(), volume, pitch,
                          balance, loop);
  }
  void stop(const std::string& sound) { wb_speaker_stop(tag(), sound.c_str()); }
  bool isSoundPlaying(const std::string& sound) const {
    return wb_speaker_is_sound_playing(tag(), sound.c_str());
  }
};

}  // namespace webots

#endif
