// SPDX-License-Identifier: MIT
// A robot's emitters and receivers of packets, as programs written for Webots' interfaces use them. They are
// no part of the e-puck: the world's packet medium carries them (sim_core/radio/packet_medium.h).
//
//   firmware --send()--> outbox --(medium, between ticks)--> on_packet() --> arrived | visible --> firmware
//
// Modelled: a queue of kQueueBytes on both sides, packets that come in become visible when the program
// latches the receiver, channels changed at any time. Not modelled: direction of the emitter, aperture.
#pragma once
#include <cstdint>
#include <list>
#include <string>
#include <vector>

#include "hal_sim/board/clock.h"
#include "sim_core/radio/packet_medium.h"
#include "sim_core/world/device_desc.h"

namespace board {

inline constexpr int kPacketQueueBytes =
    4096;                                  // of an emitter or a receiver [assumed: holds any usual message]
inline constexpr int kPacketOverhead = 8;  // bytes a packet takes beside its own [assumed: length, channel]

class PacketDevices final : public sim::PacketPort {
 public:
  /// `emitter` and `receiver` of channel 1 first, unless `devices` names them.
  PacketDevices(const RobotClock& clock, int robot, const std::vector<sim::DeviceDesc>& devices);

  /// As in the constructor: channels, ranges, empty queues.
  void begin_again();

  // --- emitters, by number from 0
  int emitters() const { return static_cast<int>(emitters_.size()); }
  const std::string& emitter_name(int e) const { return emitters_[index(e)].name; }
  int emitter_channel(int e) const { return emitters_[index(e)].channel; }
  void set_emitter_channel(int e, int channel) { emitters_[index(e)].channel = channel; }
  /// m, negative: unlimited. Never more than the world file says.
  double emitter_range_m(int e) const { return emitters_[index(e)].range_m; }
  void set_emitter_range_m(int e, double range_m);
  /// False: the queue is full, or the packet is longer than it.
  bool send(int e, const std::uint8_t* data, int bytes, Cycle at);

  // --- receivers
  int receivers() const { return static_cast<int>(receivers_.size()); }
  const std::string& receiver_name(int r) const { return receivers_[index(r)].name; }
  int receiver_channel(int r) const { return receivers_[index(r)].channel; }
  void set_receiver_channel(int r, int channel) { receivers_[index(r)].channel = channel; }
  /// Off: nothing comes in, what is there stays.
  void switch_receiver(int r, bool on) { receivers_[index(r)].on = on; }
  /// The end of a sampling period: what has come in becomes visible.
  void latch(int r) { receivers_[index(r)].visible = static_cast<int>(receivers_[index(r)].queue.size()); }
  /// Visible packet at the head; null without one. Stays valid until drop().
  const sim::ReceivedPacket* head(int r) const;
  void drop(int r);

  // --- sim::PacketPort
  bool listens(int channel) const override;
  void on_packet(const sim::ReceivedPacket& packet) override;
  void on_left(const sim::Packet& packet) override;

 private:
  struct Emitter {
    std::string name;
    int channel = 1;
    double range_m = -1, most_m = -1, baud_rate_bit_s = -1;
    bool infra_red = false;
    int queued = 0;  // bytes on their way
  };
  struct Receiver {
    std::string name;
    int channel = 1;
    bool on = false;
    int bytes = 0;    // in the queue
    int visible = 0;  // packets at the head that the program may see
    std::list<sim::ReceivedPacket> queue;
  };
  static std::size_t index(int n) { return static_cast<std::size_t>(n); }
  static bool hears(const Receiver& r, int channel) {
    return r.on && (channel == sim::kAllChannels || r.channel == sim::kAllChannels || r.channel == channel);
  }

  const RobotClock& clock_;
  std::vector<Emitter> emitters_, emitters_at_first_;
  std::vector<Receiver> receivers_, receivers_at_first_;
};

}  // namespace board
