// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** The steps of a wheel: "left wheel sensor" and "right wheel sensor". */
public class PositionSensor extends Device {
  PositionSensor(int tag) {
    super(tag);
  }

  /** By its name. */
  public PositionSensor(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.position_sensor_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.position_sensor_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.position_sensor_get_sampling_period(tag);
  }

  public static final int ROTATIONAL = 0;
  public static final int LINEAR = 1;

  /** rad, forward positive, since the beginning; the e-puck makes 1000 steps a turn. NaN before the first sample. */
  public double getValue() {
    return Native.position_sensor_get_value(tag);
  }

  /** ROTATIONAL or LINEAR. */
  public int getType() {
    return Native.position_sensor_get_type(tag);
  }

  /** The motor that turns it. */
  public Motor getMotor() {
    return (Motor) Robot.deviceOf(Native.position_sensor_get_motor(tag));
  }

  /** The e-puck has no brakes: null. */
  public Brake getBrake() {
    return null;
  }
}
