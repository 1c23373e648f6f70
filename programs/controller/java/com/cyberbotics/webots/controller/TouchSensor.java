// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** A bumper. */
public class TouchSensor extends Device {
  TouchSensor(int tag) {
    super(tag);
  }

  /** By its name. */
  public TouchSensor(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.touch_sensor_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.touch_sensor_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.touch_sensor_get_sampling_period(tag);
  }

  public static final int BUMPER = 0;
  public static final int FORCE = 1;
  public static final int FORCE3D = 2;

  /** A bumper: 1 touched, 0 not; a force sensor: N. NaN before the first sample. */
  public double getValue() {
    return Native.touch_sensor_get_value(tag);
  }

  /** Of a FORCE3D: x, y, z in N. */
  public double[] getValues() {
    return Memory.values(Native.touch_sensor_get_values(tag), 3);
  }

  /** BUMPER, FORCE or FORCE3D. */
  public int getType() {
    return Native.touch_sensor_get_type(tag);
  }

  /** Rows of three numbers: true value, returned value, noise; empty: no table. */
  public double[] getLookupTable() {
    return Memory.values(Native.touch_sensor_get_lookup_table(tag), 3 * Native.touch_sensor_get_lookup_table_size(tag));
  }

  /** Rows of getLookupTable(). */
  public int getLookupTableSize() {
    return Native.touch_sensor_get_lookup_table_size(tag);
  }
}
