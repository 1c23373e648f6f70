// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** The true place, by [[robot.device]] of kind "gps". */
public class GPS extends Device {
  GPS(int tag) {
    super(tag);
  }

  /** By its name. */
  public GPS(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.gps_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.gps_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.gps_get_sampling_period(tag);
  }

  public static final int LOCAL = 0;
  public static final int WGS84 = 1;

  /** x, y, z in m, in the world's axes. NaN before the first sample. */
  public double[] getValues() {
    return Memory.values(Native.gps_get_values(tag), 3);
  }

  /** m/s. */
  public double getSpeed() {
    return Native.gps_get_speed(tag);
  }

  /** x, y, z in m/s, in the world's axes. */
  public double[] getSpeedVector() {
    return Memory.values(Native.gps_get_speed_vector(tag), 3);
  }

  /** LOCAL. */
  public int getCoordinateSystem() {
    return Native.gps_get_coordinate_system(tag);
  }
}
