/* SPDX-License-Identifier: MIT
 * Emitters and receivers of packets.
 */
#include <string.h>

#include "programs/controller/c/library.h"

#define QUEUE_BYTES 4096 /* of a queue where nothing else is told [Webots: Receiver.bufferSize] */

/* numbers of DEVICE */
enum { EMITTER_CHANNEL, EMITTER_RANGE, EMITTER_BYTES };
enum { RECEIVER_CHANNEL, RECEIVER_BYTES };

static void say_channel(WbDeviceTag tag, int channel) {
  struct link_packet* out = command(LINK_CHANNEL);
  link_int(out, tag);
  link_int(out, channel);
  command_end();
}

/* --- emitter */

struct emitter {
  int channel, most_bytes, queued; /* bytes since the last step */
  double range_m;
  struct emitter* next;
};
static struct emitter* emitters;

static struct device* emitter_device(WbDeviceTag tag, const char* function) {
  return device_of(tag, WB_NODE_EMITTER, function);
}

static struct emitter* emitter(WbDeviceTag tag, const char* function) {
  struct device* d = emitter_device(tag, function);
  struct emitter* e = d ? d->own : 0;
  if (!d || e) return e;
  d->own = e = grow(0, sizeof *e);
  e->channel = (int)device_info(d, EMITTER_CHANNEL, 0);
  e->range_m = device_info(d, EMITTER_RANGE, -1);
  e->most_bytes = (int)device_info(d, EMITTER_BYTES, QUEUE_BYTES);
  e->queued = 0;
  e->next = emitters;
  return emitters = e;
}

void emitters_step(void) {
  struct emitter* e;
  for (e = emitters; e; e = e->next) e->queued = 0;
}

int wb_emitter_send(WbDeviceTag tag, const void* data, int size) {
  struct emitter* e = emitter(tag, "wb_emitter_send");
  struct link_packet* out;
  if (!e) return 0;
  if (!data || size < 1) {
    WARN("wb_emitter_send(): got %d bytes, expected 1 or more", data ? size : 0);
    return 0;
  }
  if (e->most_bytes > 0 && size > e->most_bytes - e->queued) return 0;
  if (size > LINK_FLUSH_BYTES) return 0;
  e->queued += size;
  out = command(LINK_SEND);
  link_int(out, tag);
  link_bytes(out, data, (size_t)size);
  command_end();
  return 1;
}

void wb_emitter_set_channel(WbDeviceTag tag, int channel) {
  struct emitter* e = emitter(tag, "wb_emitter_set_channel");
  if (!e) return;
  if (channel < -1) {
    WARN("wb_emitter_set_channel(): got %d, expected 0 or more, or -1 for all", channel);
    return;
  }
  e->channel = channel;
  say_channel(tag, channel);
}
int wb_emitter_get_channel(WbDeviceTag tag) {
  const struct emitter* e = emitter(tag, "wb_emitter_get_channel");
  return e ? e->channel : -1;
}

void wb_emitter_set_range(WbDeviceTag tag, double range) {
  struct emitter* e = emitter(tag, "wb_emitter_set_range");
  struct link_packet* out;
  if (!e) return;
  e->range_m = range;
  out = command(LINK_RANGE);
  link_int(out, tag);
  link_number(out, range);
  command_end();
}
double wb_emitter_get_range(WbDeviceTag tag) {
  const struct emitter* e = emitter(tag, "wb_emitter_get_range");
  return e ? e->range_m : -1;
}
int wb_emitter_get_buffer_size(WbDeviceTag tag) {
  const struct emitter* e = emitter(tag, "wb_emitter_get_buffer_size");
  return e ? e->most_bytes : -1;
}

/* --- receiver */

struct received {
  struct received* next;
  size_t size, room;
  double strength, direction[3];
  unsigned char bytes[]; /* and a 0 behind them: programs print them */
};

struct receiver {
  int channel, count, most_bytes;
  size_t queued; /* bytes */
  struct received *first, *last;
  struct received* spare; /* to be used again */
};

static struct receiver* receiver_of(struct device* d) {
  struct receiver* r = d->own;
  if (r) return r;
  d->own = r = grow(0, sizeof *r);
  memset(r, 0, sizeof *r);
  r->channel = (int)device_info(d, RECEIVER_CHANNEL, 0);
  r->most_bytes = (int)device_info(d, RECEIVER_BYTES, QUEUE_BYTES);
  return r;
}

static struct device* receiver_device(WbDeviceTag tag, const char* function) {
  return device_of(tag, WB_NODE_RECEIVER, function);
}
static struct receiver* receiver(WbDeviceTag tag, const char* function) {
  struct device* d = receiver_device(tag, function);
  return d ? receiver_of(d) : 0;
}

/* what does not fit is lost, as in Webots */
void take_packet(const struct link_record* record) {
  struct device* d = any_device(record->ints[0]);
  size_t size = record->texts[0].size;
  struct receiver* r;
  struct received* p;
  if (!d || d->kind != WB_NODE_RECEIVER) return;
  r = receiver_of(d);
  if (r->most_bytes > 0 && r->queued + size > (size_t)r->most_bytes) return;
  p = r->spare;
  if (p && p->room >= size) {
    r->spare = p->next;
  } else {
    size_t room = size < 256 ? 256 : size;
    p = grow(0, sizeof *p + room + 1);
    p->room = room;
  }
  p->next = 0;
  p->size = size;
  p->strength = record->reals[0];
  memcpy(p->direction, &record->reals[1], sizeof p->direction);
  memcpy(p->bytes, record->texts[0].bytes, size);
  p->bytes[size] = 0;
  if (r->last)
    r->last->next = p;
  else
    r->first = p;
  r->last = p;
  r->count++;
  r->queued += size;
}

SAMPLING(receiver, receiver_device)

int wb_receiver_get_queue_length(WbDeviceTag tag) {
  const struct device* d = receiver_device(tag, "wb_receiver_get_queue_length");
  if (!d) return 0;
  if (d->period == 0)
    WARN("wb_receiver_get_queue_length(): got \"%s\", which is not enabled, expected one with a sampling period", d->name);
  return d->own ? ((const struct receiver*)d->own)->count : 0;
}

void wb_receiver_next_packet(WbDeviceTag tag) {
  struct receiver* r = receiver(tag, "wb_receiver_next_packet");
  struct received* p = r ? r->first : 0;
  if (r && !p) WARN("wb_receiver_next_packet(): got an empty queue, expected a packet");
  if (!p) return;
  r->first = p->next;
  if (!p->next) r->last = 0;
  r->count--;
  r->queued -= p->size;
  p->next = r->spare;
  r->spare = p;
}

static const struct received* head(WbDeviceTag tag, const char* function) {
  const struct receiver* r = receiver(tag, function);
  if (r && !r->first) WARN("%s(): got an empty queue, expected a packet", function);
  return r ? r->first : 0;
}
int wb_receiver_get_data_size(WbDeviceTag tag) {
  const struct received* p = head(tag, "wb_receiver_get_data_size");
  return p ? (int)p->size : 0;
}
const void* wb_receiver_get_data(WbDeviceTag tag) {
  const struct received* p = head(tag, "wb_receiver_get_data");
  return p ? p->bytes : 0;
}
double wb_receiver_get_signal_strength(WbDeviceTag tag) {
  const struct received* p = head(tag, "wb_receiver_get_signal_strength");
  return p ? p->strength : 0;
}
const double* wb_receiver_get_emitter_direction(WbDeviceTag tag) {
  const struct received* p = head(tag, "wb_receiver_get_emitter_direction");
  return p ? p->direction : no_numbers();
}

void wb_receiver_set_channel(WbDeviceTag tag, int channel) {
  struct receiver* r = receiver(tag, "wb_receiver_set_channel");
  if (!r) return;
  if (channel < -1) {
    WARN("wb_receiver_set_channel(): got %d, expected 0 or more, or -1 for all", channel);
    return;
  }
  r->channel = channel;
  say_channel(tag, channel);
}
int wb_receiver_get_channel(WbDeviceTag tag) {
  const struct receiver* r = receiver(tag, "wb_receiver_get_channel");
  return r ? r->channel : -1;
}
