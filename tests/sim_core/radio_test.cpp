// SPDX-License-Identifier: MIT
// The radio channel: its law against distance, collisions, deafness, access to the channel, and independence
// of threads. Expectations are computed here from the law, or by hand.
#include <cmath>
#include <map>

#include "sim_core/radio/radio_medium.h"
#include "tests/sim_core/fixture.h"

namespace {

using namespace sim_test;
using sim::Clicks;
using sim::RadioFrame;
using sim::RadioPort;

constexpr Clicks kTick = sim::kClicksPerSecond / 512;

struct TestPort : RadioPort {
  struct Heard {
    int sender;
    std::uint64_t number;
    Clicks end;
    std::vector<std::uint8_t> bytes;
    double level_db;
  };
  std::vector<Heard> heard;
  int sent = 0, given_up = 0;
  Clicks last_sent = 0;

  void on_frame(const RadioFrame& f, double level_db) override {
    heard.push_back({f.sender, f.number, f.end, f.bytes, level_db});
  }
  void on_sent(bool up, Clicks at) override {
    (up ? given_up : sent) += 1;
    last_sent = at;
  }
  void ask(Clicks at, std::vector<std::uint8_t> bytes, int octets = 100, double power_db = 0) {
    outbox.push_back({at, octets, power_db, std::move(bytes)});
  }
};

/// Robots at rest at chosen places, one port each, all listening.
struct Channel {
  explicit Channel(const sim::RadioDesc& desc, const std::vector<sim::Vec2>& places, std::uint64_t seed = 1) {
    sim::WorldDesc world;
    world.models = {puck()};
    for (const sim::Vec2& place : places) {
      sim::RobotDesc r;
      r.name = "r" + std::to_string(world.robots.size());
      r.pose = {place.x, place.y, 0};
      world.robots.push_back(r);
    }
    simulation = cruising(world, 0, 0);
    std::vector<RadioPort*> pointers;
    for (std::size_t i = 0; i < places.size(); ++i) {
      ports.push_back(std::make_unique<TestPort>());
      ports.back()->robot = static_cast<int>(i);
      ports.back()->listening_since = 0;
      pointers.push_back(ports.back().get());
    }
    auto made = std::make_unique<sim::RadioMedium>(desc, seed, pointers);
    medium = made.get();
    simulation->add(std::move(made));
  }
  void run_ticks(int n) {
    for (int i = 0; i < n; ++i) simulation->step();
  }
  TestPort& port(std::size_t i) { return *ports[i]; }

  std::vector<std::unique_ptr<TestPort>> ports;
  std::unique_ptr<sim::Simulation> simulation;
  sim::RadioMedium* medium = nullptr;
};

sim::RadioDesc plain() {  // sharp edge, no access control
  sim::RadioDesc d;
  d.range_m = 1;
  d.fading_db = 0;
  d.carrier_sense = false;
  return d;
}

TEST(Radio, a_frame_arrives_whole_at_the_tick_after_its_end) {
  Channel c(plain(), {{0, 0}, {0.5, 0}});
  c.port(0).ask(100, {1, 2, 3}, 100);
  // 100 octets of 32 us, after the turnaround of 192 us: 3.392 ms, in the second tick of 1.953 ms
  const Clicks end = 100 + sim::from_seconds(192e-6) + sim::from_seconds(3200e-6);
  c.run_ticks(1);
  EXPECT_TRUE(c.port(1).heard.empty());
  EXPECT_EQ(c.port(0).sent, 0);
  c.run_ticks(1);
  ASSERT_EQ(c.port(1).heard.size(), 1u);
  EXPECT_EQ(c.port(1).heard[0].bytes, (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_EQ(c.port(1).heard[0].end, end);
  EXPECT_EQ(c.port(0).last_sent, end);
  EXPECT_TRUE(c.port(0).heard.empty());
  // half the range: 33 log10 2 = 9.934 dB above the edge
  EXPECT_NEAR(c.port(1).heard[0].level_db, 9.934, 0.001);
}

TEST(Radio, the_range_is_sharp_without_fading_and_shrinks_with_power) {
  // 25 dB at exponent 3.3 shorten 1 m to 10^(-25/33) m = 0.1747 m
  Channel c(plain(), {{0, 0}, {0.17, 0}, {-0.18, 0}, {0, 0.99}, {0, -1.01}});
  c.port(0).ask(0, {9}, 20, -25);
  c.port(0).ask(1, {8}, 20, 0);
  c.run_ticks(3);
  EXPECT_EQ(c.port(1).heard.size(), 2u);
  EXPECT_EQ(c.port(2).heard.size(), 1u);
  EXPECT_EQ(c.port(3).heard.size(), 1u);
  EXPECT_EQ(c.port(4).heard.size(), 0u);
  EXPECT_EQ(c.medium->counters().out_of_range, 3 + 1);
  EXPECT_EQ(c.medium->counters().delivered, 1 + 3);
}

TEST(Radio, frames_that_overlap_are_both_lost_at_a_receiver_between) {
  Channel c(plain(), {{0, 0}, {0.4, 0}, {0.8, 0}});  // 0 and 2 as loud as one another at 1
  c.port(0).ask(0, {1});
  c.port(2).ask(sim::from_seconds(0.003), {2});  // the last 0.2 ms of the first
  c.run_ticks(5);
  EXPECT_TRUE(c.port(1).heard.empty());
  EXPECT_EQ(c.medium->counters().by_collision, 2);
  EXPECT_EQ(c.medium->counters().while_sending, 2);  // 0 and 2 do not hear each other
  EXPECT_EQ(c.medium->counters().delivered, 0);
}

TEST(Radio, the_stronger_of_two_survives_by_the_capture_ratio) {
  // at 1: 0.1 m against 0.7 m, 33 log10 7 = 27.9 dB apart
  const std::vector<sim::Vec2> places{{0, 0}, {0.1, 0}, {0.8, 0}};
  Channel near(plain(), places);
  near.port(0).ask(0, {1});
  near.port(2).ask(0, {2});
  near.run_ticks(4);
  ASSERT_EQ(near.port(1).heard.size(), 1u);
  EXPECT_EQ(near.port(1).heard[0].sender, 0);
  sim::RadioDesc none = plain();
  none.capture_db = 28;
  Channel strict(none, places);
  strict.port(0).ask(0, {1});
  strict.port(2).ask(0, {2});
  strict.run_ticks(4);
  EXPECT_TRUE(strict.port(1).heard.empty());
  EXPECT_EQ(strict.medium->counters().by_collision, 2);
}

TEST(Radio, frames_one_after_the_other_do_not_collide) {
  Channel c(plain(), {{0, 0}, {0.4, 0}, {0.8, 0}});
  c.port(0).ask(0, {1});
  c.port(2).ask(sim::from_seconds(0.0032), {2});  // begins in the instant in which the first is over
  c.run_ticks(5);
  ASSERT_EQ(c.port(1).heard.size(), 2u);
  EXPECT_EQ(c.port(1).heard[0].sender, 0);
  EXPECT_EQ(c.port(1).heard[1].sender, 2);
}

TEST(Radio, who_is_switched_off_or_switches_on_meanwhile_hears_nothing) {
  Channel c(plain(), {{0, 0}, {0.1, 0}, {0.2, 0}});
  c.port(1).listening_since = RadioPort::kOff;
  c.port(2).listening_since = sim::from_seconds(0.001);
  c.port(0).ask(0, {1});
  c.port(0).ask(sim::from_seconds(0.005), {2});
  c.run_ticks(8);
  EXPECT_TRUE(c.port(1).heard.empty());
  ASSERT_EQ(c.port(2).heard.size(), 1u);
  EXPECT_EQ(c.port(2).heard[0].bytes[0], 2);
  EXPECT_EQ(c.medium->counters().switched_off, 3);
}

TEST(Radio, who_listens_first_waits_for_the_other) {
  sim::RadioDesc d = plain();
  d.carrier_sense = true;
  d.capture_db = 1000;
  Channel c(d, {{0, 0}, {0.1, 0}, {0.05, 0.05}});
  // 1 asks in the middle of 0's frame: after at most 16 waits of 0.32 ms and 0.192 ms it is on
  // the air 5.3 ms at most
  c.port(0).ask(0, {1}, 300);
  c.run_ticks(4);  // 7.8 ms: 0 sends until 9.6 ms or later
  c.port(1).ask(4 * kTick, {2}, 20);
  c.run_ticks(40);
  ASSERT_EQ(c.port(2).heard.size(), 2u);
  EXPECT_EQ(c.port(2).heard[0].sender, 0);
  EXPECT_EQ(c.port(2).heard[1].sender, 1);
  EXPECT_EQ(c.medium->counters().by_collision, 0);
}

TEST(Radio, a_channel_that_stays_busy_makes_it_give_up) {
  sim::RadioDesc d = plain();
  d.carrier_sense = true;
  Channel c(d, {{0, 0}, {0.1, 0}});
  c.port(0).ask(0, {1}, 20000);  // 0.64 s; eight looks take at most 7 * 20.5 + 5.1 ms
  c.run_ticks(6);
  c.port(1).ask(6 * kTick, {2}, 20);
  c.run_ticks(100);
  EXPECT_EQ(c.port(1).given_up, 1);
  EXPECT_EQ(c.medium->counters().given_up, 1);
}

/// Share of the frames that arrive at a distance: the level's mean against a normal fading.
double law(const sim::RadioDesc& d, double distance_m) {
  const double mean = 10 * d.exponent * std::log10(d.range_m / distance_m);
  return (1 - d.loss) * 0.5 * std::erfc(-mean / d.fading_db / std::sqrt(2.0));
}

TEST(Radio, a_hundred_robots_deliver_against_distance_as_the_law_says) {
  sim::RadioDesc d;
  d.range_m = 1.5;
  d.exponent = 3;
  d.fading_db = 4;
  d.loss = 0.1;
  d.carrier_sense = false;
  std::vector<sim::Vec2> places;
  for (int i = 0; i < 100; ++i) places.push_back({0.4 * (i % 10), 0.4 * (i / 10)});
  Channel c(d, places, 7);
  // one at a time, so that nothing but range and chance decides: 60 rounds of 100 frames
  const int rounds = 60;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < 100; ++i) {
      c.port(i).ask(c.simulation->now(), {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(round)},
                    20);
      c.run_ticks(1);
    }
  }
  std::map<long, std::pair<long, long>> bins;  // squared grid distance -> arrived, tried
  for (std::size_t from = 0; from < 100; ++from)
    for (std::size_t to = 0; to < 100; ++to) {
      if (from == to) continue;
      const long dx = static_cast<long>(from % 10) - static_cast<long>(to % 10);
      const long dy = static_cast<long>(from / 10) - static_cast<long>(to / 10);
      bins[dx * dx + dy * dy].second += rounds;
    }
  for (std::size_t to = 0; to < 100; ++to) {
    std::map<int, int> last;
    for (const TestPort::Heard& h : c.port(to).heard) {
      ASSERT_EQ(h.bytes.size(), 2u);
      EXPECT_EQ(h.bytes[0], h.sender);
      // in order: each sender's rounds grow
      const auto found = last.find(h.sender);
      if (found != last.end()) {
        EXPECT_GT(h.bytes[1], found->second);
      }
      last[h.sender] = h.bytes[1];
      const long dx = h.sender % 10 - static_cast<long>(to % 10);
      const long dy = h.sender / 10 - static_cast<long>(to / 10);
      ++bins[dx * dx + dy * dy].first;
    }
  }
  // each bin within 4.5 standard deviations: one of the 50 bins falls out by chance in 3000 runs
  for (const auto& [squared, count] : bins) {
    const double p = law(d, 0.4 * std::sqrt(static_cast<double>(squared)));
    const double n = static_cast<double>(count.second);
    const double sigma = std::sqrt(std::max(n * p * (1 - p), 1.0));
    EXPECT_NEAR(static_cast<double>(count.first), n * p, 4.5 * sigma)
        << "at " << 0.4 * std::sqrt(squared) << " m";
  }
  const sim::RadioCounters& k = c.medium->counters();
  EXPECT_EQ(k.sent, rounds * 100);
  EXPECT_EQ(k.by_collision + k.while_sending + k.switched_off, 0);
  EXPECT_EQ(k.delivered + k.out_of_range + k.by_chance, k.sent * 99);
  // chance takes a tenth of what is in range
  const double in_range = static_cast<double>(k.delivered + k.by_chance);
  EXPECT_NEAR(static_cast<double>(k.by_chance) / in_range, 0.1, 4.5 * std::sqrt(0.09 / in_range));
}

TEST(Radio, a_hundred_robots_at_once_collide_and_every_pair_is_counted) {
  for (const bool sense : {false, true}) {
    sim::RadioDesc d;
    d.carrier_sense = sense;
    std::vector<sim::Vec2> places;
    for (int i = 0; i < 100; ++i) places.push_back({0.1 * (i % 10), 0.1 * (i / 10)});
    Channel c(d, places);
    for (std::size_t i = 0; i < 100; ++i) c.port(i).ask(0, {static_cast<std::uint8_t>(i)}, 40);
    c.run_ticks(600);
    const sim::RadioCounters& k = c.medium->counters();
    EXPECT_EQ(k.sent + k.given_up, 100);
    EXPECT_EQ(k.delivered + k.out_of_range + k.by_chance + k.by_collision + k.while_sending + k.switched_off,
              k.sent * 99);
    if (!sense) {
      EXPECT_EQ(k.while_sending, 100 * 99);  // all deaf: all send in the same 1.3 ms
    } else {
      EXPECT_GT(k.delivered, 99);
      EXPECT_GT(k.by_collision, 0);  // who looks within another's turnaround of 0.192 ms
    }
  }
}

}  // namespace
