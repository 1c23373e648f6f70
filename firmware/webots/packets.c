/* SPDX-License-Identifier: MIT
 * Emitters and receivers, by either interface: the simulator's packets. Empty on the robot, where turret_packets.c has
 * what the radio turret can do.
 */
#ifdef __TWINPUCK_PC__
#include <math.h>

#include "core.h"
#include "device/emitter.h"
#include "device/receiver.h"
#include "webots/emitter.h"
#include "webots/receiver.h"

#define QUEUE_BYTES 4096

static struct webots_device* emitter(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_EMITTER, function);
}
static struct webots_device* receiver(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_RECEIVER, function);
}

/* --- emitter ------------------------------------------------------------------------------------------ */

static int send(struct webots_device* d, const void* data, int size) {
  return d && size > 0 ? twin_emitter_send(d->index, data, size) : 0;
}

int wb_emitter_send(WbDeviceTag tag, const void* data, int size) {
  return send(emitter(tag, "wb_emitter_send"), data, size);
}
void wb_emitter_set_channel(WbDeviceTag tag, int channel) {
  struct webots_device* d = emitter(tag, "wb_emitter_set_channel");
  if (d) twin_emitter_set_channel(d->index, channel);
}
int wb_emitter_get_channel(WbDeviceTag tag) {
  struct webots_device* d = emitter(tag, "wb_emitter_get_channel");
  return d ? twin_emitter_channel(d->index) : 0;
}
void wb_emitter_set_range(WbDeviceTag tag, double range) {
  struct webots_device* d = emitter(tag, "wb_emitter_set_range");
  if (d) twin_emitter_set_range(d->index, range);
}
double wb_emitter_get_range(WbDeviceTag tag) {
  struct webots_device* d = emitter(tag, "wb_emitter_get_range");
  return d ? twin_emitter_range(d->index) : 0;
}
int wb_emitter_get_buffer_size(WbDeviceTag tag) { return emitter(tag, "wb_emitter_get_buffer_size") ? QUEUE_BYTES : 0; }

int emitter_send_packet(DeviceTag tag, const void* data, int size) {
  return send(emitter(tag, "emitter_send_packet"), data, size);
}
void emitter_set_channel(DeviceTag tag, int channel) { wb_emitter_set_channel(tag, channel); }
int emitter_get_channel(DeviceTag tag) { return wb_emitter_get_channel(tag); }
void emitter_set_range(DeviceTag tag, float range) { wb_emitter_set_range(tag, range); }
float emitter_get_range(DeviceTag tag) { return wb_emitter_get_range(tag); }

/* --- receiver ----------------------------------------------------------------------------------------- */

static void sample_receiver(struct webots_device* device) { twin_receiver_latch(device->index); }

static void enable_receiver(struct webots_device* d, int period) {
  if (!d) return;
  twin_receiver_switch(d->index, period > 0);
  webots_enable(d, period, sample_receiver);
}

static float direction[3];

void wb_receiver_enable(WbDeviceTag tag, int sampling_period) {
  enable_receiver(receiver(tag, "wb_receiver_enable"), sampling_period);
}
void wb_receiver_disable(WbDeviceTag tag) { enable_receiver(receiver(tag, "wb_receiver_disable"), 0); }
int wb_receiver_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = receiver(tag, "wb_receiver_get_sampling_period");
  return d ? d->period : 0;
}
int wb_receiver_get_queue_length(WbDeviceTag tag) {
  const struct webots_device* d = receiver(tag, "wb_receiver_get_queue_length");
  return d ? twin_receiver_visible(d->index) : 0;
}
void wb_receiver_next_packet(WbDeviceTag tag) {
  const struct webots_device* d = receiver(tag, "wb_receiver_next_packet");
  if (d) twin_receiver_drop(d->index);
}
int wb_receiver_get_data_size(WbDeviceTag tag) {
  const struct webots_device* d = receiver(tag, "wb_receiver_get_data_size");
  return d ? twin_receiver_size(d->index) : 0;
}
const void* wb_receiver_get_data(WbDeviceTag tag) {
  const struct webots_device* d = receiver(tag, "wb_receiver_get_data");
  return d ? twin_receiver_data(d->index) : 0;
}
double wb_receiver_get_signal_strength(WbDeviceTag tag) {
  const struct webots_device* d = receiver(tag, "wb_receiver_get_signal_strength");
  return d ? twin_receiver_origin(d->index, direction) : 0;
}
const double* wb_receiver_get_emitter_direction(WbDeviceTag tag) {
  (void)wb_receiver_get_signal_strength(tag);
  return (const double*)direction;
}
void wb_receiver_set_channel(WbDeviceTag tag, int channel) {
  const struct webots_device* d = receiver(tag, "wb_receiver_set_channel");
  if (d) twin_receiver_set_channel(d->index, channel);
}
int wb_receiver_get_channel(WbDeviceTag tag) {
  const struct webots_device* d = receiver(tag, "wb_receiver_get_channel");
  return d ? twin_receiver_channel(d->index) : 0;
}

void receiver_enable(DeviceTag tag, int ms) { wb_receiver_enable(tag, ms); }
void receiver_disable(DeviceTag tag) { wb_receiver_disable(tag); }
int receiver_get_queue_length(DeviceTag tag) { return wb_receiver_get_queue_length(tag); }
void receiver_next_packet(DeviceTag tag) { wb_receiver_next_packet(tag); }
int receiver_get_data_size(DeviceTag tag) { return wb_receiver_get_data_size(tag); }
const void* receiver_get_data(DeviceTag tag) { return wb_receiver_get_data(tag); }
float receiver_get_signal_strength(DeviceTag tag) { return wb_receiver_get_signal_strength(tag); }
const float* receiver_get_emitter_direction(DeviceTag tag) {
  return (const float*)wb_receiver_get_emitter_direction(tag);
}
void receiver_set_channel(DeviceTag tag, int channel) { wb_receiver_set_channel(tag, channel); }
int receiver_get_channel(DeviceTag tag) { return wb_receiver_get_channel(tag); }
#endif
