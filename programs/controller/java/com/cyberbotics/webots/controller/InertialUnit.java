// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** The true attitude, by [[robot.device]] of kind "inertial". */
public class InertialUnit extends Device {
  InertialUnit(int tag) {
    super(tag);
  }

  /** By its name. */
  public InertialUnit(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.inertial_unit_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.inertial_unit_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.inertial_unit_get_sampling_period(tag);
  }

  /** Roll, pitch, yaw in rad, -pi to pi. NaN before the first sample. */
  public double[] getRollPitchYaw() {
    return Memory.values(Native.inertial_unit_get_roll_pitch_yaw(tag), 3);
  }

  /** x, y, z, w. */
  public double[] getQuaternion() {
    return Memory.values(Native.inertial_unit_get_quaternion(tag), 4);
  }

  /** rad. */
  public double getNoise() {
    return Native.inertial_unit_get_noise(tag);
  }
}
