// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** Keys that are down: those of {@code twinpuck run --key ROBOT=keyboard:UP@TIME}. Letters are capitals. */
public class Keyboard {
  public static final int END = 312;
  public static final int HOME = 313;
  public static final int LEFT = 314;
  public static final int UP = 315;
  public static final int RIGHT = 316;
  public static final int DOWN = 317;
  public static final int PAGEUP = 366;
  public static final int PAGEDOWN = 367;
  public static final int NUMPAD_HOME = 375;
  public static final int NUMPAD_LEFT = 376;
  public static final int NUMPAD_UP = 377;
  public static final int NUMPAD_RIGHT = 378;
  public static final int NUMPAD_DOWN = 379;
  public static final int NUMPAD_END = 382;
  public static final int KEY = 0x0000ffff;
  public static final int SHIFT = 0x00010000;
  public static final int CONTROL = 0x00020000;
  public static final int ALT = 0x00040000;

  /** Looks every {@code samplingPeriod} ms, at ends of steps. */
  public void enable(int samplingPeriod) {
    Native.keyboard_enable(samplingPeriod);
  }

  /** Looks no more. */
  public void disable() {
    Native.keyboard_disable();
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.keyboard_get_sampling_period();
  }

  /** The next key that is down; -1: no more of them in this step. */
  public int getKey() {
    return (int) Native.keyboard_get_key();
  }
}
