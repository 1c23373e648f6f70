// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

import java.util.Arrays;

/** An object on the picture. It stays as it was seen, also after the next step. */
public class CameraRecognitionObject {
  private final double[] seen;
  private final String model;

  CameraRecognitionObject(double[] seen, String model) {
    this.seen = seen;
    this.model = model;
  }

  /** The number of its node: {@link Supervisor#getFromId}. */
  public int getId() {
    return (int) seen[0];
  }

  /** x, y, z in m, seen from the camera in the camera's axes. */
  public double[] getPosition() {
    return Arrays.copyOfRange(seen, 1, 4);
  }

  /** Axis x, y, z and angle in rad, seen from the camera. */
  public double[] getOrientation() {
    return Arrays.copyOfRange(seen, 4, 8);
  }

  /** Width and height in m. */
  public double[] getSize() {
    return Arrays.copyOfRange(seen, 8, 10);
  }

  /** Column and row of its middle, pixels from the upper left corner. */
  public int[] getPositionOnImage() {
    return new int[] {(int) seen[10], (int) seen[11]};
  }

  /** Columns and rows, pixels. */
  public int[] getSizeOnImage() {
    return new int[] {(int) seen[12], (int) seen[13]};
  }

  /** How many colours its node's recognitionColors has. */
  public int getNumberOfColors() {
    return (int) seen[14];
  }

  /** Red, green, blue of each colour, 0 to 1, one after the other. */
  public double[] getColors() {
    return Arrays.copyOfRange(seen, 15, seen.length);
  }

  /** Its node's model. */
  public String getModel() {
    return model;
  }
}
