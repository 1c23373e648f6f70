// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** An infra-red sensor that looks for obstacles ("ps0" to "ps7") or at the floor ("gs0" to "gs2"). */
public class DistanceSensor extends Device {
  DistanceSensor(int tag) {
    super(tag);
  }

  /** By its name. */
  public DistanceSensor(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.distance_sensor_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.distance_sensor_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.distance_sensor_get_sampling_period(tag);
  }

  public static final int GENERIC = 0;
  public static final int INFRA_RED = 1;
  public static final int SONAR = 2;
  public static final int LASER = 3;

  /** Counts: the ring's 0 to 4095, more when near; of ground sensors 0 to 1000 or so, less on black. NaN before the first sample. */
  public double getValue() {
    return Native.distance_sensor_get_value(tag);
  }

  /** The most that it returns, in the units of getValue(). */
  public double getMaxValue() {
    return Native.distance_sensor_get_max_value(tag);
  }

  /** The least that it returns, in the units of getValue(). */
  public double getMinValue() {
    return Native.distance_sensor_get_min_value(tag);
  }

  /** How wide it looks, rad. */
  public double getAperture() {
    return Native.distance_sensor_get_aperture(tag);
  }

  /** GENERIC, INFRA_RED, SONAR or LASER. */
  public int getType() {
    return Native.distance_sensor_get_type(tag);
  }

  /** Rows of three numbers: true value, returned value, noise; empty: no table. */
  public double[] getLookupTable() {
    return Memory.values(Native.distance_sensor_get_lookup_table(tag), 3 * Native.distance_sensor_get_lookup_table_size(tag));
  }

  /** Rows of getLookupTable(). */
  public int getLookupTableSize() {
    return Native.distance_sensor_get_lookup_table_size(tag);
  }
}
