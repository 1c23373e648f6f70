// SPDX-License-Identifier: MIT
// A device that nobody has used is not looked at; from its first use on it is.
#include "hal_sim/board/first_use.h"

#include <gtest/gtest.h>

#include "hal_sim/board/board.h"
#include "hal_sim/board/camera.h"
#include "tests/support/memory_end.h"

namespace {

using board::Board;
using board::Cycle;

constexpr Cycle kAt = 1000;

TEST(FirstUse, a_robot_whose_devices_rest_need_not_be_looked_at) {
  Board robot{board::Setup{}};
  robot.exchange(kAt);
  EXPECT_EQ(robot.horizon(kAt), board::kNever);
  EXPECT_EQ(robot.uart(1).next_arrival(kAt), board::kNever);
}

/// What changes when the robot does something with one of its devices.
struct Change {
  bool of_hash, of_horizon;
};
Change after(const std::function<void(Board&)>& use) {
  Board robot{board::Setup{}}, other{board::Setup{}};
  use(robot);
  return {robot.state_hash(kAt) != other.state_hash(kAt), robot.horizon(kAt) == kAt};
}

TEST(FirstUse, each_device_is_looked_at_from_then_on) {
  const Change line_low = after([](Board& b) {
    b.uart(1).connect(std::make_shared<firmware_test::MemoryEnd>());
    b.uart(1).break_on_wire(100);
  });
  EXPECT_TRUE(line_low.of_hash);
  const Change byte = after([](Board& b) { b.uart(1).put_on_wire('a', 20, 100); });
  EXPECT_TRUE(byte.of_hash && byte.of_horizon);
  const Change sound = after([](Board& b) { b.codec().start_frames(0); });
  EXPECT_TRUE(sound.of_hash && sound.of_horizon);
  const Change word = after([](Board& b) { b.codec().line().word(1, 100); });
  EXPECT_TRUE(word.of_hash && word.of_horizon);
  const Change picture = after([](Board& b) { b.camera()->await_frame(0); });
  EXPECT_TRUE(picture.of_hash && picture.of_horizon);
  const Change cell = after([](Board& b) { b.eeprom().write(0xF000, 0x1234); });
  EXPECT_TRUE(cell.of_hash);
}

TEST(FirstUse, an_end_that_was_idle_is_heard) {
  Board robot{board::Setup{}};
  auto end = std::make_shared<firmware_test::MemoryEnd>();
  robot.uart(1).connect(end);
  robot.uart(1).follow_chip(true, 7);
  robot.exchange(kAt);
  EXPECT_EQ(robot.horizon(kAt), board::kNever);
  end->inject("x", kAt);
  EXPECT_EQ(robot.horizon(kAt), kAt);
  robot.exchange(kAt);
  EXPECT_LT(robot.uart(1).next_arrival(kAt), board::kNever);
}

TEST(FirstUse, an_end_that_may_speak_at_any_time_is_asked) {
  struct Talker final : board::UartEnd {
    void deliver(const std::uint8_t*, const Cycle*, std::size_t) override {}
    std::size_t collect(std::uint8_t*, std::size_t, Cycle) override { return 0; }
    std::string name() const override { return {}; }
  };
  Board robot{board::Setup{}};
  robot.uart(2).connect(std::make_shared<Talker>());
  EXPECT_EQ(robot.horizon(kAt), kAt);
}

}  // namespace
