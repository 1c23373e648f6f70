// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** Hears packets on its channel. The functions that read are about the packet at the head of the queue, the oldest one. */
public class Receiver extends Device {
  Receiver(int tag) {
    super(tag);
  }

  /** By its name. */
  public Receiver(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.receiver_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.receiver_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.receiver_get_sampling_period(tag);
  }

  public static final int CHANNEL_BROADCAST = -1;

  /** How many packets are there. */
  public int getQueueLength() {
    return Native.receiver_get_queue_length(tag);
  }

  /** Drops the packet at the head. */
  public void nextPacket() {
    Native.receiver_next_packet(tag);
  }

  /** The packet as it was sent; empty: there is none. */
  public byte[] getData() {
    byte[] read = Memory.bytes(Native.receiver_get_data(tag), getDataSize());
    return read == null ? new byte[0] : read;
  }

  /** The packet as UTF-8 text, without the 0 that programs in C send at its end. */
  public String getString() {
    byte[] data = getData();
    int size = data.length > 0 && data[data.length - 1] == 0 ? data.length - 1 : data.length;
    return new String(data, 0, size, java.nio.charset.StandardCharsets.UTF_8);
  }

  /** Bytes; 0: there is no packet. */
  public int getDataSize() {
    return Native.receiver_get_data_size(tag);
  }

  /** 1 / d2, d the distance to the sender in m. */
  public double getSignalStrength() {
    return Native.receiver_get_signal_strength(tag);
  }

  /** A unit vector towards the sender, in the robot's axes. */
  public double[] getEmitterDirection() {
    return Memory.values(Native.receiver_get_emitter_direction(tag), 3);
  }

  /** 0 and above; -1: all. */
  public int getChannel() {
    return Native.receiver_get_channel(tag);
  }

  /** 0 and above; -1: all. */
  public void setChannel(int channel) {
    Native.receiver_set_channel(tag, channel);
  }
}
