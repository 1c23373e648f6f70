// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** No e-puck has one here: {@code robot.getPen()} warns and gives null. The class is there for programs that name it. */
public class Pen extends Device {
  Pen(int tag) {
    super(tag);
  }

  /** By its name. */
  public Pen(String name) {
    super(name);
  }

  /** No effect. */
  public void write(boolean write) {}

  /** No effect. */
  public void setInkColor(int color, double density) {}
}
