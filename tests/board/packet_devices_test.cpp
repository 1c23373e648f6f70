// SPDX-License-Identifier: MIT
// Emitters and receivers of a robot: what a program sets, what a queue holds, and that all begins anew.
#include "hal_sim/board/packet_devices.h"

#include <gtest/gtest.h>

namespace {

using board::PacketDevices;

sim::DeviceDesc device(sim::DeviceKind kind, const char* name, int channel, double range_m = -1) {
  sim::DeviceDesc desc;
  desc.kind = kind;
  desc.name = name;
  desc.channel = channel;
  desc.range_m = range_m;
  return desc;
}

struct PacketDevicesTest : testing::Test {
  sim::ReceivedPacket packet(int channel, int bytes) {
    sim::ReceivedPacket made;
    made.channel = channel;
    made.bytes.resize(static_cast<std::size_t>(bytes));
    return made;
  }
  const board::RobotClock clock;
  PacketDevices devices{
      clock,
      3,
      {device(sim::DeviceKind::Emitter, "far", 5, 2), device(sim::DeviceKind::Receiver, "receiver", 6)}};
};

TEST_F(PacketDevicesTest, named_ones_come_beside_the_usual_ones_or_are_them) {
  ASSERT_EQ(devices.emitters(), 2);
  EXPECT_EQ(devices.emitter_name(0), "emitter");
  EXPECT_EQ(devices.emitter_channel(0), 1);
  EXPECT_EQ(devices.emitter_range_m(0), -1);
  EXPECT_EQ(devices.emitter_name(1), "far");
  EXPECT_EQ(devices.emitter_channel(1), 5);
  ASSERT_EQ(devices.receivers(), 1);
  EXPECT_EQ(devices.receiver_channel(0), 6);
  EXPECT_EQ(devices.robot, 3);
}

TEST_F(PacketDevicesTest, a_range_goes_no_further_than_the_worlds) {
  devices.set_emitter_range_m(1, 1.5);
  EXPECT_EQ(devices.emitter_range_m(1), 1.5);
  devices.set_emitter_range_m(1, 2.5);
  EXPECT_EQ(devices.emitter_range_m(1), 2);
  devices.set_emitter_range_m(1, -1);
  EXPECT_EQ(devices.emitter_range_m(1), 2);
  devices.set_emitter_range_m(0, 7);
  EXPECT_EQ(devices.emitter_range_m(0), 7);
  devices.set_emitter_range_m(0, -3);
  EXPECT_EQ(devices.emitter_range_m(0), -1);
}

TEST_F(PacketDevicesTest, a_queue_holds_4096_bytes_with_eight_for_each_packet) {
  std::vector<std::uint8_t> data(4096);
  EXPECT_FALSE(devices.send(0, data.data(), 4089, 0));
  EXPECT_FALSE(devices.send(0, data.data(), -1, 0));
  EXPECT_TRUE(devices.send(0, data.data(), 4000, 0));  // 88 are left
  EXPECT_FALSE(devices.send(0, data.data(), 81, 0));
  EXPECT_TRUE(devices.send(1, data.data(), 4088, 0)) << "each has its own";
  EXPECT_TRUE(devices.send(0, data.data(), 80, 0));
  EXPECT_FALSE(devices.send(0, data.data(), 0, 0));
  sim::Packet left;
  left.emitter = 0;
  left.bytes.resize(80);
  devices.on_left(left);
  EXPECT_TRUE(devices.send(0, data.data(), 80, 0));
}

TEST_F(PacketDevicesTest, a_receiver_hears_its_channel_and_shows_what_came_until_it_looked) {
  EXPECT_FALSE(devices.listens(6)) << "it is off";
  devices.switch_receiver(0, true);
  EXPECT_TRUE(devices.listens(6));
  EXPECT_FALSE(devices.listens(5));
  EXPECT_TRUE(devices.listens(sim::kAllChannels));
  devices.on_packet(packet(5, 1));
  devices.on_packet(packet(6, 2));
  EXPECT_EQ(devices.head(0), nullptr) << "not before the sampling period's end";
  devices.latch(0);
  devices.on_packet(packet(6, 3));
  ASSERT_NE(devices.head(0), nullptr);
  EXPECT_EQ(devices.head(0)->bytes.size(), 2u);
  devices.drop(0);
  EXPECT_EQ(devices.head(0), nullptr);
  devices.drop(0);  // of what is not visible none goes
  devices.latch(0);
  ASSERT_NE(devices.head(0), nullptr);
  EXPECT_EQ(devices.head(0)->bytes.size(), 3u);
  // 11 bytes are in it: 4085 more, their eight included
  devices.on_packet(packet(6, 4078));
  devices.on_packet(packet(6, 4077));
  devices.latch(0);
  devices.drop(0);
  ASSERT_NE(devices.head(0), nullptr);
  EXPECT_EQ(devices.head(0)->bytes.size(), 4077u);
  devices.set_receiver_channel(0, -1);
  EXPECT_TRUE(devices.listens(1234));
  devices.switch_receiver(0, false);
  EXPECT_NE(devices.head(0), nullptr) << "what is there stays";
}

TEST_F(PacketDevicesTest, all_is_as_at_first_when_the_robot_begins_anew) {
  std::vector<std::uint8_t> data(4088);
  devices.set_emitter_channel(1, 9);
  devices.set_emitter_range_m(1, 1);
  devices.set_receiver_channel(0, 9);
  devices.switch_receiver(0, true);
  ASSERT_TRUE(devices.send(1, data.data(), 4088, 0));
  devices.on_packet(packet(9, 1));
  devices.latch(0);
  devices.begin_again();
  EXPECT_EQ(devices.emitter_channel(1), 5);
  EXPECT_EQ(devices.emitter_range_m(1), 2);
  EXPECT_EQ(devices.receiver_channel(0), 6);
  EXPECT_EQ(devices.head(0), nullptr);
  EXPECT_FALSE(devices.listens(6));
  EXPECT_TRUE(devices.send(1, data.data(), 4088, 0)) << "its queue is empty";
}

}  // namespace
