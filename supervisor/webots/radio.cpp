// SPDX-License-Identifier: MIT
// Emitters and receivers of supervisor programs, in both interfaces. A supervisor has no place: its packets
// reach everybody, strength is 1, direction 0. Devices come into being when their name is asked for.
#include <webots/emitter.h>
#include <webots/receiver.h>

#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "supervisor/webots/shared.h"

extern "C" {
#include <device/emitter.h>
#include <device/receiver.h>
}

namespace webots {

namespace {

constexpr int kUsualChannel = 1;  // as the robots' [Webots: E-puck.proto, emitter_channel]
constexpr int kBufferBytes = 4096;

struct Device {
  std::string name;
  bool receives = false;
  int channel = kUsualChannel;
  int period_ms = 0;
  double range_m = -1;
  std::deque<std::vector<char>> queue;
  std::vector<char> buffer;  // of the oldest interface
};

std::map<unsigned short, Device> devices;

Device& device(unsigned short tag) {
  static Device none;
  const auto found = devices.find(tag);
  if (found != devices.end()) return found->second;
  warn("got device %u, expected one of robot_get_device(); call has no effect", tag);
  none = {};
  return none;
}

}  // namespace

unsigned short find_device(const char* name) {
  const std::string wanted = name ? name : "";
  for (const auto& [tag, d] : devices)
    if (d.name == wanted) return tag;
  const bool receives = wanted.find("eceiver") != std::string::npos;
  if (!receives && wanted.find("mitter") == std::string::npos) {
    warn("got device '%s', expected an emitter or a receiver: a supervisor has no others", wanted.c_str());
    return 0;
  }
  const auto tag = static_cast<unsigned short>(devices.size() + 1);
  devices[tag].name = wanted;
  devices[tag].receives = receives;
  return tag;
}

const char* device_name(unsigned short tag) { return devices.count(tag) ? devices[tag].name.c_str() : ""; }
bool device_receives(unsigned short tag) { return devices.count(tag) && devices[tag].receives; }
int device_count() { return static_cast<int>(devices.size()); }

void fill_receivers() {
  sv_message m;
  while (sv_receive(&m) == 1) {
    const char* bytes = static_cast<const char*>(m.data);
    for (auto& [tag, d] : devices)
      if (d.receives && d.period_ms > 0 && (d.channel == -1 || m.channel == -1 || d.channel == m.channel))
        d.queue.emplace_back(bytes, bytes + m.size);
  }
}

}  // namespace webots

using webots::device;

extern "C" {

int wb_emitter_send(WbDeviceTag tag, const void* data, int size) {
  return sv_send(device(tag).channel, data, size) == 0;
}
void wb_emitter_set_channel(WbDeviceTag tag, int channel) { device(tag).channel = channel; }
int wb_emitter_get_channel(WbDeviceTag tag) { return device(tag).channel; }
void wb_emitter_set_range(WbDeviceTag tag, double range) { device(tag).range_m = range; }
double wb_emitter_get_range(WbDeviceTag tag) { return device(tag).range_m; }
int wb_emitter_get_buffer_size(WbDeviceTag) { return webots::kBufferBytes; }

void wb_receiver_enable(WbDeviceTag tag, int sampling_period) {
  device(tag).period_ms = sampling_period;
  if (sampling_period > 0) sv_listen(SV_ALL_CHANNELS);
}
void wb_receiver_disable(WbDeviceTag tag) { device(tag).period_ms = 0; }
int wb_receiver_get_sampling_period(WbDeviceTag tag) { return device(tag).period_ms; }
int wb_receiver_get_queue_length(WbDeviceTag tag) { return static_cast<int>(device(tag).queue.size()); }
void wb_receiver_next_packet(WbDeviceTag tag) {
  auto& queue = device(tag).queue;
  if (!queue.empty()) queue.pop_front();
}
int wb_receiver_get_data_size(WbDeviceTag tag) {
  const auto& queue = device(tag).queue;
  return queue.empty() ? 0 : static_cast<int>(queue.front().size());
}
const void* wb_receiver_get_data(WbDeviceTag tag) {
  const auto& queue = device(tag).queue;
  return queue.empty() ? nullptr : queue.front().data();
}
double wb_receiver_get_signal_strength(WbDeviceTag tag) { return device(tag).queue.empty() ? 0 : 1; }
const double* wb_receiver_get_emitter_direction(WbDeviceTag) {
  static const double nowhere[3] = {0, 0, 0};
  return nowhere;
}
void wb_receiver_set_channel(WbDeviceTag tag, int channel) { device(tag).channel = channel; }
int wb_receiver_get_channel(WbDeviceTag tag) { return device(tag).channel; }

// --- 2005

int emitter_send_packet(DeviceTag tag, const void* data, int size) {
  return wb_emitter_send(tag, data, size);
}
void* emitter_get_buffer(DeviceTag tag) {
  auto& buffer = device(tag).buffer;
  buffer.resize(webots::kBufferBytes);
  return buffer.data();
}
int emitter_send(DeviceTag tag, int size) {
  if (size < 1 || size > webots::kBufferBytes) return 0;
  return wb_emitter_send(tag, emitter_get_buffer(tag), size);
}
void emitter_set_channel(DeviceTag tag, int channel) { wb_emitter_set_channel(tag, channel); }
int emitter_get_channel(DeviceTag tag) { return wb_emitter_get_channel(tag); }
void emitter_set_range(DeviceTag tag, float range) { wb_emitter_set_range(tag, static_cast<double>(range)); }
float emitter_get_range(DeviceTag tag) { return static_cast<float>(wb_emitter_get_range(tag)); }

void receiver_enable(DeviceTag tag, int ms) { wb_receiver_enable(tag, ms); }
void receiver_disable(DeviceTag tag) { wb_receiver_disable(tag); }
int receiver_get_queue_length(DeviceTag tag) { return wb_receiver_get_queue_length(tag); }
void receiver_next_packet(DeviceTag tag) { wb_receiver_next_packet(tag); }
int receiver_get_data_size(DeviceTag tag) { return wb_receiver_get_data_size(tag); }
const void* receiver_get_data(DeviceTag tag) { return wb_receiver_get_data(tag); }
float receiver_get_signal_strength(DeviceTag tag) {
  return static_cast<float>(wb_receiver_get_signal_strength(tag));
}
const float* receiver_get_emitter_direction(DeviceTag) {
  static const float nowhere[3] = {0, 0, 0};
  return nowhere;
}
void receiver_set_channel(DeviceTag tag, int channel) { wb_receiver_set_channel(tag, channel); }
int receiver_get_channel(DeviceTag tag) { return wb_receiver_get_channel(tag); }
}
