// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** One of the e-puck's three: "mic0" right, "mic1" left, "mic2" behind. */
public class Microphone extends Device {
  Microphone(int tag) {
    super(tag);
  }

  /** By its name. */
  public Microphone(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.microphone_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.microphone_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.microphone_get_sampling_period(tag);
  }

  /** Signed numbers of 2 bytes, 16384 a second, the oldest first; empty before the first sample. */
  public byte[] getSampleData() {
    byte[] read = Memory.bytes(Native.microphone_get_sample_data(tag), getSampleSize());
    return read == null ? new byte[0] : read;
  }

  /** Bytes that getSampleData() gives. */
  public int getSampleSize() {
    return Native.microphone_get_sample_size(tag);
  }
}
