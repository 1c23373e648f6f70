/* SPDX-License-Identifier: MIT
 * Emitter and receiver on the robot: the radio turret of SWIS (contrib/SWIS_com_module). A channel is a group of the
 * turret, -1 reaches every group; a robot has one group for both directions, that of its receiver. Each byte takes
 * 0.5 ms of the bus. The turret keeps one packet: a step takes it over, and a queue of two waits for the program.
 * Not there: range, signal strength and direction, of which the turret knows nothing.
 */
#include <string.h>

#include "contrib/SWIS_com_module/ComModule.h"
#include "I2C/e_I2C_protocol.h"
#include "core.h"
#include "device/emitter.h"
#include "device/receiver.h"
#include "webots/emitter.h"
#include "webots/receiver.h"

#define USUAL_CHANNEL 1 /* as in the simulator */
#define EVERY_GROUP 0xFF
#define EVERYBODY 0xFF
#define FULL_POWER 1 /* of the software attenuator */
#define QUEUE 2

struct packet {
  int size;
  unsigned char data[COM_MODULE_MAXSIZE];
};

static struct packet queue[QUEUE]; /* the oldest first */
static int queued;
static int sends_on = USUAL_CHANNEL, listens_on = USUAL_CHANNEL;
static unsigned char asked, is_plugged;

static unsigned char group_of(int channel) { return channel < 0 ? EVERY_GROUP : (unsigned char)channel; }

/* the turret is asked for once; a robot without one sends and hears nothing */
static int turret(const char* function) {
  if (asked) return is_plugged;
  asked = 1;
  e_i2cp_init();
  e_i2cp_enable();
  is_plugged = IsModulePlugged() != 0;
  if (is_plugged)
    InitComModule(group_of(listens_on), 0, COM_MODULE_HW_ATTENUATOR_0DB, FULL_POWER);
  else
    webots_warn(function, "this robot carries no radio turret, nothing is sent or heard");
  return is_plugged;
}

static struct webots_device* emitter(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_EMITTER, function);
}
static struct webots_device* receiver(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_RECEIVER, function);
}

/* --- emitter */

int wb_emitter_send(WbDeviceTag tag, const void* data, int size) {
  if (!emitter(tag, "wb_emitter_send") || size <= 0 || !turret("wb_emitter_send")) return 0;
  if (size > COM_MODULE_MAXSIZE) {
    webots_warn("wb_emitter_send", "got more bytes than the radio turret sends at once, expected at most 108");
    return 0;
  }
  e_i2cp_enable();
  return SendPacket(group_of(sends_on), EVERYBODY, (unsigned char*)data, size);
}
void wb_emitter_set_channel(WbDeviceTag tag, int channel) {
  if (emitter(tag, "wb_emitter_set_channel")) sends_on = channel;
}
int wb_emitter_get_channel(WbDeviceTag tag) { return emitter(tag, "wb_emitter_get_channel") ? sends_on : 0; }
int wb_emitter_get_buffer_size(WbDeviceTag tag) {
  return emitter(tag, "wb_emitter_get_buffer_size") ? COM_MODULE_MAXSIZE : 0;
}

int emitter_send_packet(DeviceTag tag, const void* data, int size) { return wb_emitter_send(tag, data, size); }
void emitter_set_channel(DeviceTag tag, int channel) { wb_emitter_set_channel(tag, channel); }
int emitter_get_channel(DeviceTag tag) { return wb_emitter_get_channel(tag); }

/* --- receiver */

/* what comes while the queue is full stays in the turret, which loses what comes after it */
static void take_over(struct webots_device* device) {
  struct packet* to = &queue[queued];
  (void)device;
  if (!is_plugged || queued == QUEUE) return;
  e_i2cp_enable();
  if (IsPacketReady(to->data, &to->size)) queued++;
}

void wb_receiver_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = receiver(tag, "wb_receiver_enable");
  if (!d) return;
  (void)turret("wb_receiver_enable");
  webots_enable(d, sampling_period, take_over);
}
void wb_receiver_disable(WbDeviceTag tag) { wb_receiver_enable(tag, 0); }
int wb_receiver_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = receiver(tag, "wb_receiver_get_sampling_period");
  return d ? d->period : 0;
}
int wb_receiver_get_queue_length(WbDeviceTag tag) {
  return receiver(tag, "wb_receiver_get_queue_length") ? queued : 0;
}
void wb_receiver_next_packet(WbDeviceTag tag) {
  if (!receiver(tag, "wb_receiver_next_packet") || queued == 0) return;
  queued--;
  memmove(&queue[0], &queue[1], sizeof queue[0] * (QUEUE - 1));
}
int wb_receiver_get_data_size(WbDeviceTag tag) {
  return receiver(tag, "wb_receiver_get_data_size") && queued > 0 ? queue[0].size : 0;
}
const void* wb_receiver_get_data(WbDeviceTag tag) {
  return receiver(tag, "wb_receiver_get_data") && queued > 0 ? queue[0].data : 0;
}
void wb_receiver_set_channel(WbDeviceTag tag, int channel) {
  if (!receiver(tag, "wb_receiver_set_channel")) return;
  listens_on = channel;
  if (!is_plugged) return;
  e_i2cp_enable();
  SetOwnGroup(group_of(channel));
}
int wb_receiver_get_channel(WbDeviceTag tag) { return receiver(tag, "wb_receiver_get_channel") ? listens_on : 0; }

void receiver_enable(DeviceTag tag, int ms) { wb_receiver_enable(tag, ms); }
void receiver_disable(DeviceTag tag) { wb_receiver_disable(tag); }
int receiver_get_queue_length(DeviceTag tag) { return wb_receiver_get_queue_length(tag); }
void receiver_next_packet(DeviceTag tag) { wb_receiver_next_packet(tag); }
int receiver_get_data_size(DeviceTag tag) { return wb_receiver_get_data_size(tag); }
const void* receiver_get_data(DeviceTag tag) { return wb_receiver_get_data(tag); }
void receiver_set_channel(DeviceTag tag, int channel) { wb_receiver_set_channel(tag, channel); }
int receiver_get_channel(DeviceTag tag) { return wb_receiver_get_channel(tag); }
