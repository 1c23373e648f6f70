// SPDX-License-Identifier: MIT
// The radio turret's registers over the I2C bus, as the library's driver uses them; the
// channel is played by hand.
#include "hal_sim/board/radio_turret.h"

#include <gtest/gtest.h>

#include "hal_sim/board/i2c_bus.h"

namespace {

using board::Cycle;
using board::I2cBus;
using board::RadioTurret;
using board::RobotClock;

constexpr std::uint8_t kAddress = 0x7E;

struct Plugged {
  RobotClock clock;
  I2cBus bus;
  RadioTurret* turret;
  Cycle at = 0;
  Plugged() {
    auto made = std::make_unique<RadioTurret>(clock, 3);
    turret = made.get();
    bus.attach(std::move(made));
  }
  void write(int reg, int value) {
    at += 5000;
    bus.start(at);
    EXPECT_TRUE(bus.write(kAddress, at));
    bus.write(static_cast<std::uint8_t>(reg), at);
    bus.write(static_cast<std::uint8_t>(value), at);
    bus.stop(at);
  }
  int read(int reg) {
    at += 5000;
    bus.start(at);
    bus.write(kAddress, at);
    bus.write(static_cast<std::uint8_t>(reg), at);
    bus.start(at);
    bus.write(kAddress | 1, at);
    const int value = bus.read(at);
    bus.stop(at);
    return value;
  }
  void hear(int group, int to, const std::vector<std::uint8_t>& data, double level_db = 10) {
    sim::RadioFrame f;
    f.bytes.assign(10, 0);
    f.bytes[0] = static_cast<std::uint8_t>(data.size());
    f.bytes[6] = static_cast<std::uint8_t>(to);
    f.bytes[7] = static_cast<std::uint8_t>(to >> 8);
    f.bytes[8] = 0x0A;
    f.bytes[9] = static_cast<std::uint8_t>(group);
    f.bytes.insert(f.bytes.end(), data.begin(), data.end());
    turret->on_frame(f, level_db);
  }
};

TEST(RadioTurret, wakes_up_idle_with_the_radio_off) {
  Plugged p;
  EXPECT_EQ(p.read(0), 0x02);
  EXPECT_EQ(p.read(1), 0x00);
  EXPECT_EQ(p.read(3), 1);
  EXPECT_EQ(p.read(4), 0x7D);
  EXPECT_EQ(p.turret->listening_since, RadioTurret::kOff);
  p.write(1, 0x80);
  EXPECT_EQ(p.turret->listening_since, p.at);
  p.write(1, 0x81);  // the attenuator does not interrupt it
  EXPECT_EQ(p.turret->listening_since, p.at - 5000);
  p.write(1, 0x01);
  EXPECT_EQ(p.turret->listening_since, RadioTurret::kOff);
}

TEST(RadioTurret, attenuators_follow_the_chips_table) {
  Plugged p;
  const std::pair<int, double> kRows[] = {{1, 0},    {5, -1},   {9, -3},   {13, -5},  {17, -7},
                                          {21, -10}, {25, -15}, {29, -25}, {31, -25}, {3, -0.5}};
  for (const auto& [value, db] : kRows) {
    p.write(3, value);
    EXPECT_EQ(p.read(3), value);
    EXPECT_DOUBLE_EQ(p.turret->power_db(), db) << value;
  }
  p.write(1, 0x01);
  p.write(3, 21);
  EXPECT_DOUBLE_EQ(p.turret->power_db(), -35);
}

TEST(RadioTurret, sends_what_was_written_with_its_time_on_the_air) {
  Plugged p;
  p.write(1, 0x80);
  p.write(7 + 8, 0x0A);
  p.write(7 + 9, 0x7D);
  p.write(7 + 6, 0x34);
  p.write(7 + 7, 0x12);
  for (int i = 0; i < 5; ++i) p.write(7 + 10 + i, 100 + i);
  p.write(2, 1);
  ASSERT_EQ(p.turret->outbox.size(), 1u);
  const sim::RadioRequest& r = p.turret->outbox[0];
  EXPECT_EQ(r.at, p.at);
  EXPECT_EQ(r.air_octets, 6 + 11 + 5);  // preamble, delimiter, length; header and check; data
  EXPECT_EQ(r.bytes,
            (std::vector<std::uint8_t>{5, 0, 0, 0, 0, 0, 0x34, 0x12, 0x0A, 0x7D, 100, 101, 102, 103, 104}));
  EXPECT_EQ(p.read(0) & 0x0A, 0x00);  // busy, no error
  p.write(2, 1);
  EXPECT_EQ(p.read(0) & 0x0A, 0x08);  // a second one meanwhile is an error
  EXPECT_EQ(p.turret->outbox.size(), 1u);
  p.turret->on_sent(false, 0);
  EXPECT_EQ(p.read(0) & 0x02, 0x02);
  // the next packet is as long as what is written for it
  p.write(7 + 10, 1);
  p.write(2, 1);
  EXPECT_EQ(p.turret->outbox.back().bytes.size(), 11u);
  EXPECT_EQ(p.read(0) & 0x08, 0x00);
  // a channel that stays busy shows as an error
  p.turret->on_sent(true, 0);
  EXPECT_EQ(p.read(0) & 0x0A, 0x0A);
}

TEST(RadioTurret, a_switched_off_radio_does_not_send) {
  Plugged p;
  p.write(2, 1);
  EXPECT_TRUE(p.turret->outbox.empty());
  EXPECT_EQ(p.read(0), 0x0A);
}

TEST(RadioTurret, keeps_one_packet_and_says_when_another_was_lost) {
  Plugged p;
  p.write(1, 0x80);
  p.write(5, 7);
  p.hear(0x7D, 7, {11, 22, 33}, 10);
  EXPECT_EQ(p.read(0), 0x03);
  p.hear(0x7D, 7, {44});
  EXPECT_EQ(p.read(0), 0x07);
  EXPECT_EQ(p.turret->lost(), 1);
  EXPECT_EQ(p.read(130), 3);
  EXPECT_EQ(p.read(140), 11);
  EXPECT_EQ(p.read(142), 33);
  // strength: 10 dB above -95 dBm is -85 dBm, the chip's register says that plus 45
  EXPECT_EQ(static_cast<std::int8_t>(p.read(130 + 118)), -40);
  EXPECT_EQ(p.read(0), 0x07);
  p.read(252);  // the last byte frees it and clears both bits
  EXPECT_EQ(p.read(0), 0x02);
  p.hear(0x7D, 7, {55});
  EXPECT_EQ(p.read(140), 55);
  EXPECT_EQ(p.read(141), 0);  // nothing of the packet before
}

TEST(RadioTurret, takes_its_own_group_and_address_and_those_for_all) {
  Plugged p;
  p.write(1, 0x80);
  p.write(4, 0x11);
  p.write(5, 0x34);
  p.write(6, 0x12);
  const struct {
    int group, to;
    bool taken;
  } kCases[] = {{0x11, 0x1234, true}, {0x11, 0x34, false},  {0x12, 0x1234, false}, {0xFF, 0x1234, true},
                {0x11, 0xFF, true},   {0x11, 0xFFFF, true}, {0x12, 0xFFFF, false}};
  for (const auto& k : kCases) {
    p.hear(k.group, k.to, {1});
    EXPECT_EQ((p.read(0) & 1) != 0, k.taken) << k.group << " " << k.to;
    p.read(252);
  }
}

TEST(RadioTurret, an_empty_socket_answers_ff) {
  I2cBus bus;
  bus.start(0);
  EXPECT_FALSE(bus.write(kAddress, 0));
  bus.write(0, 0);
  bus.start(0);
  bus.write(kAddress | 1, 0);
  EXPECT_EQ(bus.read(0), 0xFF);
}

}  // namespace
