// SPDX-License-Identifier: MIT
// The functions of pins_virtual.h on the board.
#include <algorithm>
#include <cstring>

#include "hal_sim/board/board.h"
#include "hal_sim/board/true_state.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_virtual.h"
#include "sim_core/base/hash.h"

using board::Board;
using host::Context;

namespace {

constexpr tp_i64 kCalendarBegins = 1000000000;  // 2001-09-09 in seconds of 1970 [assumed: any past moment]
constexpr tp_i64 kCalendarSpread = 100000000;   // three years

Board& this_board() { return Context::current().board(); }

void copy_name(const std::string& name, char* to, tp_i64 size) {
  if (size <= 0) return;
  const std::size_t n = std::min(name.size(), static_cast<std::size_t>(size - 1));
  std::memcpy(to, name.data(), n);
  to[n] = 0;
}

/// A text of the program. No std::string from a null pointer, which throws: a fault tells who read it.
std::string text_of(const char* text) { return std::string(text, std::strlen(text)); }

void put(const sim::Vec3& v, tp_f32* to) {
  to[0] = static_cast<float>(v.x);
  to[1] = static_cast<float>(v.y);
  to[2] = static_cast<float>(v.z);
}

board::TrueState truth() {
  Context& context = Context::current();
  const host::Cycle now = context.now();
  context.lower_horizon(now);
  return board::true_state(context.board(), now);
}

bool is_emitter(tp_i64 e) { return e >= 0 && e < this_board().packets().emitters(); }
bool is_receiver(tp_i64 r) { return r >= 0 && r < this_board().packets().receivers(); }

const sim::ReceivedPacket* head_of(tp_i64 r) {
  return is_receiver(r) ? this_board().packets().head(static_cast<int>(r)) : nullptr;
}

}  // namespace

extern "C" {

void tp_virtual_console(const char* bytes, tp_i64 length) {
  Context::current().note_write();
  constexpr tp_i64 kLongestText = 1 << 16;
  if (length > 0)
    this_board().virtual_devices().write(bytes, static_cast<std::size_t>(std::min(length, kLongestText)));
}

tp_i64 tp_virtual_time_step_us(void) {
  return static_cast<tp_i64>(this_board().setup().webots.time_step_s * 1e6 + 0.5);
}

void tp_virtual_speed_unit(tp_f32* unit) {
  *unit = static_cast<float>(std::max(0.0, this_board().setup().webots.speed_unit_rad_s));
}

tp_i64 tp_virtual_lab_order(void) { return this_board().setup().webots.sensor_order == "lab" ? 1 : 0; }

tp_i64 tp_virtual_nue(void) { return this_board().setup().webots.axes == sim::Axes::Nue ? 1 : 0; }

void tp_virtual_robot_name(char* name, tp_i64 size) { copy_name(this_board().setup().name, name, size); }

tp_i64 tp_virtual_calendar_s(void) {
  Context& context = Context::current();
  const host::Cycle now = context.now();
  context.lower_horizon(now);
  const Board& robot = context.board();
  const auto begins = static_cast<tp_i64>(sim::mix64(robot.setup().seed) % std::uint64_t{kCalendarSpread});
  return kCalendarBegins + begins + robot.clock().click_at(now) / sim::kClicksPerSecond;
}

char* tp_virtual_heap(tp_i64 bytes) {
  constexpr tp_i64 kMostBytes = 1 << 26;
  if (bytes < 0 || bytes > kMostBytes) return nullptr;
  return this_board().virtual_devices().heap(static_cast<std::size_t>(bytes));
}

tp_i64 tp_virtual_device(tp_i64 index, char* name, tp_i64 size) {
  const std::vector<sim::DeviceDesc>& devices = this_board().setup().devices;
  if (index < 0 || index >= static_cast<tp_i64>(devices.size())) return 0;
  const sim::DeviceDesc& device = devices[static_cast<std::size_t>(index)];
  copy_name(device.name, name, size);
  switch (device.kind) {
    case sim::DeviceKind::Gps:
      return TP_DEVICE_GPS;
    case sim::DeviceKind::Compass:
      return TP_DEVICE_COMPASS;
    case sim::DeviceKind::Inertial:
      return TP_DEVICE_INERTIAL;
    case sim::DeviceKind::Gyro:
      return TP_DEVICE_GYRO;
    case sim::DeviceKind::Emitter:
      return TP_DEVICE_EMITTER;
    case sim::DeviceKind::Receiver:
      return TP_DEVICE_RECEIVER;
    case sim::DeviceKind::Distance:
      return TP_DEVICE_DISTANCE;
    case sim::DeviceKind::Display:
      return TP_DEVICE_DISPLAY;
    default:  // of programs of the PC; 0 would end the list
      return TP_DEVICE_DISTANCE;
  }
}

tp_i64 tp_virtual_sensor(const char* name, tp_f32* value) {
  Context& context = Context::current();
  context.lower_horizon(context.now());
  const auto found = context.board().virtual_devices().get(text_of(name));
  if (!found) return 0;
  *value = static_cast<float>(*found);
  return 1;
}

void tp_virtual_position(tp_f32* xyz, tp_f32* velocity) {
  const board::TrueState state = truth();
  put(state.position_m, xyz);
  put(state.velocity_m_s, velocity);
}
void tp_virtual_north(tp_f32* xyz) { put(truth().north, xyz); }
void tp_virtual_attitude(tp_f32* angles) { put(truth().attitude_rad, angles); }
void tp_virtual_rates(tp_f32* xyz) { put(truth().rates_rad_s, xyz); }

tp_i64 tp_virtual_find(const char* name) { return board::find_body(this_board(), text_of(name)) + 1; }

void tp_virtual_pose_of(tp_i64 found, tp_f32* xyz, tp_f32* angle) {
  Context& context = Context::current();
  const host::Cycle now = context.now();
  context.lower_horizon(now);
  sim::Vec3 position;
  double angle_rad = 0;
  board::true_pose(context.board(), static_cast<int>(found) - 1, now, position, angle_rad);
  put(position, xyz);
  *angle = static_cast<float>(angle_rad);
}

tp_i64 tp_virtual_key(tp_i64 index) {
  Context& context = Context::current();
  const host::Cycle now = context.now();
  context.lower_horizon(now);
  const double now_s = sim::to_seconds(context.board().clock().click_at(now));
  for (const auto& key : this_board().virtual_devices().typed)
    if (now_s >= key.from_s && now_s < key.to_s && index-- == 0) return key.key;
  return 0;
}

tp_i64 tp_file_open(const char* name, const char* mode) {
  Context::current().note_write();
  board::VirtualDevices& devices = this_board().virtual_devices();
  std::string why;
  const int file = devices.files.open(name, mode, why);
  if (!why.empty()) {
    const std::string line = "fopen(\"" + std::string(name) + "\"): " + why + "\n";
    devices.write(line.data(), line.size());
  }
  return file;
}
void tp_file_close(tp_i64 file) { this_board().virtual_devices().files.close(static_cast<int>(file)); }
tp_i64 tp_file_read(tp_i64 file, void* to, tp_i64 bytes) {
  Context::current().note_write();
  return this_board().virtual_devices().files.read(static_cast<int>(file), to, bytes);
}
tp_i64 tp_file_write(tp_i64 file, const void* from, tp_i64 bytes) {
  Context::current().note_write();
  return this_board().virtual_devices().files.write(static_cast<int>(file), from, bytes);
}
void tp_file_flush(tp_i64 file) { this_board().virtual_devices().files.flush(static_cast<int>(file)); }
tp_i64 tp_file_seek(tp_i64 file, tp_i64 offset, tp_i64 from) {
  Context::current().note_write();
  return this_board().virtual_devices().files.seek(static_cast<int>(file), offset, static_cast<int>(from));
}
tp_i64 tp_file_remove(const char* name) {
  Context::current().note_write();
  return this_board().virtual_devices().files.remove(name);
}

tp_i64 tp_emitter_find(const char* name) {
  const board::PacketDevices& packets = this_board().packets();
  for (int e = 0; e < packets.emitters(); ++e)
    if (packets.emitter_name(e) == name) return e;
  return -1;
}

tp_i64 tp_emitter_send(tp_i64 emitter, const void* data, tp_i64 bytes) {
  Context& context = Context::current();
  context.note_write();
  if (!is_emitter(emitter) || bytes < 0 || bytes > board::kPacketQueueBytes) return 0;
  return context.board().packets().send(static_cast<int>(emitter), static_cast<const std::uint8_t*>(data),
                                        static_cast<int>(bytes), context.now())
             ? 1
             : 0;
}

tp_i64 tp_emitter_channel(tp_i64 emitter) {
  return is_emitter(emitter) ? this_board().packets().emitter_channel(static_cast<int>(emitter)) : 0;
}
void tp_emitter_set_channel(tp_i64 emitter, tp_i64 channel) {
  Context::current().note_write();
  if (is_emitter(emitter))
    this_board().packets().set_emitter_channel(static_cast<int>(emitter), static_cast<int>(channel));
}
void tp_emitter_range(tp_i64 emitter, tp_f32* range) {
  *range = is_emitter(emitter)
               ? static_cast<float>(this_board().packets().emitter_range_m(static_cast<int>(emitter)))
               : -1;
}
void tp_emitter_set_range(tp_i64 emitter, const tp_f32* range) {
  Context::current().note_write();
  if (is_emitter(emitter)) this_board().packets().set_emitter_range_m(static_cast<int>(emitter), *range);
}

tp_i64 tp_receiver_find(const char* name) {
  const board::PacketDevices& packets = this_board().packets();
  for (int r = 0; r < packets.receivers(); ++r)
    if (packets.receiver_name(r) == name) return r;
  return -1;
}

void tp_receiver_switch(tp_i64 receiver, tp_i64 on) {
  Context::current().note_write();
  if (is_receiver(receiver)) this_board().packets().switch_receiver(static_cast<int>(receiver), on != 0);
}
void tp_receiver_latch(tp_i64 receiver) {
  Context::current().note_write();
  if (is_receiver(receiver)) this_board().packets().latch(static_cast<int>(receiver));
}
tp_i64 tp_receiver_visible(tp_i64 receiver) {
  return is_receiver(receiver) ? this_board().packets().visible(static_cast<int>(receiver)) : 0;
}
tp_i64 tp_receiver_size(tp_i64 receiver) {
  const sim::ReceivedPacket* packet = head_of(receiver);
  return packet ? static_cast<tp_i64>(packet->bytes.size()) : 0;
}
const void* tp_receiver_data(tp_i64 receiver) {
  const sim::ReceivedPacket* packet = head_of(receiver);
  return packet ? packet->bytes.data() : nullptr;
}
void tp_receiver_origin(tp_i64 receiver, tp_f32* strength, tp_f32* direction) {
  const sim::ReceivedPacket* packet = head_of(receiver);
  *strength = packet ? static_cast<float>(packet->strength) : 0;
  const sim::Vec3 way = packet ? packet->direction : sim::Vec3{};
  put(tp_virtual_nue() ? sim::Vec3{-way.y, way.z, -way.x} : way, direction);
}
void tp_receiver_drop(tp_i64 receiver) {
  Context::current().note_write();
  if (is_receiver(receiver)) this_board().packets().drop(static_cast<int>(receiver));
}
tp_i64 tp_receiver_channel(tp_i64 receiver) {
  return is_receiver(receiver) ? this_board().packets().receiver_channel(static_cast<int>(receiver)) : 0;
}
void tp_receiver_set_channel(tp_i64 receiver, tp_i64 channel) {
  Context::current().note_write();
  if (is_receiver(receiver))
    this_board().packets().set_receiver_channel(static_cast<int>(receiver), static_cast<int>(channel));
}

}  // extern "C"
