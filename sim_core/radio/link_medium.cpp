// SPDX-License-Identifier: MIT
// Ways are kept in order of (sender, receiver), and what arrives in one tick is handed over in order of
// arrival, so that nothing depends on addresses or threads.
#include "sim_core/radio/link_medium.h"

#include <algorithm>

#include "sim_core/base/portable_math.h"
#include "sim_core/radio/radio_params.h"
#include "sim_core/random/counter_random.h"
#include "sim_core/world/scene.h"

namespace sim {

namespace {

bool covers(const std::vector<Dropout>& list, Clicks at) {
  return std::any_of(list.begin(), list.end(), [&](const Dropout& d) {
    const Clicks begin = from_seconds(d.begin_s);
    return begin <= at && at < begin + from_seconds(d.span_s);
  });
}

}  // namespace

LinkMedium::LinkMedium(const LinkDesc& desc, std::uint64_t seed, std::vector<LinkPort*> ports,
                       std::vector<std::vector<Dropout>> own_dropouts)
    : desc_(desc),
      seed_(seed),
      ports_(std::move(ports)),
      own_dropouts_(std::move(own_dropouts)),
      by_chance_(ports_.size()) {
  own_dropouts_.resize(ports_.size());
  has_dropouts_ =
      !desc_.dropouts.empty() || desc_.dropout_rate_hz > 0 ||
      std::any_of(own_dropouts_.begin(), own_dropouts_.end(), [](const auto& l) { return !l.empty(); });
  for (LinkPort* port : ports_) port->somebody_sends_ = &somebody_sends_;
}

bool LinkMedium::drops_out(std::size_t port, Clicks at) {
  if (covers(desc_.dropouts, at) || covers(own_dropouts_[port], at)) return true;
  if (desc_.dropout_rate_hz <= 0) return false;
  ByChance& c = by_chance_[port];
  while (c.end <= at) {  // the gaps between them are exponential
    const RandomKey key{seed_, static_cast<std::uint32_t>(ports_[port]->robot), kStreamLinkDropout};
    const double gap_s = -natural_log(1 - random_uniform(key, c.drawn++)) / desc_.dropout_rate_hz;
    c.begin = c.end + from_seconds(gap_s);
    c.end = c.begin + from_seconds(desc_.dropout_span_s);
  }
  return c.begin <= at;
}

bool LinkMedium::is_blocked(const Scene& scene, int a, int b) const {
  const LinkPort& p = *ports_[static_cast<std::size_t>(a)];
  const LinkPort& q = *ports_[static_cast<std::size_t>(b)];
  if (p.blocked || q.blocked) return true;
  const Pose2& here = scene.state(p.robot).pose;
  const Pose2& there = scene.state(q.robot).pose;
  return length(Vec2{here.x_m - there.x_m, here.y_m - there.y_m}) > desc_.range_m;
}

void LinkMedium::take_outboxes(Clicks now) {
  const Clicks latency = from_seconds(desc_.latency_s);
  const auto put = [&](LinkMessage message) {
    Way& way = ways_[{message.from, message.to}];
    const double bits = 8.0 * static_cast<double>(message.bytes.size());
    const Clicks begin = std::max(std::min(message.at, now), way.free_at);
    way.free_at = begin + from_seconds(message.reliable ? bits / desc_.bandwidth_bit_s : 0);
    const Clicks arrival = way.free_at + latency;
    way.messages.push_back({std::move(message), arrival});
  };
  for (int p = 0; p < static_cast<int>(ports_.size()); ++p) {
    std::vector<LinkMessage>& outbox = ports_[static_cast<std::size_t>(p)]->outbox_;
    for (LinkMessage& message : outbox) {
      message.from = p;
      if (message.to != LinkMessage::kEverybody) {
        put(std::move(message));
        continue;
      }
      for (int q = 0; q < static_cast<int>(ports_.size()); ++q) {
        if (q == p) continue;
        LinkMessage copy = message;
        copy.to = q;
        put(std::move(copy));
      }
    }
    outbox.clear();
  }
}

void LinkMedium::deliver(const Scene& scene, Clicks now) {
  std::vector<UnderWay> due;
  for (auto it = ways_.begin(); it != ways_.end();) {
    Way& way = it->second;
    const bool blocked = is_blocked(scene, it->first.first, it->first.second);
    if (blocked) {  // what is not reliable is lost; for the rest time stands still
      way.messages.erase(std::remove_if(way.messages.begin(), way.messages.end(),
                                        [](const UnderWay& u) { return !u.message.reliable; }),
                         way.messages.end());
      for (UnderWay& u : way.messages) u.arrival += now - last_;
      way.free_at += now - last_;
    }
    while (!way.messages.empty() && way.messages.front().arrival <= now) {
      due.push_back(std::move(way.messages.front()));
      way.messages.pop_front();
    }
    it = way.messages.empty() && way.free_at <= now ? ways_.erase(it) : std::next(it);
  }
  std::stable_sort(due.begin(), due.end(),
                   [](const UnderWay& a, const UnderWay& b) { return a.arrival < b.arrival; });
  for (const UnderWay& u : due) ports_[static_cast<std::size_t>(u.message.to)]->on_message(u.message, now);
}

void LinkMedium::supervise(const Scene& scene, Clicks now) {
  has_links_ = false;
  for (int p = 0; p < static_cast<int>(ports_.size()); ++p) {
    LinkPort& port = *ports_[static_cast<std::size_t>(p)];
    const int q = port.peer;
    if (q < 0) continue;
    has_links_ = true;
    if (q < p && ports_[static_cast<std::size_t>(q)]->peer == p) continue;  // each link once
    const std::pair<int, int> link{std::min(p, q), std::max(p, q)};
    if (!is_blocked(scene, p, q)) {
      silent_since_.erase(link);
      continue;
    }
    const Clicks since = silent_since_.emplace(link, now).first->second;
    if (now - since < from_seconds(desc_.timeout_s)) continue;
    silent_since_.erase(link);
    ways_.erase({p, q});
    ways_.erase({q, p});
    LinkPort& other = *ports_[static_cast<std::size_t>(q)];
    port.peer = LinkPort::kNobody;
    port.on_link_lost(now);
    if (other.peer == p) {
      other.peer = LinkPort::kNobody;
      other.on_link_lost(now);
    }
  }
}

void LinkMedium::begin_again(Clicks now) {
  for (LinkPort* port : ports_) port->outbox_.clear();
  somebody_sends_ = false;
  by_chance_.assign(ports_.size(), {});
  ways_.clear();
  silent_since_.clear();
  has_links_ = false;
  begun_ = last_ = now;
}

void LinkMedium::exchange(const Scene& scene, Clicks now) {
  last_ = std::max(last_, now - scene.tick_clicks());  // nothing was under way before
  if (has_dropouts_)
    for (std::size_t p = 0; p < ports_.size(); ++p) ports_[p]->blocked = drops_out(p, now - begun_);
  const bool sends = somebody_sends_.exchange(false, std::memory_order_relaxed);
  if (sends) take_outboxes(now);
  // links come about by messages, so nothing can be linked where nothing was ever sent
  if (sends || !ways_.empty() || has_links_) {
    deliver(scene, now);
    supervise(scene, now);
  }
  last_ = now;
}

}  // namespace sim
