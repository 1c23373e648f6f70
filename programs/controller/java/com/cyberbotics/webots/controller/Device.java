// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** A device of the robot. {@link Robot#getDevice} gives it. */
public class Device {
  final int tag;

  Device(int tag) {
    this.tag = tag;
  }

  /** By its name. */
  public Device(String name) {
    this(Native.robot_get_device(name));
  }

  /** Its number in C, from 1 on; 0: there is no such device. */
  public int getTag() {
    return tag;
  }

  /** Its name, as in the world file. */
  public String getName() {
    return Native.device_get_name(tag);
  }

  /** Its model; empty where the world says none. */
  public String getModel() {
    return Native.device_get_model(tag);
  }

  /** Its kind, one of the constants of {@link Node}. */
  public int getNodeType() {
    return Native.device_get_node_type(tag);
  }

  @Override
  public String toString() {
    return getClass().getSimpleName() + " " + getName();
  }
}
