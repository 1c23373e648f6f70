// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/**
 * A stepper motor with its wheel: "left wheel motor", "right wheel motor". To drive:
 * {@code setPosition(Double.POSITIVE_INFINITY)}, then {@code setVelocity(radPerS)}.
 */
public class Motor extends Device {
  public static final int ROTATIONAL = 0;
  public static final int LINEAR = 1;

  Motor(int tag) {
    super(tag);
  }

  /** By its name. */
  public Motor(String name) {
    super(name);
  }

  /** Turns to {@code position}, rad, at most as fast as setVelocity() says; infinite: for ever. */
  public void setPosition(double position) {
    Native.motor_set_position(tag, position);
  }

  /** rad/s, the e-puck's -6.28 to 6.28; more is limited with a warning. */
  public void setVelocity(double velocity) {
    Native.motor_set_velocity(tag, velocity);
  }

  /** rad/s2. Steppers start at once: no effect. */
  public void setAcceleration(double acceleration) {
    Native.motor_set_acceleration(tag, acceleration);
  }

  /** N. No effect on a stepper. */
  public void setAvailableForce(double force) {
    Native.motor_set_available_force(tag, force);
  }

  /** Nm. No effect on a stepper. */
  public void setAvailableTorque(double torque) {
    Native.motor_set_available_torque(tag, torque);
  }

  /** A stepper has no such control: no effect. */
  public void setControlPID(double p, double i, double d) {
    Native.motor_set_control_pid(tag, p, i, d);
  }

  /** N. A stepper is not driven by a force: no effect, a warning. */
  public void setForce(double force) {
    Native.motor_set_force(tag, force);
  }

  /** Nm. A stepper is not driven by a torque: no effect, a warning. */
  public void setTorque(double torque) {
    Native.motor_set_torque(tag, torque);
  }

  /** rad: what was set. */
  public double getTargetPosition() {
    return Native.motor_get_target_position(tag);
  }

  /** rad/s: what was set, not what the wheel does. */
  public double getVelocity() {
    return Native.motor_get_velocity(tag);
  }

  /** rad/s2; -1: no limit. */
  public double getAcceleration() {
    return Native.motor_get_acceleration(tag);
  }

  /** rad; 0 with getMaxPosition() 0: no limits. */
  public double getMinPosition() {
    return Native.motor_get_min_position(tag);
  }

  /** rad; 0 with getMinPosition() 0: no limits. */
  public double getMaxPosition() {
    return Native.motor_get_max_position(tag);
  }

  /** rad/s: the most that setVelocity() takes. */
  public double getMaxVelocity() {
    return Native.motor_get_max_velocity(tag);
  }

  /** N. */
  public double getAvailableForce() {
    return Native.motor_get_available_force(tag);
  }

  /** N. */
  public double getMaxForce() {
    return Native.motor_get_max_force(tag);
  }

  /** Nm. */
  public double getAvailableTorque() {
    return Native.motor_get_available_torque(tag);
  }

  /** Nm. */
  public double getMaxTorque() {
    return Native.motor_get_max_torque(tag);
  }

  /** 1: no coupled motors. */
  public double getMultiplier() {
    return Native.motor_get_multiplier(tag);
  }

  /** ROTATIONAL or LINEAR. */
  public int getType() {
    return Native.motor_get_type(tag);
  }

  /** The sensor of the same wheel. */
  public PositionSensor getPositionSensor() {
    return (PositionSensor) Robot.deviceOf(Native.motor_get_position_sensor(tag));
  }

  /** The e-puck has no brakes: null. */
  public Brake getBrake() {
    return null;
  }
}
