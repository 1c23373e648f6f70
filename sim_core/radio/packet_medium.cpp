// SPDX-License-Identifier: MIT
// Ends are served in the order in which they were added, packets of an end in the order in which they were
// sent, so nothing depends on threads.
#include "sim_core/radio/packet_medium.h"

#include <algorithm>
#include <cmath>

#include "sim_core/radio/radio_params.h"
#include "sim_core/world/scene.h"

namespace sim {

namespace {

Vec3 place_of(const Scene& scene, int robot) {
  const BodyState& state = scene.state(robot);
  return {state.pose.x_m, state.pose.y_m, state.z_m};
}

/// Whether anything stands between two robots, at the height of their infra-red devices.
bool is_hidden(const Scene& scene, int from, int to, const Vec3& way, double distance_m) {
  Vec3 start = place_of(scene, from);
  start.z += kPacketInfraRedHeightM;
  const Ray ray{start, {way.x / distance_m, way.y / distance_m, way.z / distance_m}};
  SceneHit hit;
  return scene.cast(ray, distance_m, from, scene.now(), &hit) && hit.robot != to;
}

}  // namespace

void PacketMedium::add(PacketPort& port) {
  port.somebody_sends_ = &somebody_sends_;
  if (!port.outbox_.empty()) somebody_sends_.store(true, std::memory_order_relaxed);
  ports_.push_back(&port);
}

void PacketMedium::exchange(const Scene& scene, Clicks now) {
  if (!somebody_sends_.exchange(false, std::memory_order_relaxed)) return;
  bool some_wait = false;
  // What each port has sent, in order, and what has to wait for its line.
  for (PacketPort* port : ports_) {
    std::list<Packet> waiting;
    while (!port->outbox_.empty()) {
      Packet packet = std::move(port->outbox_.front());
      port->outbox_.pop_front();
      if (packet.baud_rate_bit_s > 0) {
        // one after the other; a packet that is not through yet keeps those behind it back
        Clicks& free_at = port->free_at_[packet.emitter];
        const Clicks out =
            std::max(packet.at, free_at) +
            from_seconds(8.0 * static_cast<double>(packet.bytes.size()) / packet.baud_rate_bit_s);
        const bool queue = std::any_of(waiting.begin(), waiting.end(),
                                       [&](const Packet& w) { return w.emitter == packet.emitter; });
        if (queue || out > now) {
          waiting.push_back(std::move(packet));
          continue;
        }
        free_at = out;
      }
      deliver(scene, *port, packet, now);
      port->on_left(packet);
    }
    // what was sent while delivering (a supervisor's answer) lies behind
    for (Packet& newer : port->outbox_) waiting.push_back(std::move(newer));
    port->outbox_ = std::move(waiting);
    some_wait = some_wait || !port->outbox_.empty();
  }
  if (some_wait) somebody_sends_.store(true, std::memory_order_relaxed);
}

void PacketMedium::deliver(const Scene& scene, const PacketPort& from, const Packet& packet,
                           Clicks now) const {
  for (PacketPort* to : ports_) {
    if (to == &from || !to->listens(packet.channel)) continue;
    ReceivedPacket received;
    received.channel = packet.channel;
    received.from_robot = from.robot;
    received.delivered = now;
    if (from.robot >= 0 && to->robot >= 0) {
      const Vec3 here = place_of(scene, to->robot), there = place_of(scene, from.robot);
      const Vec3 way{there.x - here.x, there.y - here.y, there.z - here.z};
      const double distance_m = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
      if (packet.range_m >= 0 && distance_m > packet.range_m) continue;
      if (distance_m > 0) {
        if (packet.infra_red && is_hidden(scene, from.robot, to->robot, {-way.x, -way.y, -way.z}, distance_m))
          continue;
        const Vec2 local = Frame2(scene.state(to->robot).pose).turn_back({way.x, way.y});
        received.direction = {local.x / distance_m, local.y / distance_m, way.z / distance_m};
        received.strength = 1 / (distance_m * distance_m);
      }
    }
    received.bytes = packet.bytes;
    to->on_packet(received);
  }
}

}  // namespace sim
