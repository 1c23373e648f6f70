// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** Where a node touches something. */
public class ContactPoint {
  private final double[] point;
  private final int nodeId;

  ContactPoint(double x, double y, double z, int nodeId) {
    point = new double[] {x, y, z};
    this.nodeId = nodeId;
  }

  /** x, y, z in m, in the world's axes. */
  public double[] getPoint() {
    return point.clone();
  }

  /** The number of the node that touches: the node asked about, or one in it. */
  public int getNodeId() {
    return nodeId;
  }
}
