// SPDX-License-Identifier: MIT
// See webots/speaker.h.
#ifndef WB_SPEAKER_HPP
#define WB_SPEAKER_HPP

#include <webots/speaker.h>
#include "Device.hpp"

namespace webots {

class Speaker : public Device {
 public:
  explicit Speaker(WbDeviceTag tag) : Device(tag) {}
  explicit Speaker(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_SPEAKER; }
  static void playSound(Speaker* left, Speaker* right, const std::string& sound, double volume, double pitch,
                        double balance, bool loop) {
    wb_speaker_play_sound(left ? left->tag() : 0, right ? right->tag() : 0, sound.c_str(), volume, pitch,
                          balance, loop);
  }
  void stop(const std::string& sound) { wb_speaker_stop(tag(), sound.c_str()); }
  bool isSoundPlaying(const std::string& sound) const {
    return wb_speaker_is_sound_playing(tag(), sound.c_str());
  }
  bool setEngine(const std::string& engine) { return wb_speaker_set_engine(tag(), engine.c_str()); }
  bool setLanguage(const std::string& language) { return wb_speaker_set_language(tag(), language.c_str()); }
  std::string getEngine() const { return wb_speaker_get_engine(tag()); }
  std::string getLanguage() const { return wb_speaker_get_language(tag()); }
  void speak(const std::string& text, double volume) { wb_speaker_speak(tag(), text.c_str(), volume); }
  bool isSpeaking() const { return wb_speaker_is_speaking(tag()); }
};

}  // namespace webots

#endif
