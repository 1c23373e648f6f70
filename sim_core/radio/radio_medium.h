// SPDX-License-Identifier: MIT
// One radio channel of the world: packets of robots that reach others or do not.
//
//   robot: outbox (request at an instant) --> wait, listen, send
//                                         --> at each receiver: range, chance, collision
//                                         --> on_frame() at the tick after its end
//
// Modelled: path loss (log-distance with fading per frame, or a disc), transmit power, loss by chance,
// listening before sending with random waits, frames that overlap at a receiver (the stronger one survives
// when it is stronger by the capture ratio), deafness while sending. Each drawn number has its key, so the
// outcome depends neither on the order of the robots nor on threads. Not modelled: obstacles, antenna
// patterns, bit errors inside a frame that arrives, a receiver locked to the first of two frames, drift of a
// robot's clock within a frame. Source: radio_params.h, world/world_desc.h.
#pragma once
#include <cstdint>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/world/medium.h"
#include "sim_core/world/radio_desc.h"

namespace sim {

/// A frame as it was on the air.
struct RadioFrame {
  int sender = 0;             ///< index of the port
  std::uint64_t number = 0;   ///< counts the sender's frames
  Clicks start = 0, end = 0;  ///< first to last bit
  double power_db = 0;        ///< relative to full power, at most 0
  std::vector<std::uint8_t> bytes;
};

/// What a robot wants to be sent.
struct RadioRequest {
  Clicks at = 0;        ///< when it was asked for
  int air_octets = 0;   ///< on the air, headers included; 1 or more
  double power_db = 0;  ///< relative to full power, at most 0
  std::vector<std::uint8_t> bytes;
};

/// One robot's radio, seen from the channel. The robot fills the fields while it runs; the calls
/// come between ticks.
class RadioPort {
 public:
  static constexpr Clicks kOff = INT64_MAX;

  virtual ~RadioPort() = default;
  /// A frame has arrived whole; `level_db` above the weakest one that can be received.
  virtual void on_frame(const RadioFrame& frame, double level_db) = 0;
  /// The oldest request is done: sent, or given up because the channel stayed busy.
  virtual void on_sent(bool given_up, Clicks at) = 0;

  int robot = 0;                    ///< whose pose counts
  std::vector<RadioRequest> outbox; /**< in order of time; the channel takes them */
  Clicks listening_since = kOff;    ///< a frame that starts earlier is not heard
};

/// Pairs of frame and receiver: each ends in exactly one of the last six, switched-off receivers included.
struct RadioCounters {
  std::int64_t sent = 0;      ///< frames on the air
  std::int64_t given_up = 0;  ///< frames that never found the channel free
  std::int64_t delivered = 0;
  std::int64_t out_of_range = 0;
  std::int64_t by_chance = 0;
  std::int64_t by_collision = 0;
  std::int64_t while_sending = 0;
  std::int64_t switched_off = 0;
};

class RadioMedium final : public Medium {
 public:
  /// `ports` in the order in which ties are broken; they outlive the medium. seed: the world's.
  RadioMedium(const RadioDesc& desc, std::uint64_t seed, std::vector<RadioPort*> ports);

  void exchange(const Scene& scene, Clicks now) override;
  void begin_again(Clicks now) override;
  bool is_busy() const override;
  const RadioCounters& counters() const { return counters_; }

  /// Level of a frame at a distance, dB above the weakest one that can be received, without fading. In the
  /// disc model the law with the same exponent, which is 0 at the range.
  double mean_level_db(double distance_m, double power_db) const;

 private:
  struct Waiting {  // a request that has not found the channel free yet
    RadioRequest request;
    Clicks at = 0;  // next look at the channel
    int tries = 0;
    bool queued = false;
  };
  void contend(const Scene& scene, Clicks now);
  bool is_busy(const Scene& scene, int port, Clicks at) const;
  void resolve(const Scene& scene, Clicks now);
  void hand_over(const Scene& scene, const RadioFrame& frame, int receiver);
  /// Level of a frame at a receiver, fading included.
  double level_db(const Scene& scene, const RadioFrame& frame, int receiver) const;
  double distance_m(const Scene& scene, int a, int b, Clicks at) const;
  std::uint64_t draw_counter(const RadioFrame& frame) const;

  RadioDesc desc_;
  std::uint64_t seed_;
  std::vector<RadioPort*> ports_;
  std::vector<Waiting> waiting_;           // one per port
  std::vector<std::uint64_t> numbers_;     // frames per port so far
  std::vector<std::uint64_t> waits_;       // random waits per port so far
  std::vector<Clicks> free_at_;            // end of each port's last frame
  std::vector<RadioFrame> on_air_;         // in order of their start; kept while an open frame may overlap
  std::vector<const RadioFrame*> rivals_;  // of the frame being handed over
  Clicks resolved_until_ = 0;
  RadioCounters counters_;
};

}  // namespace sim
