// SPDX-License-Identifier: MIT
// Short-range links: latency, bandwidth, range, drop-outs by list and by chance, loss of a link.
#include "sim_core/radio/link_medium.h"
#include "tests/sim_core/fixture.h"

namespace {

using namespace sim_test;
using sim::Clicks;
using sim::LinkMessage;
using sim::LinkPort;

constexpr double kTickS = 1.0 / 512;

struct TestEnd : LinkPort {
  std::vector<std::pair<LinkMessage, Clicks>> got;
  std::vector<Clicks> lost;
  void on_message(const LinkMessage& m, Clicks now) override { got.push_back({m, now}); }
  void on_link_lost(Clicks now) override { lost.push_back(now); }
  void say(Clicks at, int to, int bytes, bool reliable = true) {
    LinkMessage m;
    m.at = at;
    m.to = to;
    m.reliable = reliable;
    m.bytes.assign(static_cast<std::size_t>(bytes), 1);
    send(std::move(m));
  }
};

struct Links {
  explicit Links(const sim::LinkDesc& desc, std::vector<double> x_m,
                 std::vector<std::vector<sim::Dropout>> own = {}) {
    sim::WorldDesc world;
    world.models = {puck()};
    std::vector<LinkPort*> pointers;
    for (double x : x_m) {
      sim::RobotDesc r;
      r.name = "r" + std::to_string(world.robots.size());
      r.pose = {x, 0, 0};
      ends.push_back(std::make_unique<TestEnd>());
      ends.back()->robot = static_cast<int>(world.robots.size());
      pointers.push_back(ends.back().get());
      world.robots.push_back(r);
    }
    simulation = cruising(world, 0, 0);
    simulation->add(std::make_unique<sim::LinkMedium>(desc, 5, pointers, std::move(own)));
  }
  TestEnd& end(std::size_t i) { return *ends[i]; }
  std::vector<std::unique_ptr<TestEnd>> ends;
  std::unique_ptr<sim::Simulation> simulation;
};

sim::LinkDesc plain() {
  sim::LinkDesc d;
  d.latency_s = 0.020;
  d.bandwidth_bit_s = 8000;  // a byte takes 1 ms
  d.timeout_s = 1;
  return d;
}

TEST(Link, latency_and_bandwidth_add_up) {
  Links l(plain(), {0, 1});
  l.end(0).say(0, 1, 100);  // 100 ms and 20 ms
  l.end(0).say(0, 1, 50);   // behind it: 150 ms and 20 ms
  l.end(1).say(0, 0, 10);   // the other way is free: 30 ms
  run_for(*l.simulation, 0.3);
  ASSERT_EQ(l.end(1).got.size(), 2u);
  ASSERT_EQ(l.end(0).got.size(), 1u);
  // seen at the first tick that is not earlier
  EXPECT_NEAR(sim::to_seconds(l.end(1).got[0].second), 0.120 + kTickS / 2, kTickS / 2 + 1e-6);
  EXPECT_NEAR(sim::to_seconds(l.end(1).got[1].second), 0.170 + kTickS / 2, kTickS / 2 + 1e-6);
  EXPECT_NEAR(sim::to_seconds(l.end(0).got[0].second), 0.030 + kTickS / 2, kTickS / 2 + 1e-6);
  EXPECT_EQ(l.end(1).got[0].first.from, 0);
  EXPECT_EQ(l.end(1).got[0].first.bytes.size(), 100u);
}

TEST(Link, everybody_in_range_hears_a_call) {
  Links l(plain(), {0, 9.9, 10.1, -5});
  l.end(0).say(0, LinkMessage::kEverybody, 1, false);
  run_for(*l.simulation, 0.1);
  EXPECT_EQ(l.end(0).got.size(), 0u);
  EXPECT_EQ(l.end(1).got.size(), 1u);
  EXPECT_EQ(l.end(2).got.size(), 0u);
  EXPECT_EQ(l.end(3).got.size(), 1u);
}

TEST(Link, a_dropout_holds_reliable_messages_and_loses_others) {
  sim::LinkDesc d = plain();
  d.dropouts = {{0.5, 0.4}};
  Links l(d, {0, 1});
  run_for(*l.simulation, 0.6);
  l.end(0).say(l.simulation->now(), 1, 1, false);
  l.end(0).say(l.simulation->now(), 1, 2, true);
  l.end(0).say(l.simulation->now(), 1, 3, true);
  run_for(*l.simulation, 0.3 - 2 * kTickS);
  EXPECT_TRUE(l.end(1).got.empty());
  run_for(*l.simulation, 0.1);
  ASSERT_EQ(l.end(1).got.size(), 2u);
  EXPECT_EQ(l.end(1).got[0].first.bytes.size(), 2u);
  EXPECT_EQ(l.end(1).got[1].first.bytes.size(), 3u);
}

TEST(Link, a_robots_own_dropout_concerns_its_links_alone) {
  Links l(plain(), {0, 1, 2}, {{}, {{0.1, 10}}, {}});
  run_for(*l.simulation, 0.2);
  l.end(0).say(l.simulation->now(), 1, 1);
  l.end(0).say(l.simulation->now(), 2, 1);
  run_for(*l.simulation, 0.2);
  EXPECT_TRUE(l.end(1).got.empty());
  EXPECT_EQ(l.end(2).got.size(), 1u);
  EXPECT_TRUE(l.end(1).blocked);
  EXPECT_FALSE(l.end(0).blocked);
}

TEST(Link, a_silence_beyond_the_timeout_ends_a_link) {
  sim::LinkDesc d = plain();
  d.dropouts = {{1, 0.9}, {3, 1.2}};
  Links l(d, {0, 1});
  l.end(0).say(0, 1, 1);
  l.end(0).peer = 1;
  l.end(1).peer = 0;
  run_for(*l.simulation, 3.9);
  EXPECT_TRUE(l.end(0).lost.empty());  // 0.9 s: the link stood still
  l.end(0).say(l.simulation->now(), 1, 1);
  run_for(*l.simulation, 1);
  ASSERT_EQ(l.end(0).lost.size(), 1u);
  ASSERT_EQ(l.end(1).lost.size(), 1u);
  EXPECT_NEAR(sim::to_seconds(l.end(1).lost[0]), 4, 2 * kTickS);
  EXPECT_EQ(l.end(0).peer, LinkPort::kNobody);
  EXPECT_EQ(l.end(1).peer, LinkPort::kNobody);
  EXPECT_EQ(l.end(1).got.size(), 1u);  // what was under way is gone
}

TEST(Link, who_drives_out_of_range_loses_the_link) {
  sim::LinkDesc d = plain();
  d.timeout_s = 0.1;
  Links l(d, {0, 1});
  l.end(0).say(0, 1, 1);
  l.end(0).peer = 1;
  l.end(1).peer = 0;
  run_for(*l.simulation, 0.5);
  l.simulation->move(1, {11, 0, 0});
  run_for(*l.simulation, 0.2);
  EXPECT_EQ(l.end(0).lost.size(), 1u);
}

TEST(Link, dropouts_by_chance_take_their_share_of_the_time) {
  sim::LinkDesc d = plain();
  d.dropout_rate_hz = 0.5;
  d.dropout_span_s = 0.5;
  Links l(d, std::vector<double>(40, 0.0));
  // gaps of 2 s on average, then 0.5 s: a fifth of the time
  double blocked = 0;
  const int ticks = 512 * 25;
  for (int i = 0; i < ticks; ++i) {
    l.simulation->step();
    for (const auto& e : l.ends) blocked += e->blocked;
  }
  // 40 robots with about ten drop-outs each: the share's standard deviation is 0.2 * 0.8 / sqrt(400) = 0.008
  EXPECT_NEAR(blocked / (40.0 * ticks), 0.2, 0.03);
}

std::string complaint(const std::string& toml) {
  const sim::LoadedWorld loaded = sim::parse_world("twinpuck = 1\n" + toml, "w.toml", {puck()});
  return loaded.world ? "none" : loaded.report("w.toml");
}

TEST(Link, keys_of_a_world_file_reach_their_places) {
  const sim::WorldDesc w = world_of(R"(twinpuck = 1
[radio]
model = "disc"
range = 2.5
loss = 0.25
capture = 1000
carrier_sense = false
seed = 77
[bluetooth]
latency = 0.1
dropouts = [[1, 2], [5, 0.5]]
dropout_rate = 0.01
[[robot]]
[robot.bluetooth]
number = 2087
pin = "77"
dropouts = [[9, 1]]
)");
  EXPECT_EQ(w.radio.model, sim::RadioModel::Disc);
  EXPECT_EQ(w.radio.range_m, 2.5);
  EXPECT_EQ(w.radio.loss, 0.25);
  EXPECT_EQ(w.radio.capture_db, 1000);
  EXPECT_FALSE(w.radio.carrier_sense);
  EXPECT_EQ(w.radio.seed, 77u);
  EXPECT_EQ(w.link.latency_s, 0.1);
  ASSERT_EQ(w.link.dropouts.size(), 2u);
  EXPECT_EQ(w.link.dropouts[1].begin_s, 5);
  EXPECT_EQ(w.link.dropouts[1].span_s, 0.5);
  EXPECT_EQ(w.link.dropout_rate_hz, 0.01);
  EXPECT_EQ(w.robots[0].link.number, 2087);
  EXPECT_EQ(w.robots[0].link.pin, "77");
  EXPECT_FALSE(w.robots[0].link.name);
  EXPECT_EQ(w.robots[0].link.dropouts[0].begin_s, 9);
}

TEST(Link, bad_keys_say_what_is_wrong_and_where) {
  EXPECT_EQ(complaint("[bluetooth]\ndropouts = [[3, 2], [4, 1]]\n"),
            "w.toml:3:12: bluetooth.dropouts: got a beginning at 4 s, expected it after the one before has "
            "ended (5 s)");
  EXPECT_EQ(complaint("[bluetooth]\ndropouts = [[3, 0]]\n"),
            "w.toml:3:12: bluetooth.dropouts: got a length of 0 s, expected more than 0");
  EXPECT_EQ(complaint("[radio]\nrange = -1\n"),
            "w.toml:3:9: radio.range: got -1, expected number from 0.01 to 10000 m");
  EXPECT_EQ(
      complaint("[radio]\nmodel = \"disk\"\n"),
      "w.toml:3:9: radio.model: got \"disk\", expected one of log-distance, disc; did you mean 'disc'?");
  EXPECT_EQ(complaint("[[robot]]\n[robot.bluetooth]\npin = \"\"\n"),
            "w.toml:4:7: robot.bluetooth.pin: got 0 characters, expected 1 to 16");
  // the second robot's place in the file is 2, too
  EXPECT_EQ(complaint("[[robot]]\n[robot.bluetooth]\nnumber = 2\n[[robot]]\nposition = [1, 0]\n"),
            "w.toml:5:1: robot.bluetooth.number: got 2 a second time (first on line 2; robots without one "
            "have their place in the file), expected a number of its own");
}

}  // namespace
