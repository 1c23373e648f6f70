// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** A light: "led0" ahead to "led7" clockwise in the ring, "led8" in the body, "led9" in front. */
public class LED extends Device {
  LED(int tag) {
    super(tag);
  }

  /** By its name. */
  public LED(String name) {
    super(name);
  }

  /** 0: off; anything else: on. The e-puck's have one colour. */
  public void set(int value) {
    Native.led_set(tag, value);
  }

  /** What was set. */
  public int get() {
    return Native.led_get(tag);
  }
}
