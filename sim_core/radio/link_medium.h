// SPDX-License-Identifier: MIT
// Short-range links between two robots: messages with latency and bandwidth, within a range, with drop-outs.
//
//   robot: outbox (message at an instant) --> range, drop-outs, latency, bandwidth
//                                         --> on_message() of the other robot, at a later tick
//
// What a message means is the robots' business. A reliable message waits while its way is blocked, and the
// ones behind it wait with it; another is lost. Two ports that name each other as peer are linked; when their
// way stays blocked for the timeout, both are told and what was under way is lost. Modelled: range, latency,
// bandwidth per direction, drop-outs by list and by chance. Not modelled: obstacles, interference, a
// bandwidth shared by links. Arrival is seen at the next tick, so latency grows by up to one tick.
#pragma once
#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/world/medium.h"
#include "sim_core/world/radio_desc.h"

namespace sim {

struct LinkMessage {
  static constexpr int kEverybody = -1;
  int from = 0;           ///< index of the port; set by the medium
  int to = kEverybody;    ///< index of the port
  Clicks at = 0;          ///< when it was sent
  int kind = 0;           ///< chosen by the robots
  bool reliable = false;  ///< waits while the way is blocked
  std::vector<std::uint8_t> bytes;
};

/// One robot's end. The robot uses send() and `peer` while it runs; the calls come between ticks.
class LinkPort {
 public:
  static constexpr int kNobody = -1;

  virtual ~LinkPort() = default;
  virtual void on_message(const LinkMessage& message, Clicks now) = 0;
  /// The link to `peer` is gone; `peer` has been set to kNobody.
  virtual void on_link_lost(Clicks now) = 0;

  /// From the robot's own thread, or inside on_message(); in order of time.
  void send(LinkMessage message) {
    outbox_.push_back(std::move(message));
    if (somebody_sends_) somebody_sends_->store(true, std::memory_order_relaxed);
  }

  int robot = 0;         ///< whose pose counts
  int peer = kNobody;    ///< port it is linked to
  bool blocked = false;  ///< in a drop-out now; set by the medium

 private:
  friend class LinkMedium;
  std::vector<LinkMessage> outbox_;
  std::atomic<bool>* somebody_sends_ = nullptr;
};

class LinkMedium final : public Medium {
 public:
  /// `ports` outlive the medium; `own_dropouts` has one list per port.
  LinkMedium(const LinkDesc& desc, std::uint64_t seed, std::vector<LinkPort*> ports,
             std::vector<std::vector<Dropout>> own_dropouts);

  void exchange(const Scene& scene, Clicks now) override;
  void begin_again(Clicks now) override;
  bool is_busy() const override { return has_dropouts_ || has_links_ || !ways_.empty(); }

 private:
  struct UnderWay {
    LinkMessage message;
    Clicks arrival = 0;
  };
  struct Way {  // one direction of a pair
    std::deque<UnderWay> messages;
    Clicks free_at = 0;  // end of the last transmission
  };
  /// Drop-outs by chance of one port, one after the other.
  struct ByChance {
    std::uint64_t drawn = 0;
    Clicks begin = 0, end = 0;
  };
  bool drops_out(std::size_t port, Clicks at);
  bool is_blocked(const Scene& scene, int a, int b) const;
  void take_outboxes(Clicks now);
  void deliver(const Scene& scene, Clicks now);
  void supervise(const Scene& scene, Clicks now);

  LinkDesc desc_;
  std::uint64_t seed_;
  std::vector<LinkPort*> ports_;
  std::vector<std::vector<Dropout>> own_dropouts_;
  std::vector<ByChance> by_chance_;
  bool has_dropouts_ = false;
  std::map<std::pair<int, int>, Way> ways_;
  std::map<std::pair<int, int>, Clicks> silent_since_;  // blocked links
  std::atomic<bool> somebody_sends_{false};
  bool has_links_ = false;
  Clicks last_ = 0, begun_ = 0;
};

}  // namespace sim
