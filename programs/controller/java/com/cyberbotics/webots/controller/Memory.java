// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** Loads the library, and reads what it has in its memory; null where there is nothing. */
class Memory {
  private static final int JAVA = 3; // of a HELLO

  private static boolean isOver; // a step has returned -1

  static {
    System.loadLibrary("JavaController");
    String command = System.getProperty("sun.java.command", "").trim();
    Native.twinpuck_language(JAVA, command.isEmpty() ? "java" : command.split("\\s+")[0]);
  }

  static native double[] numbers(long address, int count);

  static native int[] ints(long address, int count);

  static native byte[] bytes(long address, int count);

  static native double[] recognised(long objects, int index);

  static native String recognisedModel(long objects, int index);

  static native double[] contacts(long node, boolean withDescendants);

  /** Numbers of a sensor: NaN where the library has none. */
  static double[] values(long address, int count) {
    double[] read = numbers(address, count);
    if (read == null) {
      read = new double[count];
      java.util.Arrays.fill(read, Double.NaN);
    }
    return read;
  }

  /** An array that is as long as the library expects it to be. */
  static double[] of(double[] values, int count, String what) {
    if (values.length < count)
      throw new IllegalArgumentException(what + ": got " + values.length + " numbers, expected " + count);
    return values;
  }

  static int step(int ms) {
    leaveIfOver();
    Native.robot_step_begin(ms);
    return stepEnd();
  }

  static int stepEnd() {
    leaveIfOver();
    while (Native.twinpuck_wait() == 0) {
      // a signal
    }
    int result = Native.robot_step_end();
    isOver = result < 0;
    return result;
  }

  /** It was told that the run is over and goes on. */
  private static void leaveIfOver() {
    if (isOver) System.exit(0);
  }
}
