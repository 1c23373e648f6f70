// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** The gyroscope. */
public class Gyro extends Device {
  Gyro(int tag) {
    super(tag);
  }

  /** By its name. */
  public Gyro(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.gyro_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.gyro_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.gyro_get_sampling_period(tag);
  }

  /** rad/s about the robot's axes. NaN before the first sample. */
  public double[] getValues() {
    return Memory.values(Native.gyro_get_values(tag), 3);
  }

  /** Rows of three numbers: true value, returned value, noise; empty: no table. */
  public double[] getLookupTable() {
    return Memory.values(Native.gyro_get_lookup_table(tag), 3 * Native.gyro_get_lookup_table_size(tag));
  }

  /** Rows of getLookupTable(). */
  public int getLookupTableSize() {
    return Native.gyro_get_lookup_table_size(tag);
  }
}
