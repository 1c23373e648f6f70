// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/**
 * A robot whose wheels are driven and measured by its own functions, as versions up to R2018 have it. Speeds are units
 * of getSpeedUnit(): with 0.00628 rad/s, 1000 is a turn a second.
 */
public class DifferentialWheels extends Robot {
  /** Units of getSpeedUnit(), forward positive. */
  public void setSpeed(double left, double right) {
    Native.differential_wheels_set_speed(left, right);
  }

  /** What was set. */
  public double getLeftSpeed() {
    return Native.differential_wheels_get_left_speed();
  }

  /** What was set. */
  public double getRightSpeed() {
    return Native.differential_wheels_get_right_speed();
  }

  /** Counts steps of the wheels, every {@code samplingPeriod} ms. */
  public void enableEncoders(int samplingPeriod) {
    Native.differential_wheels_enable_encoders(samplingPeriod);
  }

  /** Counts no more. */
  public void disableEncoders() {
    Native.differential_wheels_disable_encoders();
  }

  /** ms; 0: not enabled. */
  public int getEncodersSamplingPeriod() {
    return Native.differential_wheels_get_encoders_sampling_period();
  }

  /** Steps, 1000 a turn, since the beginning or as set. */
  public double getLeftEncoder() {
    return Native.differential_wheels_get_left_encoder();
  }

  /** Steps, 1000 a turn, since the beginning or as set. */
  public double getRightEncoder() {
    return Native.differential_wheels_get_right_encoder();
  }

  /** Steps: what the encoders show from now on. */
  public void setEncoders(double left, double right) {
    Native.differential_wheels_set_encoders(left, right);
  }

  /** rad/s. */
  public double getMaxSpeed() {
    return Native.differential_wheels_get_max_speed();
  }

  /** rad/s a unit of setSpeed(). */
  public double getSpeedUnit() {
    return Native.differential_wheels_get_speed_unit();
  }
}
