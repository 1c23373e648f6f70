// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** The accelerometer. */
public class Accelerometer extends Device {
  Accelerometer(int tag) {
    super(tag);
  }

  /** By its name. */
  public Accelerometer(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.accelerometer_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.accelerometer_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.accelerometer_get_sampling_period(tag);
  }

  /** x, y, z in m/s2, in the robot's axes, with the weight: 9.81 upwards when it stands. NaN before the first sample. */
  public double[] getValues() {
    return Memory.values(Native.accelerometer_get_values(tag), 3);
  }

  /** Rows of three numbers: true value, returned value, noise; empty: no table. */
  public double[] getLookupTable() {
    return Memory.values(Native.accelerometer_get_lookup_table(tag), 3 * Native.accelerometer_get_lookup_table_size(tag));
  }

  /** Rows of getLookupTable(). */
  public int getLookupTableSize() {
    return Native.accelerometer_get_lookup_table_size(tag);
  }
}
