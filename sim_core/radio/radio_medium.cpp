// SPDX-License-Identifier: MIT
// Looks at the channel are worked through in order of time, then ports. A look needs to know every frame that
// began before it, and a frame every other that overlaps it: both are known once all robots have run to
// `now`, because a request is never older than the tick in which it was made.
#include "sim_core/radio/radio_medium.h"

#include <algorithm>

#include "sim_core/base/portable_math.h"
#include "sim_core/radio/radio_params.h"
#include "sim_core/random/counter_random.h"
#include "sim_core/world/scene.h"

namespace sim {

namespace {

constexpr double kNearest = 0.01;           // m: antennas do not come closer
constexpr double kPer10Db = 4.34294481903;  // 10 / ln 10

bool overlap(const RadioFrame& a, const RadioFrame& b) { return a.start < b.end && b.start < a.end; }

}  // namespace

RadioMedium::RadioMedium(const RadioDesc& desc, std::uint64_t seed, std::vector<RadioPort*> ports)
    : desc_(desc),
      seed_(desc.seed ? *desc.seed : seed),
      ports_(std::move(ports)),
      waiting_(ports_.size()),
      numbers_(ports_.size(), 0),
      waits_(ports_.size(), 0),
      free_at_(ports_.size(), 0) {}

double RadioMedium::mean_level_db(double distance_m, double power_db) const {
  return power_db + desc_.exponent * kPer10Db * natural_log(desc_.range_m / std::max(distance_m, kNearest));
}

double RadioMedium::distance_m(const Scene& scene, int a, int b, Clicks at) const {
  const Pose2 p = scene.pose(ports_[static_cast<std::size_t>(a)]->robot, at);
  const Pose2 q = scene.pose(ports_[static_cast<std::size_t>(b)]->robot, at);
  return length(Vec2{p.x_m - q.x_m, p.y_m - q.y_m});
}

std::uint64_t RadioMedium::draw_counter(const RadioFrame& frame) const {
  const auto sender = static_cast<std::uint64_t>(ports_[static_cast<std::size_t>(frame.sender)]->robot);
  return sender << 40 | frame.number;
}

double RadioMedium::level_db(const Scene& scene, const RadioFrame& frame, int receiver) const {
  const double mean = mean_level_db(distance_m(scene, frame.sender, receiver, frame.start), frame.power_db);
  if (desc_.model == RadioModel::Disc || desc_.fading_db <= 0) return mean;
  const auto robot = static_cast<std::uint32_t>(ports_[static_cast<std::size_t>(receiver)]->robot);
  return mean + desc_.fading_db * random_gaussian({seed_, robot, kStreamRadioFading}, draw_counter(frame));
}

bool RadioMedium::is_busy(const Scene& scene, int port, Clicks at) const {
  return std::any_of(on_air_.begin(), on_air_.end(), [&](const RadioFrame& f) {
    return f.start <= at && at < f.end && f.sender != port &&
           mean_level_db(distance_m(scene, f.sender, port, at), f.power_db) >= kBusyAboveSensitivityDb;
  });
}

void RadioMedium::contend(const Scene& scene, Clicks now) {
  // A random wait, of the port's own stream.
  const auto wait = [&](std::size_t p, int most) {
    const auto robot = static_cast<std::uint32_t>(ports_[p]->robot);
    const std::uint64_t bits = random_bits({seed_, robot, kStreamRadioWait}, waits_[p]++);
    return kBackoffUnit * static_cast<Clicks>(1 + bits % static_cast<std::uint64_t>(most));
  };
  // the next request of a port, not before its last one is off the air
  const auto take = [&](std::size_t p, Clicks free_at) {
    RadioPort& port = *ports_[p];
    if (waiting_[p].queued || port.outbox.empty()) return;
    Waiting& w = waiting_[p];
    w.request = std::move(port.outbox.front());
    port.outbox.erase(port.outbox.begin());
    w.at = std::max(w.request.at, free_at);
    w.tries = 0;
    w.queued = true;
    if (desc_.carrier_sense) w.at += wait(p, kFirstBackoffUnits);
  };
  for (std::size_t p = 0; p < ports_.size(); ++p) take(p, free_at_[p]);
  // The earliest request of all, again and again.
  for (;;) {
    std::size_t next = ports_.size();
    for (std::size_t p = 0; p < ports_.size(); ++p) {
      if (waiting_[p].queued && waiting_[p].at <= now &&
          (next == ports_.size() || waiting_[p].at < waiting_[next].at))
        next = p;
    }
    if (next == ports_.size()) return;
    Waiting& w = waiting_[next];
    // The channel is in use: it waits once more, or gives up.
    if (desc_.carrier_sense && is_busy(scene, static_cast<int>(next), w.at)) {
      if (++w.tries < kMostTries) {
        w.at += wait(next, kNextBackoffUnits);
        continue;
      }
      ++counters_.given_up;
      w.queued = false;
      free_at_[next] = w.at;
      ports_[next]->on_sent(true, w.at);
    } else {
      // It goes on the air.
      RadioFrame frame;
      frame.sender = static_cast<int>(next);
      frame.number = numbers_[next]++;
      frame.start = w.at + kTurnaround;
      frame.end = frame.start + from_seconds(kRadioOctetS * w.request.air_octets);
      frame.power_db = w.request.power_db;
      frame.bytes = std::move(w.request.bytes);
      ++counters_.sent;
      w.queued = false;
      free_at_[next] = frame.end;
      on_air_.push_back(std::move(frame));
    }
    take(next, free_at_[next]);
  }
}

void RadioMedium::hand_over(const Scene& scene, const RadioFrame& frame, int receiver) {
  RadioPort& port = *ports_[static_cast<std::size_t>(receiver)];
  if (port.listening_since > frame.start) {
    ++counters_.switched_off;
    return;
  }
  // the mean alone, first: most receivers of a large world are far away
  const double mean = mean_level_db(distance_m(scene, frame.sender, receiver, frame.start), frame.power_db);
  constexpr double kMostSigmas = 9;  // a normal number of 53 bits is never larger
  if (mean < -kMostSigmas * desc_.fading_db) {
    ++counters_.out_of_range;
    return;
  }
  // What arrives, with this frame's own fading.
  const double level = level_db(scene, frame, receiver);
  if (level < 0) {
    ++counters_.out_of_range;
    return;
  }
  // Who sends does not hear; else the stronger frame survives, if it is stronger by enough.
  for (const RadioFrame* other : rivals_) {
    if (other->sender == receiver) {
      ++counters_.while_sending;
      return;
    }
  }
  for (const RadioFrame* other : rivals_) {
    const double theirs = level_db(scene, *other, receiver);
    if (desc_.model == RadioModel::Disc && theirs < 0) continue;
    if (level - theirs < desc_.capture_db) {
      ++counters_.by_collision;
      return;
    }
  }
  const RandomKey key{seed_, static_cast<std::uint32_t>(port.robot), kStreamRadioLoss};
  if (desc_.loss > 0 && random_uniform(key, draw_counter(frame)) < desc_.loss) {
    ++counters_.by_chance;
    return;
  }
  ++counters_.delivered;
  port.on_frame(frame, level);
}

void RadioMedium::resolve(const Scene& scene, Clicks now) {
  std::vector<const RadioFrame*> done;
  Clicks oldest_open = now;
  for (const RadioFrame& f : on_air_) {
    if (f.end > now)
      oldest_open = std::min(oldest_open, f.start);
    else if (f.end > resolved_until_)
      done.push_back(&f);
  }
  std::sort(done.begin(), done.end(), [](const RadioFrame* a, const RadioFrame* b) {
    return a->end != b->end ? a->end < b->end : a->sender < b->sender;
  });
  for (const RadioFrame* f : done) {
    rivals_.clear();
    for (const RadioFrame& other : on_air_)
      if (&other != f && overlap(other, *f)) rivals_.push_back(&other);
    for (int r = 0; r < static_cast<int>(ports_.size()); ++r)
      if (r != f->sender) hand_over(scene, *f, r);
    ports_[static_cast<std::size_t>(f->sender)]->on_sent(false, f->end);
  }
  resolved_until_ = now;
  on_air_.erase(std::remove_if(on_air_.begin(), on_air_.end(),
                               [&](const RadioFrame& f) { return f.end <= oldest_open && f.end <= now; }),
                on_air_.end());
}

bool RadioMedium::is_busy() const {
  return !on_air_.empty() ||
         std::any_of(waiting_.begin(), waiting_.end(), [](const Waiting& w) { return w.queued; });
}

void RadioMedium::begin_again(Clicks now) {
  for (RadioPort* port : ports_) port->outbox.clear();
  waiting_.assign(ports_.size(), {});
  numbers_.assign(ports_.size(), 0);
  waits_.assign(ports_.size(), 0);
  free_at_.assign(ports_.size(), now);
  on_air_.clear();
  resolved_until_ = now;
}

void RadioMedium::exchange(const Scene& scene, Clicks now) {
  contend(scene, now);
  if (!on_air_.empty()) resolve(scene, now);
}

}  // namespace sim
