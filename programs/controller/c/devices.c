/* SPDX-License-Identifier: MIT
 * The robot's devices: who they are, and the numbers that they sample.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/library.h"

#define MOST_TAGS 65536 /* WbDeviceTag has 16 bits */

struct device** device_by_tag;
int device_tags;
static struct device** listed; /* in the order in which they were told; hidden ones are not among them */
static int listed_count, listed_room;

/* --- who they are */

static void forget_values(struct device* device) {
  int i;
  device->fresh = false;
  for (i = 0; i < DEVICE_VALUES; i++) device->values[i] = NAN;
  memset(device->floats, 0, sizeof device->floats);
}

struct device* device_add(const struct link_record* record) {
  int64_t tag = record->ints[0];
  struct device* device;
  size_t bytes = record->lists[0].count * sizeof(double);
  if (tag <= 0 || tag >= MOST_TAGS) {
    WARN("the simulator: got a device of tag %lld, expected 1 to %d", (long long)tag, MOST_TAGS - 1);
    return 0;
  }
  if (tag >= device_tags) {
    int tags = (int)tag + 64;
    device_by_tag = grow(device_by_tag, (size_t)tags * sizeof *device_by_tag);
    memset(device_by_tag + device_tags, 0, (size_t)(tags - device_tags) * sizeof *device_by_tag);
    device_tags = tags;
  }
  if (device_by_tag[tag]) return device_by_tag[tag];

  device = grow(0, sizeof *device);
  memset(device, 0, sizeof *device);
  device->tag = (WbDeviceTag)tag;
  device->kind = (WbNodeType)record->ints[1];
  device->name = copy_text(record->texts[0].bytes, record->texts[0].size);
  device->model = copy_text(record->texts[1].bytes, record->texts[1].size);
  device->info_count = (int)record->lists[0].count;
  device->info = grow(0, bytes);
  if (bytes) memcpy(device->info, record->lists[0].values, bytes);
  forget_values(device);
  device_by_tag[tag] = device;

  if (device->kind == WB_NODE_NO_NODE) return device;
  if (listed_count == listed_room) {
    listed_room += 64;
    listed = grow(listed, (size_t)listed_room * sizeof *listed);
  }
  return listed[listed_count++] = device;
}

struct device* hidden_device(const char* name) {
  int tag;
  session_ready();
  for (tag = 1; tag < device_tags; tag++)
    if (device_by_tag[tag] && device_by_tag[tag]->kind == WB_NODE_NO_NODE && strcmp(device_by_tag[tag]->name, name) == 0)
      return device_by_tag[tag];
  return 0;
}

struct device* first_device(WbNodeType kind, const char* name) {
  int i;
  session_ready();
  for (i = 0; i < listed_count; i++)
    if (listed[i]->kind == kind && (!name || strcmp(listed[i]->name, name) == 0)) return listed[i];
  return 0;
}

WbDeviceTag find_device(const char* name, const char* function) {
  struct link_record answer;
  int i, number;
  session_ready();
  if (!name) {
    WARN("%s(): got NULL, expected a device's name", function);
    return 0;
  }
  for (i = 0; i < listed_count; i++)
    if (strcmp(listed[i]->name, name) == 0) return listed[i]->tag;
  /* one that a supervisor has defined since, or an older name */
  link_text(command(LINK_FIND_DEVICE), name);
  number = ask(&answer);
  if (number == LINK_DEVICE) {
    const struct device* added = device_add(&answer);
    if (added) return added->tag;
  }
  if (number == LINK_NOTHING && answer.texts[0].size)
    WARN("%s(\"%s\"): %.*s", function, name, (int)answer.texts[0].size, answer.texts[0].bytes);
  else
    WARN("%s(): got device \"%s\", expected one that this robot has", function, name);
  return 0;
}

struct device* wrong_tag(WbDeviceTag tag, WbNodeType kind, const char* function) {
  const struct device* device = any_device(tag);
  (void)kind;
  session_ready();
  if (device)
    WARN("%s(): got the tag of \"%s\", expected a device of this function's kind", function, device->name);
  else
    WARN("%s(): got tag %d, expected one of wb_robot_get_device()", function, (int)tag);
  return 0;
}

WbDeviceTag wb_robot_get_device(const char* name) { return find_device(name, "wb_robot_get_device"); }

int wb_robot_get_number_of_devices(void) {
  session_ready();
  return listed_count;
}

WbDeviceTag wb_robot_get_device_by_index(int index) {
  session_ready();
  if (index >= 0 && index < listed_count) return listed[index]->tag;
  WARN("wb_robot_get_device_by_index(): got %d, expected 0 to %d", index, listed_count - 1);
  return 0;
}

const char* wb_device_get_name(WbDeviceTag tag) { return any_device(tag) ? any_device(tag)->name : ""; }
const char* wb_device_get_model(WbDeviceTag tag) { return any_device(tag) ? any_device(tag)->model : ""; }
WbNodeType wb_device_get_node_type(WbDeviceTag tag) { return any_device(tag) ? any_device(tag)->kind : WB_NODE_NO_NODE; }
WbNodeType wb_device_get_type(WbDeviceTag tag) { return wb_device_get_node_type(tag); }

/* --- what they sample */

void device_enable(struct device* device, int period) {
  struct link_packet* out;
  if (!device) return;
  if (period < 0) period = 0;
  device->period = period;
  out = command(LINK_ENABLE);
  link_int(out, device->tag);
  link_int(out, period);
  command_end();
}

/* programs that forgot to enable are told, as in Webots */
static void tell_disabled(const struct device* device, const char* function) {
  WARN("%s(): got \"%s\", which is not enabled, expected one with a sampling period", function, device->name);
}

double device_value(const struct device* device, const char* function) {
  if (!device) return NAN;
  if (device->period == 0) tell_disabled(device, function);
  return device->values[0];
}

const double* no_numbers(void) {
  static double numbers[16];
  int i;
  for (i = 0; i < 16; i++) numbers[i] = NAN;
  return numbers;
}

const double* device_values(const struct device* device, const char* function) {
  if (!device) return no_numbers();
  if (device->period == 0) tell_disabled(device, function);
  return device->values;
}

const float* device_floats(struct device* device) {
  static const float kZeros[DEVICE_VALUES];
  return device ? device->floats : kZeros;
}

static void take_numbers(const struct link_record* record) {
  struct device* device = any_device(record->ints[0]);
  size_t i, count = record->lists[0].count;
  if (!device || take_ranges(device, record->lists[0].values, count)) return;
  if (count > DEVICE_VALUES) count = DEVICE_VALUES;
  for (i = 0; i < count; i++) {
    double value = record->lists[0].values[i];
    device->values[i] = value;
    device->floats[i] = isnan(value) ? 0 : (float)value;
  }
  device->count = (int)count;
  device->fresh = true;
}

void take_sample(const struct link_record* record) {
  switch (record->number) {
    case LINK_NUMBERS:
      take_numbers(record);
      return;
    case LINK_PICTURE:
      take_picture(record);
      return;
    case LINK_SOUND:
      take_sound(record);
      return;
    case LINK_PACKET:
      take_packet(record);
      return;
    case LINK_KEYS:
      take_keys(record);
      return;
    case LINK_PLAYING:
      take_playing(record);
      return;
    case LINK_RECOGNITION:
    case LINK_RECOGNISED:
      take_recognition(record);
      return;
    case LINK_FOLLOWED:
      take_followed(record);
      return;
    case LINK_CUSTOM:
      free(session.custom);
      session.custom = copy_text(record->texts[0].bytes, record->texts[0].size);
      return;
    case LINK_DEVICE:
      device_add(record);
      return;
    default:
      fatal("the simulator: got record %d within a step, expected samples and DONE or END", record->number);
  }
}
