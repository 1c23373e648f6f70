// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** No e-puck has one here: {@code robot.getLidar()} warns and gives null. The class is there for programs that name it. */
public class Lidar extends Device {
  Lidar(int tag) {
    super(tag);
  }

  /** By its name. */
  public Lidar(String name) {
    super(name);
  }

  /** No effect. */
  public void enable(int samplingPeriod) {}

  /** No effect. */
  public void disable() {}

  /** 0. */
  public int getSamplingPeriod() {
    return 0;
  }

  /** Empty. */
  public float[] getRangeImage() {
    return new float[0];
  }

  /** 0. */
  public int getHorizontalResolution() {
    return 0;
  }

  /** 0. */
  public double getFov() {
    return 0;
  }

  /** 0. */
  public double getMaxRange() {
    return 0;
  }

  /** 0. */
  public double getMinRange() {
    return 0;
  }
}
