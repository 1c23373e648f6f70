// SPDX-License-Identifier: MIT
// LSM330 over the bus: addresses, identity, rates, block update, ranges and increments by the data sheet.
#include "hal_sim/board/lsm330.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hal_sim/board/board.h"
#include "tests/board/flat_scene.h"

namespace {

using board::Board;
using board::Cycle;

class Lsm330Test : public ::testing::Test {
 protected:
  Lsm330Test() : robot(setup()) { robot.look_at(&scene); }
  static board::Setup setup() {
    board::Setup s;
    s.revision = board::Revision::Rev13;
    s.motion_noise_scale = 0;
    return s;
  }
  void set(int address, int number, int value, Cycle at = 0) {
    robot.i2c().start(at);
    EXPECT_TRUE(robot.i2c().write(static_cast<std::uint8_t>(address), at));
    EXPECT_TRUE(robot.i2c().write(static_cast<std::uint8_t>(number), at));
    EXPECT_TRUE(robot.i2c().write(static_cast<std::uint8_t>(value), at));
    robot.i2c().stop(at);
  }
  std::vector<int> get(int address, int number, int count, Cycle at, Cycle per_byte = 0) {
    robot.i2c().start(at);
    robot.i2c().write(static_cast<std::uint8_t>(address), at);
    robot.i2c().write(static_cast<std::uint8_t>(number), at);
    robot.i2c().start(at);
    robot.i2c().write(static_cast<std::uint8_t>(address + 1), at);
    std::vector<int> bytes;
    for (int i = 0; i < count; ++i, at += per_byte) bytes.push_back(robot.i2c().read(at));
    robot.i2c().stop(at);
    return bytes;
  }
  int word(int address, int axis, Cycle at) {
    const std::vector<int> b = get(address, (0x28 + 2 * axis) | 0x80, 2, at);
    return static_cast<std::int16_t>(b[0] | b[1] << 8);
  }
  /// As the library sets it up.
  void init(Cycle at = 0) {
    set(0x3C, 0x20, 0x9F, at);
    set(0x3C, 0x25, 0x50, at);
    set(0xD4, 0x20, 0xCF, at);
    set(0xD4, 0x23, 0x00, at);
  }

  sim::Scene scene;
  Board robot;
};

constexpr Cycle kSecond = board::kFcyHz;

TEST_F(Lsm330Test, only_revision_1_3_has_one_and_it_says_who_it_is) {
  EXPECT_EQ(get(0x3C, 0x0F, 1, 0)[0], 0x40);
  EXPECT_EQ(get(0xD4, 0x0F, 1, 0)[0], 0xD4);
  EXPECT_EQ(get(0xD4, 0x26, 1, 0)[0], 25);
  Board old{board::Setup{}};
  EXPECT_EQ(old.i2c().find(0x3C), nullptr);
}

TEST_F(Lsm330Test, at_rest_one_g_is_16384_counts_upwards) {
  init();
  EXPECT_EQ(word(0x3C, 0, kSecond), 0);
  EXPECT_EQ(word(0x3C, 1, kSecond), 0);
  EXPECT_EQ(word(0x3C, 2, kSecond), 16384);
  EXPECT_EQ(word(0xD4, 2, kSecond), 0);
}

TEST_F(Lsm330Test, axes_are_forward_left_and_up) {
  init();
  scene.force_m_s2 = [](sim::Clicks) { return sim::Vec3{9.81 / 2, -9.81 / 4, 9.81}; };
  // 1 rad/s = 57.29578 deg/s = 6548.09 counts of 8.75 mdps
  scene.turn_rad_s = [](sim::Clicks) { return sim::Vec3{0, -0.5, 1}; };
  EXPECT_EQ(word(0x3C, 0, kSecond), 8192);
  EXPECT_EQ(word(0x3C, 1, kSecond), -4096);
  EXPECT_EQ(word(0xD4, 1, kSecond), -3274);
  EXPECT_EQ(word(0xD4, 2, kSecond), 6548);
}

TEST_F(Lsm330Test, gyroscope_filter_answers_a_jerk_with_its_time_constant) {
  init();
  // 1 rad/s from click 0 of second 1 on; the stand-in's tick of 28800 is the step of the sum
  scene.turn_rad_s = [](sim::Clicks at) { return sim::Vec3{0, 0, at > board::kFcyHz ? 1.0 : 0.0}; };
  const double tau = board::kFcyHz / (2 * sim::kPi * 30);  // 78227 cycles
  for (int ticks : {1, 2, 4}) {
    // the newest sample of 760 a second; it feels what was one tick before, in whole ticks
    const Cycle at = board::kFcyHz + 28800 * (ticks + 1);
    const double period = board::kFcyHz / 760.0;
    const double turning = std::floor(at / period) * period - 28800 - board::kFcyHz;
    const double answer = 6548.09 * (1 - std::exp(-28800 * std::ceil(turning / 28800) / tau));
    EXPECT_NEAR(word(0xD4, 2, at), answer, 2) << ticks;
  }
  EXPECT_EQ(word(0xD4, 2, 2 * board::kFcyHz), 6548);
}

TEST_F(Lsm330Test, ranges_and_their_ends) {
  init();
  scene.turn_rad_s = [](sim::Clicks) { return sim::Vec3{0, 0, 1}; };
  EXPECT_EQ(word(0xD4, 2, kSecond), 6548);
  set(0xD4, 0x23, 0x10, kSecond);  // 500 deg/s: 17.5 mdps
  EXPECT_EQ(word(0xD4, 2, 2 * kSecond), 3274);
  set(0xD4, 0x23, 0x20, 2 * kSecond);  // 2000 deg/s: 70 mdps
  EXPECT_EQ(word(0xD4, 2, 3 * kSecond), 819);
  // +-4, 6, 8 and 16 g: 0.122, 0.183, 0.244 and 0.732 mg
  const int ranges[][2] = {{0x08, 8192}, {0x10, 5461}, {0x18, 4096}, {0x20, 1365}};
  for (int i = 0; i < 4; ++i) {
    set(0x3C, 0x24, ranges[i][0], 3 * kSecond + i * kSecond / 5);
    EXPECT_EQ(word(0x3C, 2, 3 * kSecond + (i + 1) * kSecond / 5), ranges[i][1]) << i;
  }
  set(0x3C, 0x24, 0x00, 4 * kSecond);
  scene.force_m_s2 = [](sim::Clicks) { return sim::Vec3{30, -30, 0}; };
  EXPECT_EQ(word(0x3C, 0, 5 * kSecond), 32767);
  EXPECT_EQ(word(0x3C, 1, 5 * kSecond), -32768);
}

TEST_F(Lsm330Test, values_change_at_the_output_rate) {
  set(0x3C, 0x20, 0x6F);  // 100 Hz: every 147456 cycles
  scene.force_m_s2 = [](sim::Clicks at) { return sim::Vec3{sim::to_seconds(at), 0, 0}; };
  EXPECT_EQ(word(0x3C, 0, 147455), 0) << "before the first sample";
  // sample 9 is taken at 0.1 s and stands until 0.11 s; lag 28800 clicks, filter of 800 Hz 0.199 ms
  const double felt = 0.1 - 28800.0 / board::kFcyHz - 1 / (2 * sim::kPi * 800);
  const int counts = static_cast<int>(felt / 9.81 * 16384 + 0.5);
  EXPECT_NEAR(word(0x3C, 0, 1474560), counts, 1);
  EXPECT_EQ(word(0x3C, 0, 1474560 + 147455), word(0x3C, 0, 1474560));
  EXPECT_GT(word(0x3C, 0, 1474560 + 147456), counts + 10);
}

TEST_F(Lsm330Test, block_update_keeps_both_bytes_of_one_sample) {
  init();
  // 0.9765625 m/s2 per 1/1600 s would be felt as 1631 counts a sample; bytes 2000 cycles apart
  scene.force_m_s2 = [](sim::Clicks at) { return sim::Vec3{1562.5 * (sim::to_seconds(at) - 1), 0, 0}; };
  const Cycle sample = kSecond + 28800 + 20000;
  const Cycle taken = sample / 9216 * 9216;  // 1600 Hz: every 9216 cycles
  const int whole = word(0x3C, 0, taken);
  const std::vector<int> bytes =
      get(0x3C, 0xA8, 2, taken + 9000, 500);  // the high byte after the next sample
  EXPECT_EQ(static_cast<std::int16_t>(bytes[0] | bytes[1] << 8), whole);
  set(0x3C, 0x20, 0x97, taken + 9000);  // without it
}

TEST_F(Lsm330Test, power_down_holds_and_status_tells_news) {
  EXPECT_EQ(get(0x3C, 0x27, 1, kSecond)[0], 0) << "off after power-up";
  EXPECT_EQ(word(0x3C, 2, kSecond), 0);
  init(kSecond);
  EXPECT_EQ(get(0x3C, 0x27, 1, kSecond + 9216)[0], 0x0F);
  EXPECT_EQ(get(0x3C, 0x27, 1, kSecond + 20000)[0], 0xFF) << "a sample was lost";
  word(0x3C, 2, kSecond + 20000);
  EXPECT_EQ(get(0x3C, 0x27, 1, kSecond + 20000)[0], 0);
  set(0x3C, 0x20, 0x0F, 2 * kSecond);
  EXPECT_EQ(word(0x3C, 2, 3 * kSecond), 16384);
}

TEST_F(Lsm330Test, addresses_grow_as_told) {
  init();
  EXPECT_EQ(get(0xD4, 0x20, 3, kSecond), (std::vector<int>{0xCF, 0xCF, 0xCF})) << "gyro without bit 7";
  EXPECT_EQ(get(0xD4, 0xA0, 2, kSecond), (std::vector<int>{0xCF, 0x00}));
  EXPECT_EQ(get(0x3C, 0x24, 2, kSecond), (std::vector<int>{0x00, 0x50})) << "acc by register 25";
}

TEST_F(Lsm330Test, offsets_and_noise) {
  board::Setup s = setup();
  s.acc_offset_m_s2 = {0.0981, 0, 0};
  s.gyro_offset_rad_s = {0, 0, sim::radians(1)};
  Board other(s);
  sim::Scene still;
  other.look_at(&still);
  other.i2c().start(0);
  for (int byte : {0x3C, 0x20, 0x9F}) other.i2c().write(static_cast<std::uint8_t>(byte), 0);
  other.i2c().start(0);
  for (int byte : {0x3C, 0x28}) other.i2c().write(static_cast<std::uint8_t>(byte), 0);
  other.i2c().start(0);
  other.i2c().write(0x3D, 0);
  const int low = other.i2c().read(kSecond), high = other.i2c().read(kSecond);
  EXPECT_EQ(low | high << 8, 164);  // 0.01 g
}

}  // namespace
