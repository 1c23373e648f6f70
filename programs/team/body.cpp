// SPDX-License-Identifier: MIT
#include "programs/team/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware/include/webots/nodes.h"
#include "hal_sim/board/packet_devices.h"
#include "programs/puck/records.h"
#include "programs/puck/world_device.h"

namespace programs {

namespace {

bool hears(int channel, int sent) {
  return channel == sim::kAllChannels || sent == sim::kAllChannels || channel == sent;
}

}  // namespace

std::int64_t RobotBody::take_samples(link_packet& to) {
  link_append(&to, &runner()->take_samples());
  return step_ms_;
}

BodilessBody::BodilessBody(const sim::SupervisorDesc& desc) : desc_(desc) { restart(); }

void BodilessBody::restart() {
  devices_.clear();
  time_ms_ = step_ms_ = 0;
  bool has_emitter = false, has_receiver = false;
  for (const sim::DeviceDesc& d : desc_.devices) {
    WorldDevice device = world_device(d);
    has_emitter |= d.kind == sim::DeviceKind::Emitter;
    has_receiver |= d.kind == sim::DeviceKind::Receiver;
    devices_.push_back({d.name, device.node, std::move(device.needs), d.channel, d.range_m});
  }
  // a world file that names none had these
  if (!has_emitter) devices_.push_back({"emitter", WB_NODE_EMITTER, {1, -1, board::kPacketQueueBytes}, 1});
  if (!has_receiver) devices_.push_back({"receiver", WB_NODE_RECEIVER, {1}, 1});
  devices_.push_back({"keyboard", WB_NODE_NO_NODE, {}});
}

void BodilessBody::tell(std::size_t number, link_packet& to) const {
  const Device& device = devices_[number];
  put_device(to, number, device.node, device.name, device.needs);
}

void BodilessBody::tell_devices(const sim::WorldDesc&, link_packet& to) {
  for (std::size_t i = 0; i < devices_.size(); ++i) tell(i, to);
}

void BodilessBody::find_device(const std::string& name, link_packet& to) {
  for (std::size_t i = 0; i < devices_.size(); ++i)
    if (devices_[i].name == name) return tell(i, to);
  put_nothing(to, "got device \"" + name + "\", expected one that this supervisor has");
}

std::string BodilessBody::command(const link_record& record) {
  const link_row* row = link_row_of(record.number);
  const std::int64_t tag = record.ints[0];
  if (tag < 1 || tag > static_cast<std::int64_t>(devices_.size()))
    return fmt::format("{}: got tag {}, expected 1 to {}", row->name, tag, devices_.size());
  Device& device = devices_[static_cast<std::size_t>(tag - 1)];
  // It has packets and what its world file gives it; other commands mean nothing here.
  const bool emits = device.node == WB_NODE_EMITTER, hears_packets = device.node == WB_NODE_RECEIVER;
  const auto wrong = [&] {
    return fmt::format("{}: got '{}', which is no device for that", row->name, device.name);
  };
  switch (record.number) {
    case LINK_ENABLE:
      device.period_ms = std::max<std::int64_t>(0, record.ints[1]);
      device.elapsed_ms = 0;
      return "";
    case LINK_VELOCITY:
    case LINK_POSITION:
    case LINK_LED:
    case LINK_PLAY:
    case LINK_SILENCE:
    case LINK_RECOGNISE:
      return "";
    case LINK_SEND: {
      if (!emits) return wrong();
      sim::Packet packet;
      packet.channel = device.channel;
      packet.range_m = device.range_m;
      packet.bytes.assign(record.texts[0].bytes, record.texts[0].bytes + record.texts[0].size);
      packet.at = began_ + clicks_of_ms(time_ms_);
      packet.emitter = static_cast<int>(tag);
      send(std::move(packet));
      return "";
    }
    case LINK_CHANNEL:
      if (!emits && !hears_packets) return wrong();
      device.channel = static_cast<int>(std::clamp<std::int64_t>(record.ints[1], -1, 1 << 30));
      return "";
    case LINK_RANGE:
      if (!emits) return wrong();
      device.range_m = record.reals[0];
      return "";
    default:
      return wrong();
  }
}

bool BodilessBody::is_due(sim::Clicks now) {
  return step_ms_ > 0 && began_ + clicks_of_ms(time_ms_ + step_ms_) <= now;
}

std::int64_t BodilessBody::take_samples(link_packet& to) {
  const std::int64_t step = step_ms_;
  time_ms_ += step;
  step_ms_ = 0;
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    Device& device = devices_[i];
    if (device.period_ms == 0) continue;
    device.elapsed_ms += step;
    if (device.elapsed_ms < device.period_ms) continue;
    device.elapsed_ms = 0;
    const auto tag = static_cast<std::int64_t>(i) + 1;
    if (device.node == WB_NODE_POSITION_SENSOR) {  // nothing turns it
      const double angle = 0;
      link_begin(&to, LINK_NUMBERS);
      link_int(&to, tag);
      link_numbers(&to, &angle, 1);
      link_end(&to);
    }
    for (const sim::ReceivedPacket& packet : device.queue) {
      put_packet(to, tag, packet, {});  // it has no place: no direction
    }
    device.queue.clear();
  }
  return step;
}

bool BodilessBody::listens(int channel) const {
  return std::any_of(devices_.begin(), devices_.end(), [&](const Device& d) {
    return d.node == WB_NODE_RECEIVER && d.period_ms > 0 && hears(d.channel, channel);
  });
}

void BodilessBody::on_packet(const sim::ReceivedPacket& packet) {
  for (Device& device : devices_)
    if (device.node == WB_NODE_RECEIVER && device.period_ms > 0 && hears(device.channel, packet.channel))
      device.queue.push_back(packet);
}

}  // namespace programs
