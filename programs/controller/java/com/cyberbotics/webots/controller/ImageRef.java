// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** A picture that a {@link Display} holds. */
public class ImageRef {
  final long address;

  private ImageRef(long address) {
    this.address = address;
  }

  static ImageRef of(long address) {
    return address == 0 ? null : new ImageRef(address);
  }
}
