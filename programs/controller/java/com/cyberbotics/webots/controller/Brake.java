// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** No e-puck has one here: {@code robot.getBrake()} warns and gives null. The class is there for programs that name it. */
public class Brake extends Device {
  Brake(int tag) {
    super(tag);
  }

  /** By its name. */
  public Brake(String name) {
    super(name);
  }
}
