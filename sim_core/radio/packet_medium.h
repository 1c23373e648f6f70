// SPDX-License-Identifier: MIT
// Packets from emitters to receivers on numbered channels, as the devices of that name do in Webots: a packet
// leaves at the end of the tick in which it was sent, whole and in order, reaches every other end that
// listens to its channel within its range, and never its sender. Ends are robots' or belong to nobody (a
// supervisor: no place, no range). Modelled: channel (-1 sends to or hears all), range, strength 1/d2,
// direction, line of sight for infra-red, baud rate, a full queue. Not modelled: collisions, fading; the
// radio of radio_medium.h has those.
#pragma once
#include <atomic>
#include <cstdint>
#include <list>
#include <map>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/pose.h"
#include "sim_core/world/medium.h"

namespace sim {

inline constexpr int kAllChannels = -1;

/// What an end sent, on its way.
struct Packet {
  int channel = 0;
  double range_m = -1;  ///< negative: unlimited
  bool infra_red = false;
  std::vector<std::uint8_t> bytes;
  Clicks at = 0;                ///< when it was sent; set by the sender
  int emitter = 0;              ///< which of the end's emitters: each sends one packet after the other
  double baud_rate_bit_s = -1;  ///< negative: unlimited; 8 bits a byte
};

/// The same as a receiver finds it.
struct ReceivedPacket {
  int channel = 0;
  int from_robot = -1;  ///< index; -1: not a robot
  std::vector<std::uint8_t> bytes;
  double strength = 1;   ///< 1 / d2, d in m; 1 from or to an end without a place
  Vec3 direction;        ///< unit, towards the sender, in the receiver's frame: forward, left, up
  Clicks delivered = 0;  ///< tick boundary
};

/// One end: a robot's emitters and receivers together, or a supervisor's.
class PacketPort {
 public:
  virtual ~PacketPort() = default;
  /// Whether a packet on that channel is wanted now. kAllChannels: sent to everybody.
  virtual bool listens(int channel) const = 0;
  /// Between ticks, in order of sender and time.
  virtual void on_packet(const ReceivedPacket& packet) = 0;
  /// Between ticks: the last bit of a packet of this end is out, whoever hears it. Its queue has room again.
  virtual void on_left(const Packet&) {}

  /// From the port's own thread, in order of time.
  void send(Packet packet) {
    outbox_.push_back(std::move(packet));
    if (somebody_sends_) somebody_sends_->store(true, std::memory_order_relaxed);
  }

  int robot = -1;  ///< whose pose counts; -1: it has no place

 protected:
  /// Nothing is on its way out.
  void forget_sent() {
    outbox_.clear();
    free_at_.clear();
  }

 private:
  friend class PacketMedium;
  std::list<Packet> outbox_;
  std::atomic<bool>* somebody_sends_ = nullptr;
  std::map<int, Clicks> free_at_;  // of each emitter with a baud rate: end of its last packet
};

/// Costs nothing while nobody sends.
class PacketMedium final : public Medium {
 public:
  /// `port` outlives the medium. Ports deliver and are served in the order in which they were added.
  void add(PacketPort& port);
  void exchange(const Scene& scene, Clicks now) override;
  bool is_busy() const override { return somebody_sends_.load(std::memory_order_relaxed); }

 private:
  void deliver(const Scene& scene, const PacketPort& from, const Packet& packet, Clicks now) const;

  std::vector<PacketPort*> ports_;
  std::atomic<bool> somebody_sends_{false};
};

}  // namespace sim
