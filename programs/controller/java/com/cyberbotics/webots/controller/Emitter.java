// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** Sends packets on its channel to receivers that are near enough; they have them with the next step. */
public class Emitter extends Device {
  public static final int CHANNEL_BROADCAST = -1;

  Emitter(int tag) {
    super(tag);
  }

  /** By its name. */
  public Emitter(String name) {
    super(name);
  }

  /** A packet of these bytes. 1: sent; 0: the queue is full. */
  public int send(byte[] data) {
    return Native.emitter_send(tag, data, data.length);
  }

  /** A packet of this text as UTF-8. 1: sent; 0: the queue is full. */
  public int send(String text) {
    return send(text.getBytes(java.nio.charset.StandardCharsets.UTF_8));
  }

  /** 0 and above; -1: all. */
  public int getChannel() {
    return Native.emitter_get_channel(tag);
  }

  /** 0 and above; -1: all. */
  public void setChannel(int channel) {
    Native.emitter_set_channel(tag, channel);
  }

  /** m; -1: no limit. */
  public double getRange() {
    return Native.emitter_get_range(tag);
  }

  /** m; -1: no limit. Not above what the world says. */
  public void setRange(double range) {
    Native.emitter_set_range(tag, range);
  }

  /** Bytes that can wait for the next step. */
  public int getBufferSize() {
    return Native.emitter_get_buffer_size(tag);
  }
}
