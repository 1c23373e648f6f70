// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** The loudspeaker; it plays the five sounds that the robot holds. */
public class Speaker extends Device {
  Speaker(int tag) {
    super(tag);
  }

  /** By its name. */
  public Speaker(String name) {
    super(name);
  }

  /**
   * {@code sound} is a file or one of the robot's sounds; volume 0 to 1; pitch 1 as recorded; balance -1 left to 1;
   * loop: again and again. The e-puck has one speaker: left and right are the same.
   */
  public static void playSound(
      Speaker left, Speaker right, String sound, double volume, double pitch, double balance, boolean loop) {
    Native.speaker_play_sound(left.tag, right.tag, sound, volume, pitch, balance, loop);
  }

  /** Ends a sound; null: all of them. */
  public void stop(String sound) {
    Native.speaker_stop(tag, sound);
  }

  /** Whether this sound is to be heard; null: any. */
  public boolean isSoundPlaying(String sound) {
    return Native.speaker_is_sound_playing(tag, sound);
  }

  /** Of speak(). The robot has none: false. */
  public boolean setEngine(String engine) {
    return Native.speaker_set_engine(tag, engine);
  }

  /** Of speak(). The robot has none: false. */
  public boolean setLanguage(String language) {
    return Native.speaker_set_language(tag, language);
  }

  /** Of speak(). */
  public String getEngine() {
    return Native.speaker_get_engine(tag);
  }

  /** Of speak(). */
  public String getLanguage() {
    return Native.speaker_get_language(tag);
  }

  /** The robot cannot speak: no effect, a warning. */
  public void speak(String text, double volume) {
    Native.speaker_speak(tag, text, volume);
  }

  /** false. */
  public boolean isSpeaking() {
    return Native.speaker_is_speaking(tag);
  }
}
