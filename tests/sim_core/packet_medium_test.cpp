// SPDX-License-Identifier: MIT
// The packet medium's semantics: who hears what, when, from where.
#include "sim_core/radio/packet_medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim_core/world/scene.h"
#include "tests/sim_core/fixture.h"

namespace sim {
namespace {

/// An end that hears one channel and keeps everything.
struct End : PacketPort {
  End(int robot_index, int on_channel) : channel(on_channel) { robot = robot_index; }
  bool listens(int c) const override { return c == kAllChannels || channel == kAllChannels || c == channel; }
  void on_packet(const ReceivedPacket& packet) override { got.push_back(packet); }
  void on_left(const Packet& packet) override { left += packet.bytes.size(); }
  void say(const std::string& text, int on_channel, double range_m = -1, bool infra_red = false) {
    Packet packet;
    packet.channel = on_channel;
    packet.range_m = range_m;
    packet.infra_red = infra_red;
    packet.bytes.assign(text.begin(), text.end());
    packet.at = at;
    packet.emitter = emitter;
    packet.baud_rate_bit_s = baud_rate_bit_s;
    send(packet);
  }
  std::string text(std::size_t i) const { return {got[i].bytes.begin(), got[i].bytes.end()}; }
  int channel;
  std::size_t left = 0;
  Clicks at = 0;
  double baud_rate_bit_s = -1;
  int emitter = 0;
  std::vector<ReceivedPacket> got;
};

/// Robots in a row: 0 at the origin looking east, 1 a metre east looking north, 2 two
/// metres west looking east.
class PacketMediumTest : public ::testing::Test {
 protected:
  PacketMediumTest() {
    world.models = {sim_test::puck()};
    world.robots.resize(3);
    world.robots[1].pose = {1, 0, kPi / 2};
    world.robots[2].pose = {-2, 0, 0};
  }
  void exchange(double at_s = 0.002) {
    if (!scene) {
      scene = std::make_unique<Scene>(world, std::vector<double>(3, 0.1));
      for (End* end : {&a, &b, &c, &tower}) medium.add(*end);
    }
    medium.exchange(*scene, from_seconds(at_s));
  }
  WorldDesc world;
  std::unique_ptr<Scene> scene;
  PacketMedium medium;
  End a{0, 1}, b{1, 1}, c{2, 2}, tower{-1, kAllChannels};
};

TEST_F(PacketMediumTest, in_one_place_there_is_no_direction) {
  world.robots[1].pose = {};
  a.say("here", 1);
  exchange();
  ASSERT_EQ(b.got.size(), 1u);
  for (const double along : {b.got[0].direction.x, b.got[0].direction.y, b.got[0].direction.z})
    EXPECT_TRUE(std::isfinite(along));
  EXPECT_TRUE(std::isfinite(b.got[0].strength));
}

TEST_F(PacketMediumTest, a_packet_reaches_its_channel_and_never_its_sender) {
  a.say("hello", 1);
  exchange();
  EXPECT_TRUE(a.got.empty());
  ASSERT_EQ(b.got.size(), 1u);
  EXPECT_EQ(b.text(0), "hello");
  EXPECT_EQ(b.got[0].from_robot, 0);
  EXPECT_EQ(b.got[0].channel, 1);
  EXPECT_EQ(b.got[0].delivered, from_seconds(0.002));
  EXPECT_TRUE(c.got.empty());
  EXPECT_EQ(tower.got.size(), 1u);  // hears all
  EXPECT_EQ(a.left, 5u);
}

TEST_F(PacketMediumTest, a_broadcast_reaches_everybody_else) {
  c.say("all", kAllChannels);
  exchange();
  EXPECT_EQ(a.got.size() + b.got.size() + tower.got.size(), 3u);
  EXPECT_TRUE(c.got.empty());
}

TEST_F(PacketMediumTest, packets_keep_their_order) {
  a.say("1", 1);
  a.say("2", 2);
  a.say("3", 1);
  exchange();
  ASSERT_EQ(b.got.size(), 2u);
  EXPECT_EQ(b.text(0) + b.text(1), "13");
  ASSERT_EQ(tower.got.size(), 3u);
  EXPECT_EQ(tower.text(0) + tower.text(1) + tower.text(2), "123");
}

// b is 1 m east of a and looks north, so a lies to its left; c is 2 m away
TEST_F(PacketMediumTest, strength_and_direction_are_those_of_the_geometry) {
  c.channel = 1;
  a.say("x", 1);
  exchange();
  ASSERT_EQ(b.got.size(), 1u);
  EXPECT_DOUBLE_EQ(b.got[0].strength, 1);
  EXPECT_NEAR(b.got[0].direction.x, 0, 1e-12);
  EXPECT_NEAR(b.got[0].direction.y, 1, 1e-12);
  ASSERT_EQ(c.got.size(), 1u);
  EXPECT_DOUBLE_EQ(c.got[0].strength, 0.25);
  EXPECT_NEAR(c.got[0].direction.x, 1, 1e-12);
  EXPECT_DOUBLE_EQ(tower.got[0].strength, 1);  // it has no place
}

// a supervisor is nowhere, whoever of the two it is
TEST_F(PacketMediumTest, an_end_without_a_place_has_no_direction) {
  world.robots[0].pose = {3, 4, 1};
  a.say("up", 1, 0.01);
  tower.say("down", 1, 0.01);
  exchange();
  ASSERT_EQ(tower.got.size(), 1u);
  ASSERT_EQ(a.got.size(), 1u);
  for (const End* end : {&tower, &a}) {
    EXPECT_EQ(end->got[0].strength, 1);
    EXPECT_EQ(end->got[0].direction.x, Vec3().x);
    EXPECT_EQ(end->got[0].direction.y, Vec3().y);
    EXPECT_EQ(end->got[0].direction.z, Vec3().z);
  }
  EXPECT_TRUE(b.got.size() == 1 && b.text(0) == "down") << "a metre away it does not hear the robot";
}

TEST_F(PacketMediumTest, the_range_ends_at_its_distance_and_binds_places_only) {
  c.channel = 1;
  a.say("near", 1, 1.0);
  a.say("nearer", 1, 0.99);
  exchange();
  ASSERT_EQ(b.got.size(), 1u);
  EXPECT_EQ(b.text(0), "near");
  EXPECT_TRUE(c.got.empty());
  EXPECT_EQ(tower.got.size(), 2u);
}

// robot 1 stands on a ramp, 0.3 m higher than robot 0: what lies between them is longer than on the floor
TEST_F(PacketMediumTest, heights_count_in_distance_and_direction) {
  RampDesc ramp;
  ramp.pose = {1, 0, 0};
  ramp.size_m = {0.4, 0.4};
  ramp.low_m = ramp.high_m = 0.3;
  world.ramps.push_back(ramp);
  a.say("short", 1, 1.0);
  a.say("long", 1, 1.05);
  exchange();
  ASSERT_EQ(b.got.size(), 1u);
  EXPECT_EQ(b.text(0), "long");
  EXPECT_NEAR(b.got[0].strength, 1 / 1.09, 1e-6);  // 1 + 0.3 * 0.3
  EXPECT_NEAR(b.got[0].direction.z, -0.3 / std::sqrt(1.09), 1e-6);
}

TEST_F(PacketMediumTest, walls_stop_infra_red_and_not_radio) {
  WallDesc wall;
  wall.points_m = {{0.5, -0.2}, {0.5, 0.2}};
  world.walls.push_back(wall);
  c.channel = 1;
  a.say("light", 1, -1, true);
  a.say("radio", 1, -1, false);
  exchange();
  ASSERT_EQ(b.got.size(), 1u);
  EXPECT_EQ(b.text(0), "radio");
  EXPECT_EQ(c.got.size(), 2u);  // nothing between a and c
}

TEST_F(PacketMediumTest, a_robot_in_between_stops_infra_red) {
  b.say("over there", 2, -1, true);  // a stands between b and c
  exchange();
  EXPECT_TRUE(c.got.empty());
}

// 8000 bit/s: 10 bytes take 10 ms; the second packet waits for the first, and both ways the
// queue empties only then
TEST_F(PacketMediumTest, a_baud_rate_delays_packets_one_after_the_other) {
  a.baud_rate_bit_s = 8000;
  a.at = from_seconds(0.001);
  a.say("0123456789", 1);
  a.say("9876543210", 1);
  exchange(0.010);
  EXPECT_TRUE(b.got.empty());
  EXPECT_EQ(a.left, 0u);
  exchange(0.012);
  ASSERT_EQ(b.got.size(), 1u);
  EXPECT_EQ(a.left, 10u);
  exchange(0.020);
  EXPECT_EQ(b.got.size(), 1u);
  exchange(0.022);
  ASSERT_EQ(b.got.size(), 2u);
  EXPECT_EQ(b.text(1), "9876543210");
}

TEST_F(PacketMediumTest, emitters_of_one_robot_do_not_wait_for_each_other) {
  a.at = from_seconds(0.001);
  a.baud_rate_bit_s = 800;
  a.say("slow", 1);  // 40 ms
  a.emitter = 1;
  a.baud_rate_bit_s = 80000;
  a.say("fast", 1);
  exchange(0.003);
  ASSERT_EQ(b.got.size(), 1u);
  EXPECT_EQ(b.text(0), "fast");
  a.emitter = 0;
  a.baud_rate_bit_s = 80000;
  a.say("next", 1);  // behind what its own emitter has not sent yet
  exchange(0.005);
  EXPECT_EQ(b.got.size(), 1u);
  exchange(0.050);
  ASSERT_EQ(b.got.size(), 3u);
  EXPECT_EQ(b.text(1), "slow");
  EXPECT_EQ(b.text(2), "next");
}

}  // namespace
}  // namespace sim
