// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** How bright it is around the robot: "ls0" to "ls7". */
public class LightSensor extends Device {
  LightSensor(int tag) {
    super(tag);
  }

  /** By its name. */
  public LightSensor(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.light_sensor_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.light_sensor_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.light_sensor_get_sampling_period(tag);
  }

  /** Counts, 0 to 4095: nearly 4095 in the dark, less in the light. NaN before the first sample. */
  public double getValue() {
    return Native.light_sensor_get_value(tag);
  }

  /** Rows of three numbers: true value, returned value, noise; empty: no table. */
  public double[] getLookupTable() {
    return Memory.values(Native.light_sensor_get_lookup_table(tag), 3 * Native.light_sensor_get_lookup_table_size(tag));
  }

  /** Rows of getLookupTable(). */
  public int getLookupTableSize() {
    return Native.light_sensor_get_lookup_table_size(tag);
  }
}
