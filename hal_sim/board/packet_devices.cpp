// SPDX-License-Identifier: MIT
#include "hal_sim/board/packet_devices.h"

#include <algorithm>

namespace board {

PacketDevices::PacketDevices(const RobotClock& clock, int robot_index,
                             const std::vector<sim::DeviceDesc>& devices)
    : clock_(clock) {
  robot = robot_index;
  emitters_.push_back({});
  emitters_.front().name = "emitter";
  receivers_.push_back({});
  receivers_.front().name = "receiver";
  for (const sim::DeviceDesc& d : devices) {
    if (d.kind == sim::DeviceKind::Emitter) {
      if (d.name != emitters_.front().name) emitters_.push_back({});
      Emitter& e = d.name == emitters_.front().name ? emitters_.front() : emitters_.back();
      e.name = d.name;
      e.channel = d.channel;
      e.range_m = e.most_m = d.range_m;
      e.baud_rate_bit_s = d.baud_rate_bit_s;
      e.infra_red = d.infra_red;
    } else if (d.kind == sim::DeviceKind::Receiver) {
      if (d.name != receivers_.front().name) receivers_.push_back({});
      Receiver& r = d.name == receivers_.front().name ? receivers_.front() : receivers_.back();
      r.name = d.name;
      r.channel = d.channel;
    }
  }
  emitters_at_first_ = emitters_;
  receivers_at_first_ = receivers_;
}

void PacketDevices::begin_again() {
  forget_sent();
  emitters_ = emitters_at_first_;
  receivers_ = receivers_at_first_;
}

void PacketDevices::set_emitter_range_m(int e, double range_m) {
  Emitter& emitter = emitters_[index(e)];
  if (emitter.most_m >= 0) range_m = range_m < 0 ? emitter.most_m : std::min(range_m, emitter.most_m);
  emitter.range_m = range_m < 0 ? -1 : range_m;
}

bool PacketDevices::send(int e, const std::uint8_t* data, int bytes, Cycle at) {
  Emitter& emitter = emitters_[index(e)];
  if (bytes < 0 || emitter.queued + bytes + kPacketOverhead > kPacketQueueBytes) return false;
  emitter.queued += bytes + kPacketOverhead;
  sim::Packet packet;
  packet.channel = emitter.channel;
  packet.range_m = emitter.range_m;
  packet.infra_red = emitter.infra_red;
  packet.bytes.assign(data, data + bytes);
  packet.at = clock_.click_at(at);
  packet.emitter = e;
  packet.baud_rate_bit_s = emitter.baud_rate_bit_s;
  PacketPort::send(std::move(packet));
  return true;
}

const sim::ReceivedPacket* PacketDevices::head(int r) const {
  const Receiver& receiver = receivers_[index(r)];
  return receiver.visible > 0 ? &receiver.queue.front() : nullptr;
}

void PacketDevices::drop(int r) {
  Receiver& receiver = receivers_[index(r)];
  if (receiver.visible == 0) return;
  receiver.bytes -= static_cast<int>(receiver.queue.front().bytes.size()) + kPacketOverhead;
  receiver.queue.pop_front();
  --receiver.visible;
}

bool PacketDevices::listens(int channel) const {
  return std::any_of(receivers_.begin(), receivers_.end(),
                     [&](const Receiver& r) { return hears(r, channel); });
}

void PacketDevices::on_packet(const sim::ReceivedPacket& packet) {
  const int bytes = static_cast<int>(packet.bytes.size()) + kPacketOverhead;
  for (Receiver& r : receivers_) {
    if (!hears(r, packet.channel) || r.bytes + bytes > kPacketQueueBytes) continue;
    r.bytes += bytes;
    r.queue.push_back(packet);
  }
}

void PacketDevices::on_left(const sim::Packet& packet) {
  emitters_[index(packet.emitter)].queued -= static_cast<int>(packet.bytes.size()) + kPacketOverhead;
}

}  // namespace board
